//! Leg I with P given: the cubic (15) in cos a, solved for its two roots in [-1, 1].
//!
//! With E = L1² - X1² - C the cubic is g(c) = R1² (1 - c²)(E + k c) - (C - k c) y². It is not
//! positive at c = ±1 and tends to +∞ for c → -∞, so one root lies at or below -1 and there are
//! none or two in [-1, 1], at both sides of the only local maximum. Newton's method converges to
//! each of them monotonically: to the right one from c = 1, where g is concave as far as the
//! maximum; to the left one from c = -1, or from the inflection -E/3k if that is greater. Written
//! in t = 1 ∓ c the roots keep their relative precision near the symmetry plane y = 0, where
//! sin a = √(t (2 - t)) is small.
//!
//! Where leg I is nearly level and y nearly zero both roots are near c = 1. The second one then
//! follows from the first in t = 1 - c: the product of the three roots is known without
//! cancellation. There E + k, the square of the height at a = 0 and y = 0, is computed with twice
//! the digits, for a rounding of L1² would decide whether the leg reaches.

mod cubic;
mod rows;

use arrayvec::ArrayVec;

use super::leg_one_height::{is_nearly_level, rounded_square_at_zero, square_at_pi, square_at_zero};
use crate::fast_math::greater;
use crate::mechanism::Mechanism;
use crate::residual::RESIDUAL_TOLERANCE;
use cubic::Cubic;

pub(super) use rows::CubicRows;

/// Distance below which two roots are one: the square root of the rounding error. It is relative to the roots if both
/// are near c = 1.
const RESOLUTION: f64 = 4e-8;
/// Fraction of L1² above which the root of w1² is the better formula for w1. Below it y u / v is.
const LARGE: f64 = 0.01;

/// One angle of leg I with its slider above (s1 = +1); the mirror image (c, -s, -w1) is the
/// solution with the slider below.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LegOneAngle {
    pub(crate) c: f64,
    pub(crate) s: f64,
    pub(crate) w1: f64,
    pub(crate) merged: bool,
}

/// Leg I at given x and y of P.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LegOneCubic<'a> {
    mechanism: &'a Mechanism,
    x: f64,
    y: f64,
    /// E + k: w1² + y² at a = 0.
    at_zero: f64,
}

impl<'a> LegOneCubic<'a> {
    #[inline]
    pub(crate) fn new(mechanism: &'a Mechanism, x: f64, y: f64) -> Self {
        Self { mechanism, x, y, at_zero: square_at_zero(mechanism, x) }
    }

    /// The same where leg I is not nearly level.
    #[inline(always)]
    fn rounded(mechanism: &'a Mechanism, x: f64, y: f64) -> Self {
        Self { mechanism, x, y, at_zero: rounded_square_at_zero(mechanism, x) }
    }

    /// The angle nearest to zero, where the working mode usually is.
    #[inline]
    pub(crate) fn nearest(&self) -> Option<LegOneAngle> {
        let cubic = self.cubic(1.0);
        Some(self.angle(1.0, cubic.nearest()?, false))
    }

    /// Both angles; one if they have merged; none if the leg does not reach.
    #[inline]
    pub(crate) fn both(&self) -> ArrayVec<LegOneAngle, 2> {
        let right_side = self.cubic(1.0);
        let mut angles = ArrayVec::new();
        let Some(t) = right_side.nearest() else {
            angles.extend(self.merged(&right_side));
            return angles;
        };
        let other = right_side.other(t);
        // In t = 1 - c the other root is good to the last digits only if it is small, too.
        let (sign, other, apart) = if other < 1.0 {
            (1.0, Some(other), (other - t) / other)
        } else {
            let left = self.left();
            (-1.0, left, left.map_or(0.0, |left| 2.0 - t - left))
        };
        match other {
            Some(other) if apart > RESOLUTION => {
                angles.push(self.angle(1.0, t, false));
                angles.push(self.angle(sign, other, false));
            }
            Some(_) => angles.push(self.angle(1.0, t, true)),
            None => angles.extend(self.merged(&right_side)),
        }
        angles
    }

    /// The left root in t = 1 + c.
    #[inline]
    fn left(&self) -> Option<f64> {
        let cubic = self.cubic(-1.0);
        let k = self.mechanism.k;
        let inflection = 1.0 - (self.at_zero - k) / (3.0 * k);
        cubic.newton(if inflection > 0.0 { inflection } else { cubic.start() })
    }

    /// A double root that rounding may have made complex.
    #[cold]
    fn merged(&self, cubic: &Cubic) -> Option<LegOneAngle> {
        let t = cubic.maximum()?;
        let l1 = self.mechanism.geometry.L1;
        let rounding = if t < 1.0 && is_nearly_level(self.mechanism, self.at_zero) {
            RESIDUAL_TOLERANCE * cubic.magnitude(t)
        } else {
            2.0 * RESIDUAL_TOLERANCE * l1 * l1 * t * (2.0 - t)
        };
        let inside = (0.0..2.0).contains(&t) && cubic.value(t) >= -rounding;
        inside.then(|| self.angle(1.0, t, true))
    }

    /// The angle with the least error of the closure, for a leg that does not reach.
    #[cold]
    pub(crate) fn closest(&self) -> LegOneAngle {
        self.angle(1.0, self.best_t(), true)
    }

    /// The greatest value of (15), over R1² L1²; for R1 = r1 the square of leg I's height, over L1². It is negative out
    /// of reach.
    #[inline]
    pub(crate) fn closing_margin(&self) -> f64 {
        let l1 = self.mechanism.geometry.L1;
        if self.mechanism.is_delta() {
            // (15) vanishes at a = 0 for every position. Leg I closes there where the square of its height allows it.
            return (self.at_zero - self.y * self.y) / (l1 * l1);
        }
        self.cubic(1.0).value(self.best_t()) / (l1 * l1)
    }

    #[inline]
    fn best_t(&self) -> f64 {
        self.cubic(1.0).maximum().unwrap_or(2.0).clamp(0.0, 2.0)
    }

    /// w1² + y² at c = `sign`.
    #[inline(always)]
    fn square_at(&self, sign: f64) -> f64 {
        if sign > 0.0 { self.at_zero } else { square_at_pi(self.mechanism, self.x, self.at_zero) }
    }

    #[inline(always)]
    fn cubic(&self, sign: f64) -> Cubic {
        let d = self.mechanism;
        let k = sign * d.k;
        let y_square = self.y * self.y;
        let per_square = self.mechanism.inverse_r1_square * y_square;
        let p = self.square_at(sign);
        // C - k without cancellation.
        let nearest = if sign > 0.0 { d.gap_square } else { d.c - k };
        Cubic([-nearest * per_square, 2.0 * p - k * per_square, -(p + 2.0 * k), k])
    }

    /// The angle of c = `sign` (1 - t).
    #[inline(always)]
    fn angle(&self, sign: f64, t: f64, merged: bool) -> LegOneAngle {
        let g = &self.mechanism.geometry;
        let c = sign * (1.0 - t);
        let sine = greater(t * (2.0 - t), 0.0).sqrt();
        let u = g.R1 * c - g.r1;
        let s = -sine.copysign(self.y * u);
        let square = self.square_at(sign) - sign * self.mechanism.k * t - self.y * self.y;
        let v = g.R1 * sine;
        let w1 = if (square > LARGE * g.L1 * g.L1) | (v == 0.0) {
            greater(square, 0.0).sqrt()
        } else {
            (self.y * u / v).abs()
        };
        LegOneAngle { c, s, w1, merged }
    }
}
