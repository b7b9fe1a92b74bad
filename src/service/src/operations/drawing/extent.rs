//! What a slice covers.

use crate::wire::slice::SliceObject;

/// Height of letters, as a part of the drawing's larger side.
const LETTERS: f64 = 0.022;

/// The smallest rectangle along the axes that holds the polygons, mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(crate) min: [f64; 2],
    pub(crate) max: [f64; 2],
}

/// What is shown of an empty slice, mm.
pub(crate) const NOTHING: Extent = Extent { min: [-100.0; 2], max: [100.0; 2] };

impl Extent {
    /// None if the slice is empty.
    pub(crate) fn of(slice: &SliceObject) -> Option<Self> {
        let mut points = slice.polygons.iter().flat_map(|polygon| &polygon.outer).map(|point| point.0);
        let first = points.next()?;
        Some(points.fold(Self { min: first, max: first }, |Self { min, max }, [x, y]| Self {
            min: [min[0].min(x), min[1].min(y)],
            max: [max[0].max(x), max[1].max(y)],
        }))
    }

    /// The larger side, mm; at least a micrometre, so that lines and letters have a size.
    pub(crate) fn size(&self) -> f64 {
        (self.max[0] - self.min[0]).max(self.max[1] - self.min[1]).max(1e-3)
    }

    /// Height of letters, mm.
    pub(crate) fn letters(&self) -> f64 {
        LETTERS * self.size()
    }
}

/// Degrees of a line of constant alpha. Angles come back from radians: the last digits are rounding.
pub(crate) fn shown(degrees: f64) -> f64 {
    (degrees * 1e6).round() / 1e6
}
