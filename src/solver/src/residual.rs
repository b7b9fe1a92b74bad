//! The check that every solution passes before it leaves the solver: back into Eqs (3)-(6).

use crate::machine::Machine;
use crate::pose::PlatformPose;

/// Largest rod-length error of a solution, relative to the size of its numbers. Evaluating the
/// equations rounds by a few 1e-16 of that size; a hundred times as much is no solution.
pub const RESIDUAL_TOLERANCE: f64 = 1e-13;

/// The largest error of a rod's length, (|B - A|² - L²) / 2L, over Eqs (3)-(6), in mm.
#[inline]
pub(crate) fn residual(machine: &Machine, pose: &PlatformPose, rho: [f64; 3]) -> f64 {
    let (s, c) = pose.alpha.sin_cos();
    let g = machine.geometry();
    let (u, v) = (g.R1 * c - g.r1, g.R1 * s);
    let (p, q) = (g.R2 * c - g.r4, g.R2 * s);
    let (x1, x2) = (pose.x + machine.derived.e1, pose.x + machine.derived.e2);
    let w = rho.map(|rho| pose.z - rho);
    let error =
        |x: f64, y: f64, z: f64, length: f64| (x * x + y * y + (z - length) * (z + length)) * (0.5 / length);
    let errors = [
        error(x1, pose.y + u, w[0] + v, g.L1),
        error(x1, pose.y - u, w[0] - v, g.L1),
        error(x2, pose.y - p, w[1] - q, g.L2),
        error(x2, pose.y + p, w[2] + q, g.L3),
    ];
    errors.iter().fold(0.0, |worst: f64, error| worst.max(error.abs()))
}

/// The residual that a solution of this size may have: a pose far along z is rounded with its z.
#[inline]
pub(crate) fn tolerance(machine: &Machine, z: f64) -> f64 {
    RESIDUAL_TOLERANCE * (machine.derived.scale + z.abs())
}
