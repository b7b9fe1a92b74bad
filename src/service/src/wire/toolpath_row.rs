//! The rows of a tool path.

use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};
use verne_solver::toolpath::RowKind;

use crate::wire::constraint::{ConstraintName, ElementName};
use crate::wire::row_format::RowFormat;

/// Parameters of GET /toolpath/{id}/rows.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct RowsQuery {
    /// Return the rows in this format. It overrides Accept.
    #[param(inline, nullable = false)]
    pub format: Option<RowFormat>,
    /// The first row, from 0.
    #[serde(default)]
    #[param(default = 0)]
    pub from: u64,
    /// The row before which the answer ends. The default is the number of rows.
    #[param(nullable = false)]
    pub to: Option<u64>,
}

/// Rows of a tool path.
#[expect(dead_code, reason = "the rows are written one by one; this is their schema")]
#[derive(ToSchema)]
pub(crate) struct ToolpathRows {
    /// The id of the tool path.
    id: String,
    /// The rows.
    rows: Vec<RowObject>,
    /// The first row, from 0.
    from: u64,
    /// The row before which the answer ends.
    to: u64,
}

/// A row of a tool path: the joints to which the machine moves, all of them linearly from the row before.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = ToolpathRow)]
pub(crate) struct RowObject {
    /// The line of the program.
    pub line: u32,
    /// The purpose of the row.
    pub kind: RowKindName,
    /// x of the tool's end in the part frame, mm.
    pub x: f64,
    /// y, mm.
    pub y: f64,
    /// z, mm.
    pub z: f64,
    /// x component of the tool's axis in the part frame: a unit vector from the tool's end to the holder.
    pub i: f64,
    /// y component.
    pub j: f64,
    /// z component.
    pub k: f64,
    /// Slider 1, mm.
    pub rho1: f64,
    /// Slider 2, mm.
    pub rho2: f64,
    /// Slider 3, mm.
    pub rho3: f64,
    /// Tilting angle, degrees.
    pub theta1: f64,
    /// Rotary angle, degrees.
    pub theta2: f64,
    /// Time that the motion to this row takes, s; null if neither a feed nor the drives of the machine say so.
    pub duration: Option<f64>,
    /// The worst margin, in the unit of its constraint.
    pub margin: f64,
    /// The constraint of the worst margin.
    pub constraint: ConstraintName,
    /// The part of the machine, such as `slider2.max`.
    #[schema(value_type = String, example = "slider2.max")]
    pub element: ElementName,
}

/// The purpose of a row: `rapid`, a place of a rapid; `feed`, the end of a feed move; `inserted`, a place within a feed
/// move; `turn`, the table turns while the tool stands still; `retract`, `rewind` and `approach`, within a cut the tool
/// leaves the part, the table turns by whole turns, and the tool returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RowKindName {
    /// A place of a rapid, or the first position.
    Rapid,
    /// The end of a feed move.
    Feed,
    /// A place between the ends of a feed move.
    Inserted,
    /// The rotary axis turns while the tool stands still.
    Turn,
    /// The tool leaves the part.
    Retract,
    /// The rotary axis turns by whole turns off the part.
    Rewind,
    /// The tool returns to the part.
    Approach,
}

impl From<RowKind> for RowKindName {
    fn from(kind: RowKind) -> Self {
        match kind {
            RowKind::Rapid => Self::Rapid,
            RowKind::Feed => Self::Feed,
            RowKind::Inserted => Self::Inserted,
            RowKind::Turn => Self::Turn,
            RowKind::Retract => Self::Retract,
            RowKind::Rewind => Self::Rewind,
            RowKind::Approach => Self::Approach,
        }
    }
}

impl RowKindName {
    /// All of them, in the order of their values.
    pub(crate) const ALL: [Self; 7] =
        [Self::Rapid, Self::Feed, Self::Inserted, Self::Turn, Self::Retract, Self::Rewind, Self::Approach];

    /// The name.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Rapid => "rapid",
            Self::Feed => "feed",
            Self::Inserted => "inserted",
            Self::Turn => "turn",
            Self::Retract => "retract",
            Self::Rewind => "rewind",
            Self::Approach => "approach",
        }
    }
}
