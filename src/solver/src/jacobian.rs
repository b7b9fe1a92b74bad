//! Differential kinematics: parallel and serial singularities.

use crate::machine::{Geometry, Machine};
use crate::posture::Posture;

/// The dimensionless 4×4 matrix of rods 11, 12, leg II, leg III (rows, divided by the rod length)
/// against x, y, z, R1 alpha (columns).
pub type ParallelMatrix = [[f64; 4]; 4];

/// How a posture stands to singularities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conditioning {
    /// Determinant of the parallel matrix, `det_P`; zero at a parallel (type 2) singularity.
    pub det: f64,
    /// Condition number of the parallel matrix in the 2-norm; `None` where it is singular.
    pub condition_number: Option<f64>,
    /// Cosine between each rod (11, 12, II, III) and its guideway; zero at a serial singularity.
    pub serial: [f64; 4],
}

/// The parallel matrix of a posture.
pub fn parallel_matrix(machine: &Machine, posture: &Posture) -> ParallelMatrix {
    let _ = (machine, posture);
    [[0.0; 4]; 4]
}

/// Determinant and condition number of the parallel matrix, and the serial cosines.
pub fn conditioning(machine: &Machine, posture: &Posture) -> Conditioning {
    let _ = (machine, posture);
    unimplemented!()
}

/// Rates d(x, y, z, alpha)/d(rho1, rho2, rho3); `None` at a parallel singularity.
pub fn velocities(machine: &Machine, posture: &Posture) -> Option<[[f64; 3]; 4]> {
    let _ = (machine, posture);
    None
}

pub(crate) fn det_at_home(g: &Geometry) -> f64 {
    let _ = g;
    1.0
}
