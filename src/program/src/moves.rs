//! One move of a program.

use std::num::NonZeroU32;

use serde::{Deserialize, Serialize};

use crate::orientation::Orientation;

/// Whether a move cuts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MoveKind {
    /// The tool moves as fast as it can.
    Rapid,
    /// The tool moves with the programmed feed.
    Feed,
}

/// The unit of a feed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum FeedUnit {
    /// Speed of the tip in mm/min.
    MillimetresPerMinute,
    /// One over the duration of the move in minutes (inverse time, G93).
    InverseMinutes,
    /// Way of the tip in mm during one turn of the spindle.
    MillimetresPerRevolution,
    /// Speed of the axis in degrees per minute, the unit of programs.
    DegreesPerMinute,
}

/// A programmed feed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feed {
    /// Positive.
    pub value: f64,
    /// The meaning of the value.
    pub unit: FeedUnit,
}

/// Which of the two orientations the stored words are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
enum Words {
    Vector,
    Rotary,
}

/// A move: from the end of the move before it to its own tip and orientation.
///
/// It takes 72 bytes, since programs have millions of moves.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Move {
    tip: [f64; 3],
    words: [f64; 3],
    feed_value: f64,
    line: u32,
    /// The number of its arc, from 1.
    arc: Option<NonZeroU32>,
    kind: MoveKind,
    words_are: Words,
    feed_unit: Option<FeedUnit>,
}

impl Move {
    pub(crate) fn new(
        line: u32,
        kind: MoveKind,
        tip: [f64; 3],
        orientation: Orientation,
        feed: Option<Feed>,
    ) -> Self {
        let (words_are, words) = match orientation {
            Orientation::Vector(axis) => (Words::Vector, axis),
            Orientation::Rotary { phi1, phi2 } => (Words::Rotary, [phi1, phi2, 0.0]),
        };
        let (feed_value, feed_unit) = feed.map_or((0.0, None), |feed| (feed.value, Some(feed.unit)));
        Self { tip, words, feed_value, line, arc: None, kind, words_are, feed_unit }
    }

    pub(crate) fn with_arc(mut self, number: NonZeroU32) -> Self {
        self.arc = Some(number);
        self
    }

    pub(crate) fn add_to_phi2(&mut self, angle: f64) {
        if self.words_are == Words::Rotary {
            self.words[1] += angle;
        }
    }

    /// The number of its arc in the program, from 1.
    pub(crate) fn arc_number(&self) -> Option<NonZeroU32> {
        self.arc
    }

    /// The line of the file that states the move, from 1. All moves of one hole have the line of the hole.
    pub fn line(&self) -> u32 {
        self.line
    }

    /// Whether the move cuts.
    pub fn kind(&self) -> MoveKind {
        self.kind
    }

    /// The tip at the end of the move, mm, in the program's frame.
    pub fn tip(&self) -> [f64; 3] {
        self.tip
    }

    /// The orientation of the tool at the end of the move, as the program states it.
    pub fn orientation(&self) -> Orientation {
        let [first, second, _] = self.words;
        match self.words_are {
            Words::Vector => Orientation::Vector(self.words),
            Words::Rotary => Orientation::Rotary { phi1: first, phi2: second },
        }
    }

    /// The axis at the end of the move: a unit vector from the tip to the holder.
    pub fn axis(&self) -> [f64; 3] {
        self.orientation().axis()
    }

    /// The programmed feed. Without one, and in a rapid, the drives decide.
    pub fn feed(&self) -> Option<Feed> {
        self.feed_unit.map(|unit| Feed { value: self.feed_value, unit })
    }

    /// Whether the move is one that a reader makes: finite numbers, an axis of unit length, a positive feed.
    pub(crate) fn is_valid(&self) -> bool {
        let finite = self.tip.iter().chain(&self.words).all(|n| n.is_finite());
        let oriented = match self.words_are {
            Words::Vector => crate::orientation::unit(self.words) == Some(self.words),
            Words::Rotary => self.words[2] == 0.0,
        };
        let fed = match self.feed_unit {
            Some(_) => self.feed_value > 0.0 && self.feed_value.is_finite() && self.kind == MoveKind::Feed,
            None => self.feed_value == 0.0,
        };
        finite && oriented && fed
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_move_takes_72_bytes() {
        assert_eq!(size_of::<super::Move>(), 72);
        assert_eq!(size_of::<crate::Arc>(), 56);
    }
}
