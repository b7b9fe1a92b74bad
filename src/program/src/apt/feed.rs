//! Feeds: a number and a unit in any order.

use crate::apt::statement::Statement;
use crate::builder::ProgrammedFeed;
use crate::error::ProgramError;
use crate::moves::{Feed, FeedUnit};

/// The unit of a feed as CL text names it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rate {
    unit: FeedUnit,
    /// The number of mm in its length; none means the unit of the file.
    millimetres: Option<f64>,
}

/// The forms of FEDRAT that are accepted.
pub(crate) const ACCEPTED: &str = "FEDRAT/value,unit or FEDRAT/unit,value with the unit MMPM, IPM, FPM, MMPR, IPR, \
                                   FPR, INVERS, DPM, PERMIN or PERREV";

/// The largest feed, in its unit.
const LARGEST: f64 = 1e9;

/// Without a unit a feed is in the file's unit per minute.
const PER_MINUTE: Rate = Rate { unit: FeedUnit::MillimetresPerMinute, millimetres: None };

/// The unit of a word in capitals.
pub(crate) fn rate(word: &str) -> Option<Rate> {
    use FeedUnit::{DegreesPerMinute, InverseMinutes, MillimetresPerMinute, MillimetresPerRevolution};
    let (unit, millimetres) = match word {
        "MMPM" => (MillimetresPerMinute, Some(1.0)),
        "IPM" => (MillimetresPerMinute, Some(25.4)),
        "FPM" => (MillimetresPerMinute, Some(304.8)),
        "MMPR" => (MillimetresPerRevolution, Some(1.0)),
        "IPR" => (MillimetresPerRevolution, Some(25.4)),
        "FPR" => (MillimetresPerRevolution, Some(304.8)),
        "INVERS" => (InverseMinutes, Some(1.0)),
        "DPM" => (DegreesPerMinute, Some(1.0)),
        "PERMIN" => (MillimetresPerMinute, None),
        "PERREV" => (MillimetresPerRevolution, None),
        _ => return None,
    };
    Some(Rate { unit, millimetres })
}

impl Rate {
    /// Whether the feed depends on the file's unit of lengths.
    pub(crate) fn needs_units(&self) -> bool {
        self.millimetres.is_none()
    }

    /// The feed of a value. `millimetres` is the length of the file's unit.
    pub(crate) fn feed(&self, value: f64, millimetres: f64) -> Result<ProgrammedFeed, String> {
        let value = value * self.millimetres.unwrap_or(millimetres);
        if !(value > 0.0 && value <= LARGEST) {
            return Err("a feed must be positive and at most 1000000000".to_owned());
        }
        let feed = Some(Feed { value, unit: self.unit });
        Ok(match self.unit {
            FeedUnit::InverseMinutes => ProgrammedFeed { travel: feed, turn: feed },
            FeedUnit::DegreesPerMinute => ProgrammedFeed { travel: None, turn: feed },
            _ => ProgrammedFeed { travel: feed, turn: None },
        })
    }
}

/// The value and the unit of FEDRAT.
pub(crate) fn parse(statement: &Statement<'_>) -> Result<(f64, Rate), ProgramError> {
    let mut value = None;
    let mut unit = None;
    for token in statement.arguments() {
        if let Some(known) = rate(token.text)
            && unit.is_none()
        {
            unit = Some(known);
        } else if token.number().is_some() && value.is_none() {
            value = Some(statement.number(token, ACCEPTED)?);
        } else {
            return Err(
                statement.fault_at(token, format!("the feed is not understood; accepted: {ACCEPTED}"))
            );
        }
    }
    let value = value.ok_or_else(|| statement.fault(format!("FEDRAT has no value; accepted: {ACCEPTED}")))?;
    Ok((value, unit.unwrap_or(PER_MINUTE)))
}
