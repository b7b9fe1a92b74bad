//! Where the tool is, in the coordinates that blocks state: those of the tilted plane if there is one.

/// Where the tool is, as far as it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Position {
    /// mm.
    pub(crate) coordinates: [Option<f64>; 3],
    /// The tool has left for a place that the program does not state (G28, G30, G53).
    pub(crate) left: bool,
}

impl Position {
    /// A known position.
    pub(crate) fn at(point: [f64; 3]) -> Self {
        Self { coordinates: point.map(Some), left: false }
    }

    /// All coordinates, if all are known.
    pub(crate) fn point(&self) -> Option<[f64; 3]> {
        let [Some(x), Some(y), Some(z)] = self.coordinates else { return None };
        Some([x, y, z])
    }
}
