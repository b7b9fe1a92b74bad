//! A pose of the platform at which leg I closes.

use std::f64::consts::PI;

use crate::fast_math::{greater, sin_cos_of_turn, wrapped};
use crate::loop_closure::Root;
use crate::mechanism::Mechanism;
use crate::pose::Point;
use crate::posture::Side;
use crate::residual::{CORRECTION_THRESHOLD, RESIDUAL_TOLERANCE};

/// A pose of the platform at which leg I closes.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegOnePose {
    /// P, mm.
    pub(super) p: Point,
    pub(super) alpha: f64,
    /// cos and sin of the root.
    pub(super) c: f64,
    pub(super) s: f64,
    /// cos and sin of the returned `alpha`, not of the root: the check starts from them.
    pub(super) checked: [f64; 2],
    pub(super) w1: f64,
    pub(super) leg_one: ClosedLeg,
    pub(super) merged: bool,
    /// The magnitude of the numbers from which P was computed: it scales their rounding.
    magnitude: f64,
}

/// One way to close a leg: its slider's position, and the rod length's error there.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClosedLeg {
    pub(super) rho: f64,
    pub(super) side: Side,
    pub(super) error: f64,
}

impl LegOnePose {
    /// The platform at `p` with leg I at a root. `magnitude` is that of the numbers from which both were computed.
    #[inline(always)]
    pub(super) fn new(mechanism: &Mechanism, p: Point, root: &Root, magnitude: f64) -> Self {
        let alpha = wrapped(root.a);
        let (s, c) = sin_cos_of_turn(alpha);
        let leg_one = close_leg_one(mechanism, p, [c, s], root.w);
        let Root { c: root_c, s: root_s, w: w1, merged, .. } = *root;
        Self { p, alpha, c: root_c, s: root_s, checked: [c, s], w1, leg_one, merged, magnitude }
    }

    /// Leg I closed from the other side, if P does not depend on the angle: (c, -s, -w1) satisfies (A) if (c, s, w1)
    /// does.
    #[inline(always)]
    pub(super) fn mirrored(&self, mechanism: &Mechanism) -> Self {
        let alpha = if self.alpha == PI { PI } else { 0.0 - self.alpha };
        let checked = [self.checked[0], -self.checked[1]];
        let leg_one = close_leg_one(mechanism, self.p, checked, -self.w1);
        Self { alpha, s: -self.s, checked, w1: -self.w1, leg_one, ..*self }
    }

    /// Whether a leg's rod-length error is small enough for a solution. A NaN is not.
    #[inline(always)]
    pub(super) fn accepts(&self, leg: &ClosedLeg) -> bool {
        leg.error <= RESIDUAL_TOLERANCE * self.magnitude
    }

    /// Whether leg I closes within the last digits.
    #[inline(always)]
    pub(super) fn is_precise(&self) -> bool {
        self.leg_one.error <= CORRECTION_THRESHOLD * self.magnitude
    }
}

/// Leg I with the returned direction (c, s) of the platform.
#[inline(always)]
fn close_leg_one(mechanism: &Mechanism, [x, y, z]: Point, [c, s]: [f64; 2], w1: f64) -> ClosedLeg {
    let g = &mechanism.geometry;
    let rho = z - w1;
    let (u, v, w) = (g.R1 * c - g.r1, g.R1 * s, z - rho);
    let x = x + mechanism.e1;
    let scale = 0.5 * mechanism.inverse_lengths[0];
    let error = |y: f64, z: f64| ((x * x + y * y + (z - g.L1) * (z + g.L1)) * scale).abs();
    ClosedLeg { rho, side: Side::of(w1), error: greater(error(y + u, w + v), error(y - u, w - v)) }
}
