//! A set of part points: its volume and its surface.

use crate::pose::Point;
use crate::workspace::measure::Volume;

/// A set of part points.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Volume, by integration and not from the surface.
    pub volume: Volume,
    /// Corners of the surface in the part frame, mm.
    pub positions: Vec<Point>,
    /// Numbers of the triangles' corners, counter-clockwise seen from outside; every edge belongs to
    /// two triangles that run along it in opposite directions.
    pub triangles: Vec<[u32; 3]>,
}
