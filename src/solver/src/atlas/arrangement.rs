//! The faces between segments of a plane, with exact arithmetic on a grid of integers.
//!
//! Segments are cut where they meet; each new end is rounded to the grid, so that cuts may make new meetings. They
//! are cut again until there is none. All decisions about sides and order are exact, and the faces are those of a
//! planar graph whatever the rounding did.

mod faces;
mod split;

pub(super) use faces::{Faces, Ring};
pub(super) use split::split_at_meetings;

/// A point of the grid.
pub(super) type GridPoint = [i64; 2];

/// Number of grid steps along the window's longer side.
pub(super) const STEPS: f64 = 4_294_967_296.0;

/// The part of an arc's segment that an edge is, if it is one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Origin {
    pub(super) arc: usize,
    pub(super) segment: usize,
    /// Fractions of the segment at both ends.
    pub(super) part: [f64; 2],
}

/// A segment of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Edge {
    pub(super) ends: [GridPoint; 2],
    pub(super) origin: Option<Origin>,
}

/// Twice the signed area of a triangle: positive if it is counter-clockwise.
pub(super) fn orientation(a: GridPoint, b: GridPoint, c: GridPoint) -> i128 {
    let difference = |from: GridPoint, to: GridPoint, i: usize| i128::from(to[i]) - i128::from(from[i]);
    difference(a, b, 0) * difference(a, c, 1) - difference(a, b, 1) * difference(a, c, 0)
}
