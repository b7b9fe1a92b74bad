//! The extent of a drawing, and the sizes that follow from it.

use crate::wire::slice::SliceObject;

/// Height of letters as a fraction of the drawing's larger side.
const LETTERS: f64 = 0.022;

/// The smallest rectangle along the axes that holds the polygons, mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(crate) min: [f64; 2],
    pub(crate) max: [f64; 2],
}

/// The extent that a drawing of an empty slice shows, mm.
pub(crate) const EMPTY_SLICE: Extent = Extent { min: [-100.0; 2], max: [100.0; 2] };

impl Extent {
    /// The extent of the polygons; none if the slice is empty.
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
    pub(crate) fn letter_height(&self) -> f64 {
        LETTERS * self.size()
    }
}

/// The value of a line of constant alpha, degrees, without the last digits: they are rounding errors of radians.
pub(crate) fn displayed(degrees: f64) -> f64 {
    (degrees * 1e6).round() / 1e6
}
