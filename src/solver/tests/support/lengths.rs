//! The lengths of a machine.

#![allow(dead_code, reason = "each test takes what it wants")]

use verne_solver::Machine;
use verne_solver::machine::Geometry;

/// The largest dimension that the equations hold, the measure of everything.
pub(crate) fn scale(machine: &Machine) -> f64 {
    let g = &machine.data().geometry;
    [g.L1, g.L2, g.L3, g.R1, g.r1, g.R2, g.r4, (g.D1 - g.d1).abs(), (g.D2 - g.d2).abs()]
        .into_iter()
        .fold(0.0, f64::max)
}

/// The lengths of a machine's legs and platform.
pub(crate) fn lengths(geometry: &mut Geometry) -> [&mut f64; 13] {
    let g = geometry;
    [
        &mut g.D1,
        &mut g.d1,
        &mut g.D2,
        &mut g.d2,
        &mut g.R1,
        &mut g.r1,
        &mut g.R2,
        &mut g.r4,
        &mut g.L1,
        &mut g.L2,
        &mut g.L3,
        &mut g.parallelogram_half_width,
        &mut g.rod_radius,
    ]
}
