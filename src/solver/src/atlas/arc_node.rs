//! The points of an arc.

use super::answer::PointKind;
use super::place::Configuration;

/// A point of an arc.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArcNode {
    pub(super) q: Configuration,
    /// (u, v) in units of the longest dimension.
    pub(super) at: [f64; 2],
    /// Unit vector along the image of the curve, of either sense; `None` where it is not known.
    pub(super) direction: Option<[f64; 2]>,
    pub(super) mark: Option<PointKind>,
    /// How far the curve is off the cubic between this node and the one before.
    pub(super) deviation: f64,
}

/// The distance of a point from a segment.
pub(super) fn distance_to_segment(point: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let (chord, offset) = ([b[0] - a[0], b[1] - a[1]], [point[0] - a[0], point[1] - a[1]]);
    let square = chord[0] * chord[0] + chord[1] * chord[1];
    let along = offset[0] * chord[0] + offset[1] * chord[1];
    let fraction = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
    (offset[0] - fraction * chord[0]).hypot(offset[1] - fraction * chord[1])
}
