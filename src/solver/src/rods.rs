//! The six rods of a posture in space.

use crate::fast_math::sin_cos;
use crate::mechanism::{Geometry, Mechanism};
use crate::pose::PlatformPose;

/// Number of each rod: leg, then rod of the leg.
pub(crate) const RODS: [u8; 6] = [11, 12, 21, 22, 31, 32];
/// Family of each rod: rod 11, rod 12, leg II, leg III. A parallelogram's two rods are parallel.
pub(crate) const FAMILY: [usize; 6] = [0, 1, 2, 2, 3, 3];

/// Rod vectors B - A by family, and cosine and sine of the posture's angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rods {
    /// B - A of rod 11, rod 12, leg II, leg III, mm.
    pub(crate) vectors: [[f64; 3]; 4],
    /// The same over the rod's length.
    pub(crate) directions: [[f64; 3]; 4],
    pub(crate) c: f64,
    pub(crate) s: f64,
}

impl Rods {
    #[inline(always)]
    pub(crate) fn of(mechanism: &Mechanism, pose: &PlatformPose, rho: [f64; 3]) -> Self {
        Self::with_angle(mechanism, pose, rho, sin_cos(pose.alpha))
    }

    /// The same from the sine and cosine of alpha.
    #[inline(always)]
    pub(crate) fn with_angle(
        mechanism: &Mechanism,
        pose: &PlatformPose,
        rho: [f64; 3],
        (s, c): (f64, f64),
    ) -> Self {
        let vectors = vectors_of(mechanism, pose, rho, [c, s]);
        Self::from_vectors(vectors, &mechanism.inverse_lengths, [c, s])
    }

    #[inline(always)]
    pub(crate) fn new(
        g: &Geometry,
        inverse: &[f64; 4],
        x: [f64; 2],
        y: f64,
        w: [f64; 3],
        [c, s]: [f64; 2],
    ) -> Self {
        Self::from_vectors(vectors(g, x, y, w, [c, s]), inverse, [c, s])
    }

    #[inline(always)]
    fn from_vectors(vectors: [[f64; 3]; 4], inverse: &[f64; 4], [c, s]: [f64; 2]) -> Self {
        let scaled = |i: usize| vectors[i].map(|component| component * inverse[i]);
        let directions = [scaled(0), scaled(1), scaled(2), scaled(3)];
        Self { vectors, directions, c, s }
    }

    /// Platform ends B of the six rods from P, in the base frame's directions.
    #[inline(always)]
    pub(crate) fn platform_ends(&self, mechanism: &Mechanism) -> [[f64; 3]; 6] {
        let (g, [along, across]) = (&mechanism.geometry, mechanism.pair_offset);
        let (first, others) = ([g.R1 * self.c, g.R1 * self.s], [g.R2 * self.c, g.R2 * self.s]);
        [
            [g.D1, first[0], first[1]],
            [g.D1, -first[0], -first[1]],
            [g.D2 + along, -others[0] + across, -others[1]],
            [g.D2 - along, -others[0] - across, -others[1]],
            [g.D2 + along, others[0] - across, others[1]],
            [g.D2 - along, others[0] + across, others[1]],
        ]
    }
}

/// B - A by family, from the platform's direction (c, s).
#[inline(always)]
pub(crate) fn vectors_of(
    mechanism: &Mechanism,
    pose: &PlatformPose,
    rho: [f64; 3],
    direction: [f64; 2],
) -> [[f64; 3]; 4] {
    let (e1, e2) = (mechanism.e1, mechanism.e2);
    let w = rho.map(|rho| pose.z - rho);
    vectors(&mechanism.geometry, [pose.x + e1, pose.x + e2], pose.y, w, direction)
}

#[inline(always)]
fn vectors(g: &Geometry, x: [f64; 2], y: f64, w: [f64; 3], [c, s]: [f64; 2]) -> [[f64; 3]; 4] {
    let (u, v) = (g.R1 * c - g.r1, g.R1 * s);
    let (p, q) = (g.R2 * c - g.r4, g.R2 * s);
    [[x[0], y + u, w[0] + v], [x[0], y - u, w[0] - v], [x[1], y - p, w[1] - q], [x[1], y + p, w[2] + q]]
}
