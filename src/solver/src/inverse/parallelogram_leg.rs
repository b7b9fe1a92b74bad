//! Legs II and III, whose two rods form a parallelogram, for a known pose of the platform.

use super::leg_one_pose::{ClosedLeg, LegOnePose};
use crate::mechanism::Mechanism;
use crate::posture::Side;

/// Threshold relative to L² below which the square of a leg's height is zero up to rounding. The two sides of the leg
/// are then one.
const ZERO_HEIGHT: f64 = 8.0 * f64::EPSILON;

/// Leg II or III for a known pose of the platform.
#[derive(Clone, Copy, Debug)]
pub(super) struct ParallelogramLeg<'a> {
    pose: &'a LegOnePose,
    length: f64,
    half_inverse: f64,
    x: f64,
    /// p and q with their signs, from the root.
    root: [f64; 2],
    /// p and q with their signs, from the returned angle.
    checked: [f64; 2],
}

/// Height of leg II or III, mm: its extent along z. Zero if its two sides have merged.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegHeight {
    pub(super) value: f64,
    pub(super) merged: bool,
}

impl<'a> ParallelogramLeg<'a> {
    /// Legs II and III.
    #[inline(always)]
    pub(super) fn both(mechanism: &Mechanism, pose: &'a LegOnePose) -> [Self; 2] {
        let g = &mechanism.geometry;
        let [c, s] = pose.checked;
        let x = pose.p[0] + mechanism.e2;
        let (root, checked) = ([g.R2 * pose.c - g.r4, g.R2 * pose.s], [g.R2 * c - g.r4, g.R2 * s]);
        let leg = |sign: f64, length, inverse: f64| {
            let (root, checked) = (root.map(|arm| sign * arm), checked.map(|arm| sign * arm));
            Self { pose, length, half_inverse: 0.5 * inverse, x, root, checked }
        };
        let [_, _, inverse2, inverse3] = mechanism.inverse_lengths;
        [leg(-1.0, g.L2, inverse2), leg(1.0, g.L3, inverse3)]
    }

    /// The square of the leg's height.
    #[inline(always)]
    pub(super) fn height_square(&self) -> f64 {
        let y = self.pose.p[1] + self.root[0];
        (self.length - self.x) * (self.length + self.x) - y * y
    }

    /// The rounding error of that square.
    #[inline(always)]
    pub(super) fn rounding(&self) -> f64 {
        ZERO_HEIGHT * self.length * self.length
    }

    /// The leg's height; `None` if it does not reach.
    #[inline(always)]
    pub(super) fn height(&self) -> Option<LegHeight> {
        let (square, rounding) = (self.height_square(), self.rounding());
        let merged = square <= rounding;
        (square >= -rounding).then(|| LegHeight { value: if merged { 0.0 } else { square.sqrt() }, merged })
    }

    /// The leg with its slider above, and below.
    #[inline(always)]
    pub(super) fn sides(&self, height: f64) -> [ClosedLeg; 2] {
        [self.close(Side::Above, height), self.close(Side::Below, height)]
    }

    #[inline(always)]
    pub(super) fn close(&self, side: Side, height: f64) -> ClosedLeg {
        let [_, y, z] = self.pose.p;
        let rho = z + self.root[1] - side.sign() * height;
        let (y, z) = (y + self.checked[0], z + self.checked[1] - rho);
        let square = self.x * self.x + y * y + (z - self.length) * (z + self.length);
        ClosedLeg { rho, side, error: (square * self.half_inverse).abs() }
    }
}
