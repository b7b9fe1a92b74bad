//! The rows of a tool path as text: CSV, NDJSON or JSON.

use std::fmt::{self, Write};

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};
use verne_solver::toolpath::RowKind;

use crate::wire::constraint::{ConstraintName, ElementName};

/// The columns of CSV, which are also the names of the fields in JSON.
pub(crate) const COLUMNS: &str =
    "line,kind,x,y,z,i,j,k,rho1,rho2,rho3,theta1,theta2,duration,margin,constraint,element";

/// Format of the rows: `csv`, with the names of the columns in the first line; `ndjson`, an object in each line;
/// `json`, one document.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
pub(crate) enum RowFormat {
    /// Comma-separated columns.
    Csv,
    /// A JSON object in each line.
    Ndjson,
    /// One JSON document.
    Json,
}

impl RowFormat {
    /// All of them; the first is preferred.
    pub(crate) const ALL: [Self; 3] = [Self::Json, Self::Ndjson, Self::Csv];

    /// The media type.
    pub(crate) fn media(self) -> &'static str {
        match self {
            Self::Csv => "text/csv",
            Self::Ndjson => "application/x-ndjson",
            Self::Json => "application/json",
        }
    }

    /// The name, which is also the extension.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Ndjson => "ndjson",
            Self::Json => "json",
        }
    }
}

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
    const fn name(self) -> &'static str {
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

impl RowObject {
    /// Writes the row as a line of CSV, without its end. A value that does not exist is an empty column.
    pub(crate) fn write_csv(&self, text: &mut String) -> fmt::Result {
        let Self { line, kind, x, y, z, i, j, k, rho1, rho2, rho3, theta1, theta2, .. } = self;
        write!(text, "{line},{}", kind.name())?;
        for number in [x, y, z, i, j, k, rho1, rho2, rho3, theta1, theta2] {
            text.push(',');
            write_number(*number, text)?;
        }
        text.push(',');
        self.duration.map_or(Ok(()), |duration| write_number(duration, text))?;
        text.push(',');
        write_number(self.margin, text)?;
        write!(text, ",{},{}", self.constraint, self.element)
    }
}

/// Writes the shortest decimal number that is read as this one: as JSON does, without a zero fraction.
fn write_number(number: f64, text: &mut String) -> fmt::Result {
    let start = text.len();
    write!(text, "{number:?}")?;
    if text[start..].ends_with(".0") {
        text.truncate(text.len() - 2);
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use super::write_number;

    #[test]
    fn numbers_are_short_and_survive() {
        for (number, expected) in
            [(300.0, "300"), (-0.5, "-0.5"), (1.2e-17, "1.2e-17"), (0.1 + 0.2, "0.30000000000000004")]
        {
            let mut text = "before,".to_owned();
            write_number(number, &mut text).unwrap();
            let written = text.strip_prefix("before,").unwrap();
            assert_eq!((written, written.parse()), (expected, Ok(number)));
        }
    }
}
