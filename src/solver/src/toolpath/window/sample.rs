//! Examined values of a parameter.

use crate::toolpath::report::LeastMargin;

/// Distance of the ends of an interval from a value with which the machine cannot run the program, in the unit of the
/// parameter.
pub const WINDOW_PRECISION: f64 = 1e-6;

/// What is known about a value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub(super) value: f64,
    pub(super) is_feasible: bool,
    /// The worst margin as a fraction of its range; its sign is that of the verdict.
    pub(super) fraction: f64,
    pub(super) worst: Option<LeastMargin>,
}

/// Values at which the whole program was planned.
pub(super) struct Found {
    pub(super) samples: Vec<Sample>,
    pub(super) resolution: f64,
}
