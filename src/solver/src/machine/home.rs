//! Values of the home posture, x = y = alpha = 0 with all sliders above: the scale of margins.

use nalgebra::Vector3;

use super::data::Limits;
use crate::axis::direction;
use crate::margins::cone::{Columns, columns};
use crate::margins::interference;
use crate::mechanism::Mechanism;
use crate::parallel_matrix::{determinant, matrix};
use crate::rods::Rods;

/// Least distance, mm, that scales rod interference for machines whose rods cross at home.
const LEAST_ROD_DISTANCE: f64 = 1e-3;

/// Values of the home posture, and the cone axes, which may stem from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Home {
    /// Unit axes of the slider cones (base frame) and platform cones (platform frame).
    pub(crate) slider_axes: Columns,
    pub(crate) platform_axes: Columns,
    /// `det_P`; its sign is the machine's.
    pub(crate) det: f64,
    /// Height of each leg, mm.
    pub(crate) heights: [f64; 3],
    /// Least distance between two rods' axes, mm: the scale of rod interference.
    pub(crate) rod_distance: f64,
}

impl Home {
    /// Home exists for all dimensions that [`super::validate`] accepts.
    pub(super) fn new(mechanism: &Mechanism, limits: &Limits) -> Self {
        let g = &mechanism.geometry;
        let x = [mechanism.e1, mechanism.e2];
        let (u, p) = (g.R1 - g.r1, g.R2 - g.r4);
        let height = |length: f64, x: f64, y: f64| (length * length - x * x - y * y).max(0.0).sqrt();
        let heights = [height(g.L1, x[0], u), height(g.L2, x[1], p), height(g.L3, x[1], p)];
        let rods = Rods::new(g, &mechanism.inverse_lengths, x, 0.0, heights, [1.0, 0.0]);
        let own = rods.directions.map(unit);
        let given = |axes: [[f64; 3]; 4]| axes.map(|axis| unit(direction(axis).unwrap_or(axis)));
        Self {
            slider_axes: columns(&limits.slider_axes.map_or(own, given)),
            platform_axes: columns(&limits.platform_axes.map_or(own, given)),
            det: determinant(&matrix(g, &rods)),
            heights,
            rod_distance: interference::least_distance(mechanism, &rods).0.max(LEAST_ROD_DISTANCE),
        }
    }
}

fn unit(vector: [f64; 3]) -> [f64; 3] {
    Vector3::from(vector).normalize().into()
}
