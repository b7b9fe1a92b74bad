//! Turns rows into moves.

use crate::builder::{Builder, ProgrammedFeed, Target};
use crate::moves::{Feed, FeedUnit};
use crate::options::{ReadOptions, Units};
use crate::orientation::{Orientation, unit};
use crate::rows::row::{Row, RowOrientation};

/// Builds a program row by row.
#[derive(Debug)]
pub(crate) struct RowBuilder {
    pub(crate) builder: Builder,
    millimetres: f64,
    /// Whether a row has stated an orientation.
    is_oriented: bool,
}

/// The place of a fault in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum At {
    /// The row as a whole.
    Row,
    /// The value of this name.
    Name(&'static str),
}

impl RowBuilder {
    pub(crate) fn new(options: &ReadOptions) -> Self {
        let millimetres = options.units.unwrap_or(Units::Millimetres).millimetres();
        Self { builder: Builder::new(options), millimetres, is_oriented: false }
    }

    /// Adds the row of a line, or says what is wrong with it.
    pub(crate) fn row(&mut self, line: u32, row: &Row) -> Result<(), (At, String)> {
        for (name, value) in ["x", "y", "z"].into_iter().zip(row.tip) {
            if !value.is_finite() {
                return Err((At::Name(name), format!("{name} must be a finite number")));
            }
        }
        let orientation = self.orientation(row.line.unwrap_or(line), row.orientation)?;
        let target = Target {
            line: row.line.unwrap_or(line),
            kind: row.kind,
            tip: row.tip.map(|value| value * self.millimetres),
            orientation,
            feed: self.feed(row.feed)?,
        };
        self.builder.line(target).map_err(|detail| (At::Row, detail))
    }

    fn orientation(&mut self, line: u32, orientation: RowOrientation) -> Result<Orientation, (At, String)> {
        if orientation != RowOrientation::None {
            self.is_oriented = true;
        } else if self.is_oriented {
            let detail = "a row without an orientation after one with an orientation: its axis is (0, 0, 1)";
            self.builder.diagnostics.warn(line, "", detail);
        }
        match orientation {
            RowOrientation::None => Ok(Orientation::Vector([0.0, 0.0, 1.0])),
            RowOrientation::Vector(axis) => unit(axis).map(Orientation::Vector).ok_or_else(|| {
                (At::Name("i"), "the axis i, j, k must be finite and other than (0, 0, 0)".to_owned())
            }),
            RowOrientation::Rotary(words) => {
                for (name, word) in ["phi1", "phi2"].into_iter().zip(words) {
                    if word.is_nan() || word.abs() > 1e6 {
                        return Err((At::Name(name), format!("{name} must lie within 1000000 degrees")));
                    }
                }
                let [phi1, phi2] = words.map(|word| word.to_radians() + 0.0);
                Ok(Orientation::Rotary { phi1, phi2 })
            }
        }
    }

    fn feed(&self, feed: Option<f64>) -> Result<ProgrammedFeed, (At, String)> {
        let Some(value) = feed else { return Ok(ProgrammedFeed::default()) };
        if !(value > 0.0 && value <= 1e9) {
            let detail =
                "the feed must be positive and at most 1000000000; leave it out if the drives decide";
            return Err((At::Name("feed"), detail.to_owned()));
        }
        Ok(ProgrammedFeed {
            travel: Some(Feed { value: value * self.millimetres, unit: FeedUnit::MillimetresPerMinute }),
            turn: Some(Feed { value, unit: FeedUnit::DegreesPerMinute }),
        })
    }
}
