//! Places where the tool stands on the part.

use serde::Serialize;
use utoipa::ToSchema;

/// A place of a cut where the tool stands while the table turns at the pole: it may leave a mark on the part.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, ToSchema)]
pub(crate) struct DwellMark {
    /// The line of the move that the table turns for.
    pub line: u32,
    /// x of the tool's end in the part frame, mm.
    pub x: f64,
    /// y, mm.
    pub y: f64,
    /// z, mm.
    pub z: f64,
    /// The angle through which the table turns, degrees.
    pub angle: f64,
    /// How long the turn takes, s; null if neither a feed nor drives determine it.
    pub duration: Option<f64>,
}
