//! Zero of a function between two points where its signs differ.

/// Greatest number of steps. Bisection alone needs 52.
const STEPS: usize = 100;

/// The zero of `f` in [0, 1], where f(0) = `start` and f(1) = `end` have different signs, to
/// `resolution` in the parameter. T. R. Chandrupatla, Advances in Engineering Software 28 (1997):
/// inverse quadratic interpolation where it is safe, bisection elsewhere.
pub(crate) fn zero(start: f64, end: f64, resolution: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    if start == 0.0 {
        return 0.0;
    }
    let (mut a, mut fa, mut b, mut fb) = (0.0, start, 1.0, end);
    // The first step is the secant's: most of these functions are nearly linear.
    let mut t = within(fa / (fa - fb), 0.0);
    for _ in 0..STEPS {
        let at = a + t * (b - a);
        let value = f(at);
        let (c, fc);
        if (value > 0.0) == (fa > 0.0) {
            (c, fc) = (a, fa);
        } else {
            (c, fc) = (b, fb);
            (b, fb) = (a, fa);
        }
        (a, fa) = (at, value);
        let best = if fa.abs() < fb.abs() { a } else { b };
        let width = (b - a).abs();
        if fa == 0.0 || fb == 0.0 || width <= 2.0 * resolution {
            return best;
        }
        let least = resolution / width;
        t = within(step([a, b, c], [fa, fb, fc]), least);
    }
    if fa.abs() < fb.abs() { a } else { b }
}

/// Clamps a fraction to this distance from both ends; a half if the function's values are not finite and give no
/// fraction.
fn within(t: f64, least: f64) -> f64 {
    if t.is_nan() { 0.5 } else { t.clamp(least, 1.0 - least) }
}

/// Fraction of the way from a to b.
fn step([a, b, c]: [f64; 3], [fa, fb, fc]: [f64; 3]) -> f64 {
    let (xi, phi) = ((a - b) / (c - b), (fa - fb) / (fc - fb));
    if phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi {
        fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
    } else {
        0.5
    }
}

#[cfg(test)]
mod tests {
    use super::zero;

    #[test]
    fn values_that_are_not_finite_give_a_zero_between_the_ends() {
        for [start, end] in [[f64::NAN, 1.0], [1.0, f64::NAN], [f64::INFINITY, f64::NEG_INFINITY]] {
            for middle in [f64::NAN, f64::INFINITY, -1.0] {
                let found = zero(start, end, 1e-9, |_| middle);
                assert!((0.0..=1.0).contains(&found), "{start} {middle} {end}: {found}");
            }
        }
    }
}
