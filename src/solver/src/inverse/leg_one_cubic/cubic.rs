//! The cubic (15) in the distance of cos a from one of its ends, and its zeros by Newton's method.

/// Newton steps. Near a double root convergence is linear, with one bit a step.
pub(super) const STEPS: usize = 60;
/// Relative size of the next step at which the iteration has converged.
const CONVERGED: f64 = 1e-16;
/// Constant terms of the cubic below this have lost digits to underflow: y is zero.
const UNDERFLOW: f64 = 1e-280;

/// g/R1² as a cubic in t, t = 1 - c (`k` positive) or t = 1 + c (`k` negative).
#[derive(Clone, Copy, Debug)]
pub(super) struct Cubic(pub(super) [f64; 4]);

/// A step of Newton's method on the cubic.
pub(super) struct NewtonStep {
    pub(super) t: f64,
    /// Whether g rises at the start.
    pub(super) is_before_maximum: bool,
    pub(super) has_converged: bool,
}

impl Cubic {
    #[inline(always)]
    pub(super) fn value(&self, t: f64) -> f64 {
        let [a0, a1, a2, a3] = self.0;
        a0 + t * (a1 + t * (a2 + t * a3))
    }

    /// The sum of the terms' magnitudes.
    pub(super) fn magnitude(&self, t: f64) -> f64 {
        let [a0, a1, a2, a3] = self.0.map(f64::abs);
        a0 + t * (a1 + t * (a2 + t * a3))
    }

    /// The zero without the cubic term, which is small: where Newton's method begins.
    #[inline(always)]
    pub(super) fn start(&self) -> f64 {
        let [a0, a1, a2, _] = self.0;
        let disc = a1 * a1 - 4.0 * a0 * a2;
        if (disc > 0.0) & (a1 > 0.0) { -2.0 * a0 / (a1 + disc.sqrt()) } else { 0.0 }
    }

    /// The least zero, if there is one up to 2.
    #[inline]
    pub(super) fn nearest(&self) -> Option<f64> {
        self.newton(self.start()).or_else(|| self.newton(0.0))
    }

    /// The second zero from the first, t, and the quadratic that is left. Its terms all have one
    /// sign but for the constant, so that nothing cancels unless the zeros are about to merge.
    #[inline]
    pub(super) fn other(&self, t: f64) -> f64 {
        let [a0, a1, a2, a3] = self.0;
        let constant = if a0 < -UNDERFLOW { -a0 / t } else { a1 + t * (a2 + t * a3) };
        let linear = -(a2 + a3 * t);
        2.0 * constant / (linear + (linear * linear - 4.0 * a3 * constant).max(0.0).sqrt())
    }

    #[inline(always)]
    pub(super) fn slope(&self, t: f64) -> f64 {
        let [_, a1, a2, a3] = self.0;
        a1 + t * (2.0 * a2 + t * (3.0 * a3))
    }

    #[inline]
    pub(super) fn newton(&self, start: f64) -> Option<f64> {
        let mut t = start;
        for _ in 0..STEPS {
            let step = self.step(t);
            // Behind the maximum: g has no root between.
            if !step.is_before_maximum {
                return None;
            }
            t = step.t;
            if step.has_converged {
                break;
            }
        }
        (0.0..=2.0).contains(&t).then_some(t)
    }

    #[inline(always)]
    pub(super) fn step(&self, before: f64) -> NewtonStep {
        let [_, _, a2, a3] = self.0;
        let slope = self.slope(before);
        let step = self.value(before) / slope;
        let t = before - step;
        // The size of the next step, if convergence is quadratic.
        let next = step * step * (a2 + 3.0 * a3 * t).abs();
        NewtonStep {
            t,
            is_before_maximum: (slope > 0.0) & (before <= 2.0),
            has_converged: next <= CONVERGED * t * slope,
        }
    }

    /// The local maximum: the lesser zero of the slope in t = 1 - c.
    pub(super) fn maximum(&self) -> Option<f64> {
        let [_, a1, a2, a3] = self.0;
        let disc = a2 * a2 - 3.0 * a3 * a1;
        (disc >= 0.0).then(|| a1 / (-a2 + disc.sqrt()))
    }
}
