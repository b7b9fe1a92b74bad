//! Leg I's loop closure along a locus of P.

use super::leg_one_height::{
    is_nearly_level, rounded_square_at_pi, rounded_square_at_zero, signed_root, square_at_pi, square_at_zero,
};
use super::platform_locus::PlatformLocus;
use crate::loop_closure::{CONVERGED_STEP, Equations, LoopClosure, Root};
use crate::mechanism::Mechanism;
use crate::registers::ROWS;
use crate::residual::RESIDUAL_TOLERANCE;
use crate::trig_polynomial::{TrigPolynomial, linear};

/// Relative rounding error of a leg that is nearly level: its height has all its digits.
const LEVEL_ROUNDING: f64 = 1e-14;

/// Leg I along a locus: y u + w1 v = 0 and X1² + y² + C - k cos a + w1² = L1², equations (A), in
/// (a, w1). Eliminating w1 gives (15), of the third degree on the circle.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegOneClosure {
    y: [f64; 3],
    r1_platform: f64,
    r1_slider: f64,
    c: f64,
    k: f64,
    /// L1² - X1² - C.
    e: f64,
    /// E + k and E - k.
    ends: [f64; 2],
    /// Whether one of them is small: leg I can then be level near this x, y and angle.
    nearly_level: bool,
    scale: f64,
    converged_step: f64,
}

impl LegOneClosure {
    #[inline]
    pub(super) fn new(mechanism: &Mechanism, locus: &PlatformLocus) -> Self {
        let at_zero = square_at_zero(mechanism, locus.x);
        let ends = [at_zero, square_at_pi(mechanism, locus.x, at_zero)];
        let nearly_level = ends.iter().any(|end| is_nearly_level(mechanism, *end));
        Self { nearly_level, ..Self::of_parts(mechanism, locus.y, ends, converged_step(mechanism, locus)) }
    }

    /// The closure from y of the locus, E + k and E - k, and the last step, where leg I is not nearly level.
    #[inline(always)]
    fn of_parts(mechanism: &Mechanism, y: [f64; 3], ends: [f64; 2], converged_step: f64) -> Self {
        let g = &mechanism.geometry;
        Self {
            y,
            r1_platform: g.R1,
            r1_slider: g.r1,
            c: mechanism.c,
            k: mechanism.k,
            e: ends[0] - mechanism.k,
            ends,
            nearly_level: false,
            scale: mechanism.longest,
            converged_step,
        }
    }

    /// u and v.
    #[inline(always)]
    fn arm(&self, c: f64, s: f64) -> [f64; 2] {
        [self.r1_platform * c - self.r1_slider, self.r1_platform * s]
    }

    #[inline(always)]
    fn y(&self, c: f64, s: f64) -> f64 {
        self.y[0] + self.y[1] * c + self.y[2] * s
    }

    /// w1², from the nearer of the angles 0 and π, where it may be small.
    #[inline(always)]
    fn height_square(&self, y: f64, c: f64, s: f64) -> f64 {
        let bend = self.k * s * s;
        let end = if c > 0.0 { self.ends[0] - bend / (1.0 + c) } else { self.ends[1] + bend / (1.0 - c) };
        end - y * y
    }

    /// The distance by which leg I fails to close at an angle, mm: |v| w1 - |y u| over the length of (u, v), which is
    /// positive between the two roots; or the missing height where w1 is imaginary.
    pub(super) fn closing_margin(&self, c: f64, s: f64) -> f64 {
        let ([u, v], y) = (self.arm(c, s), self.y(c, s));
        let square = self.height_square(y, c, s);
        let arm = u.hypot(v);
        if arm == 0.0 {
            return signed_root(square);
        }
        let offset = (y * u).abs() / arm;
        if square < 0.0 { signed_root(square) - offset } else { v.abs() * square.sqrt() / arm - offset }
    }
}

/// [`LoopClosure::converged_step`]. A long arm bends the closure by as much as it is longer than the machine.
#[inline(always)]
fn converged_step(mechanism: &Mechanism, locus: &PlatformLocus) -> f64 {
    CONVERGED_STEP * mechanism.longest / (mechanism.longest + locus.y[1].abs() + locus.y[2].abs())
}

/// The closures of many rows, by coordinate.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegOneClosureRows {
    y: [[f64; ROWS]; 3],
    at_zero: [f64; ROWS],
    converged_step: [f64; ROWS],
}

impl LegOneClosureRows {
    pub(super) fn new() -> Self {
        Self { y: [[0.0; ROWS]; 3], at_zero: [0.0; ROWS], converged_step: [0.0; ROWS] }
    }

    /// Prepares a row. Returns whether [`Self::closure`] is [`LegOneClosure::new`]: whether leg I is not nearly level.
    #[inline(always)]
    pub(super) fn set(&mut self, i: usize, mechanism: &Mechanism, locus: &PlatformLocus) -> bool {
        let at_zero = rounded_square_at_zero(mechanism, locus.x);
        let at_pi = rounded_square_at_pi(mechanism, at_zero);
        for (row, number) in self.y.iter_mut().zip(locus.y) {
            row[i] = number;
        }
        self.at_zero[i] = at_zero;
        self.converged_step[i] = converged_step(mechanism, locus);
        !(is_nearly_level(mechanism, at_zero) | is_nearly_level(mechanism, at_pi))
    }

    #[inline(always)]
    pub(super) fn closure(&self, mechanism: &Mechanism, i: usize) -> LegOneClosure {
        let at_zero = self.at_zero[i];
        let ends = [at_zero, rounded_square_at_pi(mechanism, at_zero)];
        LegOneClosure::of_parts(mechanism, self.y.each_ref().map(|row| row[i]), ends, self.converged_step[i])
    }
}

impl LoopClosure<4> for LegOneClosure {
    #[inline]
    fn polynomial(&self) -> (TrigPolynomial<4>, f64) {
        let y = linear(self.y[0], self.y[1], self.y[2]);
        let half = 0.5 * self.r1_platform * self.r1_platform;
        let v_square = TrigPolynomial { cos: [half, 0.0, -half], sin: [0.0; 3] };
        let from_y = y.times(&y).times_even(self.c, -self.k);
        let poly = from_y.plus(1.0, &v_square.times_even(-self.e, -self.k));
        let size = y.bound(0);
        let magnitude = size * size * (self.c + self.k) + 2.0 * half * (self.e.abs() + self.k);
        (poly, magnitude)
    }

    #[inline(always)]
    fn equations(&self, c: f64, s: f64, w: f64) -> Equations {
        let ([u, v], y) = (self.arm(c, s), self.y(c, s));
        let dy = self.y[2] * c - self.y[1] * s;
        let quadratic = if self.nearly_level {
            w * w - self.height_square(y, c, s)
        } else {
            y * y + w * w - self.k * c - self.e
        };
        Equations {
            f: [y * u + w * v, quadratic],
            da: [dy * u - y * v + w * self.r1_platform * c, 2.0 * y * dy + self.k * s],
            dw: [v, 2.0 * w],
        }
    }

    #[inline(always)]
    fn branches(&self, c: f64, s: f64) -> Option<[f64; 2]> {
        let square = self.discriminant(c, s);
        (square >= 0.0).then(|| [square.sqrt(), -square.sqrt()])
    }

    #[inline]
    fn w_at_root(&self, c: f64, s: f64) -> f64 {
        let ([u, v], y) = (self.arm(c, s), self.y(c, s));
        let square = self.height_square(y, c, s);
        let moment = -y * u * v;
        // The better of two formulas, as in the cubic: near v = 0 the quotient is 0/0.
        if square > 0.01 * (self.e.abs() + self.k) { square.sqrt().copysign(moment) } else { -y * u / v }
    }

    #[inline(always)]
    fn w_scale(&self) -> f64 {
        self.scale
    }

    #[inline(always)]
    fn discriminant(&self, c: f64, s: f64) -> f64 {
        self.height_square(self.y(c, s), c, s)
    }

    fn rounding(&self, c: f64, s: f64, w: f64) -> f64 {
        // Both equations are squares of lengths: their sizes are alike.
        let size = self.scale * self.scale;
        if self.nearly_level {
            let [u, v] = self.arm(c, s);
            let y = self.y[0].abs() + (self.y[1] * c).abs() + (self.y[2] * s).abs();
            return LEVEL_ROUNDING * (y * u.abs() + (w * v).abs()).min(size);
        }
        2.0 * RESIDUAL_TOLERANCE * size
    }

    #[inline(always)]
    fn converged_step(&self, root: &Root) -> f64 {
        // Near a level leg the closure bends within a and w1 themselves.
        let bend =
            if self.nearly_level { (root.s.abs() + root.w.abs() / self.scale).clamp(1e-9, 1.0) } else { 1.0 };
        self.converged_step * bend
    }
}
