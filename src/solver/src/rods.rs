//! The six rods of a posture in space.

use crate::machine::{Geometry, Machine};
use crate::posture::Posture;

/// Number of each rod: leg, then rod of the leg.
pub(crate) const RODS: [u8; 6] = [11, 12, 21, 22, 31, 32];
/// Family of each rod: rod 11, rod 12, leg II, leg III. A parallelogram's two rods are parallel.
pub(crate) const FAMILY: [usize; 6] = [0, 1, 2, 2, 3, 3];

/// Rod vectors B - A by family, and what the posture's angle contributes.
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
    #[inline]
    pub(crate) fn of(machine: &Machine, posture: &Posture) -> Self {
        let g = machine.geometry();
        let pose = &posture.pose;
        let (s, c) = pose.alpha.sin_cos();
        let w = posture.rho.map(|rho| pose.z - rho);
        let (e1, e2) = (machine.derived.e1, machine.derived.e2);
        Self::new(g, [pose.x + e1, pose.x + e2], pose.y, w, [c, s])
    }

    #[inline]
    pub(crate) fn new(g: &Geometry, x: [f64; 2], y: f64, w: [f64; 3], [c, s]: [f64; 2]) -> Self {
        let (u, v) = (g.R1 * c - g.r1, g.R1 * s);
        let (p, q) = (g.R2 * c - g.r4, g.R2 * s);
        let vectors = [
            [x[0], y + u, w[0] + v],
            [x[0], y - u, w[0] - v],
            [x[1], y - p, w[1] - q],
            [x[1], y + p, w[2] + q],
        ];
        let inverse = [1.0 / g.L1, 1.0 / g.L1, 1.0 / g.L2, 1.0 / g.L3];
        let directions = std::array::from_fn(|i| vectors[i].map(|component| component * inverse[i]));
        Self { vectors, directions, c, s }
    }

    /// Slider ends A of the six rods. The platform stands at the origin of z: only differences
    /// between rods matter to those who ask.
    #[inline]
    pub(crate) fn slider_ends(&self, g: &Geometry, x: [f64; 2], y: f64) -> [[f64; 3]; 6] {
        let half = g.parallelogram_half_width;
        let ends = [
            [x[0], y + g.R1 * self.c, g.R1 * self.s],
            [x[0], y - g.R1 * self.c, -g.R1 * self.s],
            [x[1] - half, y - g.R2 * self.c, -g.R2 * self.s],
            [x[1] + half, y - g.R2 * self.c, -g.R2 * self.s],
            [x[1] - half, y + g.R2 * self.c, g.R2 * self.s],
            [x[1] + half, y + g.R2 * self.c, g.R2 * self.s],
        ];
        std::array::from_fn(|i| {
            let vector = self.vectors[FAMILY[i]];
            std::array::from_fn(|axis| ends[i][axis] - vector[axis])
        })
    }
}
