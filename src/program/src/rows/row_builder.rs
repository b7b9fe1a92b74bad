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
    /// The orientation of the first row; all rows state theirs in the same way.
    first: Option<RowOrientation>,
}

/// What a fault of a row is about.
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
        Self { builder: Builder::new(options), millimetres, first: None }
    }

    /// Adds the row of a line, or says what is wrong with it.
    pub(crate) fn row(&mut self, line: u32, row: &Row) -> Result<(), (At, String)> {
        for (name, value) in ["x", "y", "z"].into_iter().zip(row.tip) {
            if !value.is_finite() {
                return Err((At::Name(name), format!("{name} must be a finite number")));
            }
        }
        let orientation = self.orientation(row.orientation)?;
        let target = Target {
            line: row.line.unwrap_or(line),
            kind: row.kind,
            tip: row.tip.map(|value| value * self.millimetres),
            orientation,
            feed: self.feed(row.feed)?,
        };
        self.builder.line(target).map_err(|detail| (At::Row, detail))
    }

    fn orientation(&mut self, orientation: RowOrientation) -> Result<Orientation, (At, String)> {
        let first = *self.first.get_or_insert(orientation);
        if std::mem::discriminant(&first) != std::mem::discriminant(&orientation) {
            let detail = "every row must state its orientation in the same way as the first: i, j, k, or phi1, phi2, \
                          or none";
            return Err((At::Row, detail.to_owned()));
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
