//! Leg I with P given: the cubic (15) in cos a, solved for its two roots in [-1, 1].
//!
//! With E = L1² - X1² - C the cubic is g(c) = R1² (1 - c²)(E + k c) - (C - k c) y². It is not
//! positive at c = ±1 and tends to +∞ for c → -∞, so one root lies at or below -1 and there are
//! none or two in [-1, 1], at both sides of the only local maximum. Newton's method converges to
//! each of them monotonically: to the right one from c = 1, where g is concave as far as the
//! maximum; to the left one from c = -1, or from the inflection -E/3k if that is greater. Written
//! in t = 1 ∓ c the roots keep their relative precision near the symmetry plane y = 0, where
//! sin a = √(t (2 - t)) is small.

use arrayvec::ArrayVec;

use crate::machine::Machine;
use crate::residual::RESIDUAL_TOLERANCE;

/// Newton steps: near a double root convergence is linear, a bit each.
const STEPS: usize = 60;
/// Relative size of the next step at which a root stands.
const SETTLED: f64 = 1e-16;
/// Two roots closer than this are one: the square root of the rounding.
const RESOLUTION: f64 = 4e-8;
/// Where w1² exceeds this part of L1², its root is the better formula for w1, else y u / v.
const LARGE: f64 = 0.01;

/// One angle of leg I with its slider above (s1 = +1); the mirror image (c, -s, -w1) is the
/// solution with the slider below.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LegAngle {
    pub(crate) c: f64,
    pub(crate) s: f64,
    pub(crate) w1: f64,
    pub(crate) merged: bool,
}

/// g/R1² as a cubic in t, t = 1 - c (`k` positive) or t = 1 + c (`k` negative).
#[derive(Clone, Copy, Debug)]
struct Cubic([f64; 4]);

/// Leg I at given x and y.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FirstLeg<'a> {
    machine: &'a Machine,
    y: f64,
    e: f64,
}

impl<'a> FirstLeg<'a> {
    #[inline]
    pub(crate) fn new(machine: &'a Machine, x: f64, y: f64) -> Self {
        let x1 = x + machine.derived.e1;
        let l1 = machine.geometry().L1;
        Self { machine, y, e: (l1 - x1) * (l1 + x1) - machine.derived.c }
    }

    /// The angle nearest to zero, where the working mode usually is.
    #[inline]
    pub(crate) fn nearest(&self) -> Option<LegAngle> {
        let cubic = self.cubic(1.0);
        let t = cubic.newton(cubic.guess()).or_else(|| cubic.newton(0.0))?;
        Some(self.angle(1.0 - t, t, false))
    }

    /// Both angles; one if they have merged; none if the leg does not reach.
    #[inline]
    pub(crate) fn both(&self) -> ArrayVec<LegAngle, 2> {
        let (k, right_side) = (self.machine.derived.k, self.cubic(1.0));
        let inflection = 1.0 - self.e / (3.0 * k);
        let right = right_side.newton(right_side.guess()).or_else(|| right_side.newton(0.0));
        let left_side = self.cubic(-1.0);
        let left =
            if inflection > 0.0 { left_side.newton(inflection) } else { left_side.newton(left_side.guess()) };
        let mut angles = ArrayVec::new();
        match (right, left) {
            (Some(t), Some(near)) if 2.0 - t - near > RESOLUTION => {
                angles.push(self.angle(1.0 - t, t, false));
                angles.push(self.angle(near - 1.0, near, false));
            }
            (Some(t), Some(_)) => angles.push(self.angle(1.0 - t, t, true)),
            _ => angles.extend(self.merged(&right_side)),
        }
        angles
    }

    /// The double root that rounding may have lifted off zero.
    #[cold]
    fn merged(&self, cubic: &Cubic) -> Option<LegAngle> {
        let t = cubic.maximum()?;
        let l1 = self.machine.geometry().L1;
        let slack = 2.0 * RESIDUAL_TOLERANCE * l1 * l1;
        let inside = t > 0.0 && t < 2.0 && cubic.value(t) >= -slack * t * (2.0 - t);
        inside.then(|| self.angle(1.0 - t, t, true))
    }

    /// The angle at which the leg misses least, where it does not reach.
    #[cold]
    pub(crate) fn closest(&self) -> LegAngle {
        let t = self.best();
        self.angle(1.0 - t, t, true)
    }

    /// How well the leg reaches: (15) at its greatest over R1² L1², negative out of reach.
    #[inline]
    pub(crate) fn slack(&self) -> f64 {
        let l1 = self.machine.geometry().L1;
        self.cubic(1.0).value(self.best()) / (l1 * l1)
    }

    #[inline]
    fn best(&self) -> f64 {
        self.cubic(1.0).maximum().unwrap_or(2.0).clamp(0.0, 2.0)
    }

    #[inline]
    fn cubic(&self, sign: f64) -> Cubic {
        let d = &self.machine.derived;
        let k = sign * d.k;
        let y_square = self.y * self.y;
        let per_square = self.machine.derived.inverse_r1_square * y_square;
        let p = self.e + k;
        Cubic([-(d.c - k) * per_square, 2.0 * p - k * per_square, -(p + 2.0 * k), k])
    }

    #[inline]
    fn angle(&self, c: f64, t: f64, merged: bool) -> LegAngle {
        let g = self.machine.geometry();
        let size = (t * (2.0 - t)).max(0.0).sqrt();
        let u = g.R1 * c - g.r1;
        let s = -size.copysign(self.y * u);
        let square = self.e + self.machine.derived.k * c - self.y * self.y;
        let v = g.R1 * size;
        let w1 = if square > LARGE * g.L1 * g.L1 || v == 0.0 {
            square.max(0.0).sqrt()
        } else {
            (self.y * u / v).abs()
        };
        LegAngle { c, s, w1, merged }
    }
}

impl Cubic {
    #[inline]
    fn value(&self, t: f64) -> f64 {
        let [a0, a1, a2, a3] = self.0;
        a0 + t * (a1 + t * (a2 + t * a3))
    }

    /// The zero without the cubic term, which is small: where Newton's method begins.
    #[inline]
    fn guess(&self) -> f64 {
        let [a0, a1, a2, _] = self.0;
        let disc = a1 * a1 - 4.0 * a0 * a2;
        if disc > 0.0 && a1 > 0.0 { -2.0 * a0 / (a1 + disc.sqrt()) } else { 0.0 }
    }

    #[inline]
    fn slope(&self, t: f64) -> f64 {
        let [_, a1, a2, a3] = self.0;
        a1 + t * (2.0 * a2 + t * (3.0 * a3))
    }

    #[inline]
    fn newton(&self, start: f64) -> Option<f64> {
        let [_, _, a2, a3] = self.0;
        let mut t = start;
        for _ in 0..STEPS {
            let slope = self.slope(t);
            // Behind the maximum: g has no root between.
            if !(slope > 0.0 && t <= 2.0) {
                return None;
            }
            let step = self.value(t) / slope;
            t -= step;
            // What the next step would be, as far as convergence is quadratic.
            let next = step * step * (a2 + 3.0 * a3 * t).abs();
            if next <= SETTLED * t * slope {
                break;
            }
        }
        (0.0..=2.0).contains(&t).then_some(t)
    }

    /// The local maximum: the lesser zero of the slope in t = 1 - c.
    fn maximum(&self) -> Option<f64> {
        let [_, a1, a2, a3] = self.0;
        let disc = a2 * a2 - 3.0 * a3 * a1;
        (disc >= 0.0).then(|| a1 / (-a2 + disc.sqrt()))
    }
}
