//! The locus of P: its position as a function of the platform angle.

use super::leg_one_pose::LegOnePose;
use crate::loop_closure::Root;
use crate::mechanism::Mechanism;
use crate::pose::Point;
use crate::residual::magnitude;

/// P = (x, y0 + yc cos a + ys sin a, z0 + zc cos a + zs sin a): the position of the platform for each of its angles,
/// for a tool given in the base or the part frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlatformLocus {
    pub(super) x: f64,
    /// y0, yc, ys.
    pub(super) y: [f64; 3],
    /// z0, zc, zs.
    pub(super) z: [f64; 3],
}

impl PlatformLocus {
    /// A platform that stays at one point.
    pub(super) fn fixed([x, y, z]: Point) -> Self {
        Self { x, y: [y, 0.0, 0.0], z: [z, 0.0, 0.0] }
    }

    /// P at an angle.
    #[inline(always)]
    pub(super) fn at(&self, c: f64, s: f64) -> Point {
        let ([y0, yc, ys], [z0, zc, zs]) = (self.y, self.z);
        [self.x, y0 + yc * c + ys * s, z0 + zc * c + zs * s]
    }

    /// The point, if P does not depend on the angle.
    pub(super) fn fixed_point(&self) -> Option<Point> {
        (!self.moves()).then_some([self.x, self.y[0], self.z[0]])
    }

    /// Whether P depends on the angle.
    #[inline(always)]
    pub(super) fn moves(&self) -> bool {
        let ([_, yc, ys], [_, zc, zs]) = (self.y, self.z);
        (yc != 0.0) | (ys != 0.0) | (zc != 0.0) | (zs != 0.0)
    }

    /// The platform's pose at a root of leg I's closure.
    #[inline(always)]
    pub(super) fn pose(&self, mechanism: &Mechanism, root: &Root) -> LegOnePose {
        let p = self.at(root.c, root.s);
        let magnitude = magnitude(mechanism, p[2]) + self.y[1].abs() + self.y[2].abs();
        LegOnePose::new(mechanism, p, root, magnitude)
    }
}
