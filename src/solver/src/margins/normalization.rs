//! Factors that make margins comparable: lengths, angles and plain numbers.

use crate::machine::data::Limits;
use crate::mechanism::Geometry;

/// The reciprocal of each constraint's own range: the stroke, the rod's length, the cone's half-angle, the value at
/// home, the table's range. For heights over the table it is that of the longest stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Normalization {
    pub(super) stroke: [f64; 3],
    pub(super) leg_length: [f64; 3],
    pub(super) serial_singularity: f64,
    pub(super) parallel_singularity: f64,
    pub(super) slider_joint: f64,
    pub(super) platform_joint: f64,
    pub(super) rod_crossing: f64,
    pub(super) rod_interference: f64,
    pub(super) tilt: f64,
    pub(super) rotary: f64,
    pub(super) table_clearance: f64,
}

impl Normalization {
    /// The factors of a machine with this determinant and this distance between rods at home.
    pub(crate) fn new(g: &Geometry, limits: &Limits, home_det: f64, rod_distance: f64) -> Self {
        let inverse_width = |[low, high]: [f64; 2]| 1.0 / (high - low);
        Self {
            stroke: limits.stroke.map(inverse_width),
            leg_length: [1.0 / g.L1, 1.0 / g.L2, 1.0 / g.L3],
            serial_singularity: 1.0,
            parallel_singularity: 1.0 / home_det.abs(),
            slider_joint: 1.0 / limits.slider_cone,
            platform_joint: 1.0 / limits.platform_cone,
            // With R1 = r1 the rods cross as soon as the platform turns.
            rod_crossing: 1.0 / if g.R1 == g.r1 { g.R1 } else { g.R1 - g.r1 },
            rod_interference: 1.0 / rod_distance,
            tilt: inverse_width(limits.tilt),
            // Without a limit there is no margin to compare.
            rotary: limits.rotary.map_or(0.0, inverse_width),
            // The sliders move the platform up and down by their strokes.
            table_clearance: 1.0
                / limits.stroke.map(|[low, high]| high - low).into_iter().fold(0.0, f64::max),
        }
    }
}
