//! How the platform moves with the sliders at one place of a program.

use crate::machine::Machine;
use crate::parallel_matrix::{ParallelMatrix, inverse, matrix};
use crate::pose::PlatformPose;
use crate::rods::Rods;

/// Eqs (3)-(6) differentiated at one place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Differential {
    /// The inverse of the parallel matrix.
    inverse: ParallelMatrix,
    /// Cosine between the guideway and rods 11, 12, 21 and 31.
    cosines: [f64; 4],
    radius: f64,
    /// The matrix' determinant.
    pub(super) det: f64,
}

impl Differential {
    /// `None` at a parallel singularity.
    pub(super) fn of(machine: &Machine, rods: &Rods) -> Option<Self> {
        let g = machine.geometry();
        let (det, inverse) = inverse(&matrix(g, rods))?;
        Some(Self { inverse, cosines: rods.directions.map(|direction| direction[2]), radius: g.R1, det })
    }

    /// Rates of the platform's pose for these rates of the sliders.
    pub(super) fn pose_rates(&self, [first, second, third]: [f64; 3]) -> PlatformPose {
        let z = self.cosines;
        self.pose_change([z[0] * first, z[1] * first, z[2] * second, z[3] * third])
    }

    /// The change of the platform's pose for changes of the rods' lengths, to the first order.
    pub(super) fn pose_change(&self, [a, b, c, d]: [f64; 4]) -> PlatformPose {
        let [x, y, z, arc] = self.inverse.map(|row| row[0] * a + row[1] * b + row[2] * c + row[3] * d);
        PlatformPose { x, y, z, alpha: arc / self.radius }
    }
}
