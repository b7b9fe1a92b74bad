//! A solution of the brute-force search.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector4;
use verne_solver::{Mode, PlatformPose, Posture, Side};

use super::legs::Legs;

/// Beyond this amplification of errors a solution is about to merge with another: the two are some
/// 1e-5 machine lengths apart, a hundredth of a millimetre on a metre.
const WEAK: f64 = 1e5;

/// One solution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    /// x, y, z, alpha.
    pub(crate) q: Vector4<f64>,
    pub(crate) rho: [f64; 3],
    pub(crate) working: bool,
    /// s1, s2, s3, crossed, by the signs of the quantities that define them.
    pub(crate) mode: Mode,
    /// The signs above are beyond doubt.
    pub(crate) signs_certain: bool,
    /// By how much an error of a rod's length becomes an error of the solution.
    pub(crate) amplification: f64,
}

/// All solutions.
#[derive(Debug, Default)]
pub(crate) struct Answer {
    pub(crate) found: Vec<Found>,
    /// Poses where two solutions have met, or will, as closely as double precision can tell.
    pub(crate) touches: Vec<Vector4<f64>>,
    /// A whole curve of solutions.
    pub(crate) continuum: bool,
}

impl Found {
    /// Labels a pose and slider positions that satisfy the equations.
    pub(crate) fn new(legs: &Legs, mut q: Vector4<f64>, rho: [f64; 3], amplification: f64) -> Self {
        q[3] = wrapped(q[3]);
        let drops = [11, 12, 21, 31].map(|rod| legs.rod(rod, &q, &rho).z);
        let lead = q[2] - rho[0];
        let uncrossed = legs.g.R1 * q[3].cos() - legs.g.r1;
        let side = |drop: f64| if drop > 0.0 { Side::Above } else { Side::Below };
        let sure = 1e-9 * legs.scale() * amplification.max(1.0);
        let defining = [lead, uncrossed, drops[0], drops[1], drops[2], drops[3]];
        Self {
            q,
            rho,
            working: drops.iter().all(|&drop| drop > 0.0) && uncrossed > 0.0,
            mode: Mode { legs: [side(lead), side(drops[2]), side(drops[3])], crossed: uncrossed < 0.0 },
            signs_certain: defining.iter().all(|value| value.abs() > sure),
            amplification,
        }
    }

    /// About to merge with another solution.
    pub(crate) fn weak(&self) -> bool {
        self.amplification > WEAK
    }

    /// The same as the solver would return it.
    pub(crate) fn posture(&self, legs: &Legs) -> Posture {
        Posture {
            pose: PlatformPose { x: self.q[0], y: self.q[1], z: self.q[2], alpha: self.q[3] },
            rho: self.rho,
            mode: self.mode,
            working: self.working,
            merged: false,
            residual: legs.residual(&self.q, &self.rho),
        }
    }
}

/// An angle in (-π, π].
pub(crate) fn wrapped(angle: f64) -> f64 {
    let turned = angle - TAU * (angle / TAU).round();
    if turned <= -PI { turned + TAU } else { turned }
}
