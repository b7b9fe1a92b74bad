//! Ranges of a trigonometric polynomial whose coefficients are known within bounds.

use super::enclosure::Enclosure;
use crate::trig_polynomial::TrigPolynomial;

/// Relative error of cos nθ and sin nθ, n ≤ 4, by recurrence from enclosed ones, and of the sums with them. The
/// recurrence multiplies unit vectors: n of them have n errors √2 · 2^-51 and n - 1 roundings √8 · 2^-53. The sums add
/// at most six roundings. Together that is below 2^-47.
const EVALUATION: f64 = 32.0 * f64::EPSILON;
/// Factor that covers the roundings of a short sum of positive numbers.
const UPWARDS: f64 = 1.0 + 1e-12;

/// All polynomials with coefficients within bounds.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundedPolynomial<const M: usize> {
    middle: TrigPolynomial<M>,
    /// Bounds of the errors of the value and of the first three derivatives at a point.
    errors: [f64; 4],
    /// Bound of the fourth derivative on the circle.
    fourth: f64,
}

/// Value and derivatives at the middle of an arc.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArcRange<'a> {
    derivatives: [f64; 4],
    errors: &'a [f64; 4],
    fourth: f64,
}

impl<const M: usize> BoundedPolynomial<M> {
    pub(super) fn new(bounds: &TrigPolynomial<M, Enclosure>) -> Self {
        let split = |bounds: Enclosure| {
            let middle = bounds.middle();
            (middle, (bounds - Enclosure::of(middle)).magnitude())
        };
        let mut middle = TrigPolynomial { cos: [0.0; M], sin: [0.0; M] };
        let (mut errors, mut fourth, mut order) = ([0.0; 4], 0.0, 0.0_f64);
        for n in 0..M {
            let ([cos, cos_error], [sin, sin_error]) =
                (<[f64; 2]>::from(split(bounds.cos[n])), <[f64; 2]>::from(split(bounds.sin[n])));
            (middle.cos[n], middle.sin[n]) = (cos, sin);
            let size = cos.abs() + sin.abs();
            let (error, mut power) = (cos_error + sin_error + EVALUATION * size, 1.0);
            for bound in &mut errors {
                *bound += power * error;
                power *= order;
            }
            fourth += power * ((cos * cos + sin * sin).sqrt() + cos_error + sin_error);
            order += 1.0;
        }
        Self { middle, errors: errors.map(|error| error * UPWARDS), fourth: fourth * UPWARDS }
    }

    /// Value and derivatives at the angle with this cosine and sine, as [`sin_cos`](crate::fast_math::sin_cos) rounds
    /// them.
    #[inline]
    pub(super) fn at(&self, [c1, s1]: [f64; 2]) -> ArcRange<'_> {
        let (mut c, mut s, mut order) = (1.0, 0.0, 0.0);
        let mut derivatives = [self.middle.cos[0], 0.0, 0.0, 0.0];
        for n in 1..M {
            (c, s) = (c * c1 - s * s1, s * c1 + c * s1);
            order += 1.0;
            let value = self.middle.cos[n] * c + self.middle.sin[n] * s;
            let slope = order * (self.middle.sin[n] * c - self.middle.cos[n] * s);
            derivatives[0] += value;
            derivatives[1] += slope;
            derivatives[2] -= order * order * value;
            derivatives[3] -= order * order * slope;
        }
        ArcRange { derivatives, errors: &self.errors, fourth: self.fourth }
    }
}

impl ArcRange<'_> {
    /// Whether the polynomial has no zero within `half` of the middle: the least value of its Taylor polynomial of
    /// degree two exceeds all that may be missing.
    #[inline]
    pub(super) fn excludes_zero(&self, half: f64) -> bool {
        let [f0, f1, f2, f3] = self.derivatives;
        let [e0, e1, e2, e3] = *self.errors;
        let sign = 1.0_f64.copysign(f0);
        let (value, slope, bend) = (f0.abs(), sign * f1, 0.5 * sign * f2);
        let (rise, curve) = (slope.abs() * half, bend * half * half);
        // The vertex of the parabola, if it is on the arc.
        let inside = bend > 0.0 && slope.abs() < 2.0 * bend * half;
        let lowest = if inside { value - 0.25 * slope * slope / bend } else { value - rise + curve };
        let missing =
            e0 + half * (e1 + half * (0.5 * e2 + half * ((f3.abs() + e3) / 6.0 + half * self.fourth / 24.0)));
        lowest > UPWARDS * missing + (UPWARDS - 1.0) * (value + rise + curve.abs())
    }

    /// Whether the derivative has no zero within `half` of the middle.
    #[inline]
    pub(super) fn is_monotone(&self, half: f64) -> bool {
        let [_, f1, f2, f3] = self.derivatives;
        let [_, e1, e2, e3] = *self.errors;
        let change = half * ((f2.abs() + e2) + half * (0.5 * (f3.abs() + e3) + half * self.fourth / 6.0));
        f1.abs() > UPWARDS * (e1 + change)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fast_math::sin_cos;
    use crate::trig_polynomial::linear;

    /// A polynomial of degree four, and its values.
    fn polynomial(seed: u32) -> (BoundedPolynomial<5>, impl Fn(f64) -> f64) {
        let number = |i: u32| (f64::from(5 * seed + i) * 0.618_033_988_749_895).fract() - 0.5;
        let factor = |i: u32| linear(number(i), number(i + 1), number(i + 2));
        let product = factor(0).times(&factor(3));
        let shifted = product.squared().plus(1.0, &linear(0.1 * number(2), 0.0, 0.0).raised());
        let bounds = |numbers: [f64; 5]| numbers.map(|number| Enclosure::of(number).widened(1e-15));
        let bounded = TrigPolynomial { cos: bounds(shifted.cos), sin: bounds(shifted.sin) };
        (BoundedPolynomial::new(&bounded), move |angle| shifted.at(angle).value)
    }

    #[test]
    fn arcs_without_zeros_and_monotone_arcs_are_so() {
        let (mut excluded, mut monotone) = (0, 0);
        for seed in 0..400 {
            let (bounded, value) = polynomial(seed);
            for arc in 0..40 {
                let (middle, half) = (f64::from(arc) * 0.16 - 3.1, 0.02 * f64::from(1 + arc % 7));
                let (s, c) = sin_cos(middle);
                let range = bounded.at([c, s]);
                let values: Vec<f64> =
                    (-20..=20).map(|i| value(middle + half * f64::from(i) / 20.0)).collect();
                if range.excludes_zero(half) {
                    excluded += 1;
                    assert!(
                        values.iter().all(|v| *v > 0.0) || values.iter().all(|v| *v < 0.0),
                        "{seed} {middle}"
                    );
                }
                if range.is_monotone(half) {
                    monotone += 1;
                    let rising = values[40] > values[0];
                    assert!(values.windows(2).all(|pair| (pair[1] > pair[0]) == rising), "{seed} {middle}");
                }
            }
        }
        assert!(excluded > 5_000 && monotone > 3_000, "{excluded} {monotone}");
    }

    #[test]
    fn a_double_zero_is_never_excluded() {
        for turn in 0..60 {
            let angle = f64::from(turn) * 0.1 - 3.0;
            // (1 - cos(θ - angle))²
            let factor = linear(1.0, -angle.cos(), -angle.sin());
            let square = factor.times(&factor);
            let bounds = |numbers: [f64; 3]| numbers.map(|number| Enclosure::of(number).widened(1e-15));
            let bounded =
                BoundedPolynomial::new(&TrigPolynomial { cos: bounds(square.cos), sin: bounds(square.sin) });
            for half in [1e-9, 1e-4, 0.1] {
                let (s, c) = sin_cos(angle + 0.9 * half);
                assert!(!bounded.at([c, s]).excludes_zero(half) && !bounded.at([c, s]).is_monotone(half));
            }
        }
    }
}
