//! Gauss-Kronrod integration of several functions at once.

/// Abscissae of the 15-point Kronrod rule, outermost first; the odd ones are the 7-point Gauss
/// rule's (R. Piessens et al., QUADPACK, 1983).
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_46,
    0.0,
];
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_55,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_89,
    0.209_482_141_084_727_83,
];
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_7, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];

/// Integrals and estimates of their errors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Integral<const N: usize> {
    pub(super) value: [f64; N],
    pub(super) error: [f64; N],
}

impl<const N: usize> Integral<N> {
    pub(super) const ZERO: Self = Self { value: [0.0; N], error: [0.0; N] };

    pub(super) fn add(&mut self, other: &Self) {
        for i in 0..N {
            self.value[i] += other.value[i];
            self.error[i] += other.error[i];
        }
    }

    pub(super) fn times(&self, factor: f64) -> Self {
        Self { value: self.value.map(|v| v * factor), error: self.error.map(|e| e * factor) }
    }

    /// Whether every error is within its allowance.
    pub(super) fn within(&self, allowed: &[f64; N]) -> bool {
        self.error.iter().zip(allowed).all(|(error, allowed)| error <= allowed)
    }
}

/// Integrates over a range: applies the rule, and halves the range up to `depth` times until the errors are within
/// their allowances. A half has half the allowance. `f` receives the parameter, the length of the range that contains
/// it, and that range's allowance.
pub(super) fn adaptive<const N: usize, E>(
    [a, b]: [f64; 2],
    allowed: &[f64; N],
    depth: u32,
    f: &mut impl FnMut(f64, f64, &[f64; N]) -> Result<Integral<N>, E>,
) -> Result<Integral<N>, E> {
    let whole = rule([a, b], |t| f(t, b - a, allowed))?;
    if depth == 0 || whole.within(allowed) {
        return Ok(whole);
    }
    let (middle, allowed) = (0.5 * (a + b), allowed.map(|allowed| 0.5 * allowed));
    let mut total = adaptive([a, middle], &allowed, depth - 1, f)?;
    total.add(&adaptive([middle, b], &allowed, depth - 1, f)?);
    Ok(total)
}

/// Applies the rule once to `[a, b]`. It adds the function's own error, if it has one.
pub(super) fn rule<const N: usize, E>(
    [a, b]: [f64; 2],
    mut f: impl FnMut(f64) -> Result<Integral<N>, E>,
) -> Result<Integral<N>, E> {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let (mut kronrod, mut gauss, mut magnitude) = ([0.0; N], [0.0; N], [0.0; N]);
    let mut error = [0.0; N];
    for (i, (node, weight)) in NODES.into_iter().zip(KRONROD).enumerate() {
        let signs: &[f64] = if node == 0.0 { &[0.0] } else { &[-1.0, 1.0] };
        for sign in signs {
            let sample = f(middle + sign * node * half)?;
            for n in 0..N {
                kronrod[n] += weight * sample.value[n];
                magnitude[n] += weight * sample.value[n].abs();
                error[n] += weight * sample.error[n];
                if i % 2 == 1 {
                    gauss[n] += GAUSS[i / 2] * sample.value[n];
                }
            }
        }
    }
    for n in 0..N {
        error[n] += estimate(kronrod[n] - gauss[n], magnitude[n]);
    }
    let scale = half.abs();
    Ok(Integral { value: kronrod.map(|k| k * half), error: error.map(|e| e * scale) })
}

/// QUADPACK's estimate of the Kronrod rule's error. The difference from the Gauss rule's result is the error of the
/// Gauss rule; the error of the Kronrod rule is estimated by a multiple of its power 1.5.
fn estimate(difference: f64, magnitude: f64) -> f64 {
    let rounding = 50.0 * f64::EPSILON * magnitude;
    if magnitude == 0.0 {
        return 0.0;
    }
    let sharp = magnitude * (200.0 * difference.abs() / magnitude).powf(1.5);
    sharp.min(difference.abs()).max(rounding)
}
