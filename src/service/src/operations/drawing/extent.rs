//! The extent of a drawing, and the sizes that follow from it.

/// Height of letters as a fraction of the drawing's larger side.
const LETTERS: f64 = 0.022;

/// A rectangle along the axes, mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(crate) min: [f64; 2],
    pub(crate) max: [f64; 2],
}

/// The extent that an empty drawing shows, mm.
pub(crate) const EMPTY: Extent = Extent { min: [-100.0; 2], max: [100.0; 2] };

impl Extent {
    /// The smallest one that holds the points; none without points.
    pub(crate) fn of(points: impl IntoIterator<Item = [f64; 2]>) -> Option<Self> {
        let mut points = points.into_iter();
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
