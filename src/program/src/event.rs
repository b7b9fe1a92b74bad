//! The statements of a program beside its moves.

use serde::{Deserialize, Serialize};

use crate::work_offset::WorkOffset;

/// An event without motion, in its place among the moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// The line that states it, from 1.
    pub line: u32,
    /// The index of the move that follows; the number of moves if none does.
    pub before: u32,
    /// The kind of the event.
    pub kind: EventKind,
    /// The statement, or the text of a comment.
    pub text: Box<str>,
}

/// The kinds of events.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum EventKind {
    /// Another tool is loaded. Whether its length counts from here is what
    /// [`Program::length_source`](crate::Program::length_source) says.
    Tool {
        /// Its number, if the program states one.
        number: Option<u32>,
        /// Its length in mm, if the program states it.
        length: Option<f64>,
    },
    /// The spindle starts, changes or stops.
    Spindle(Spindle),
    /// The coolant starts, changes or stops.
    Coolant(Coolant),
    /// The tool waits.
    Dwell(Dwell),
    /// The machine stops until the operator continues.
    Stop,
    /// The same if the operator has asked for it.
    OptionalStop,
    /// The program ends.
    End,
    /// The tool leaves for a position that the program does not state. The next move has no start.
    Home,
    /// A coordinate system is named. The points are in the program's frame all the same.
    Frame,
    /// Cutter radius compensation is switched on or off. The points are the tool's path.
    Compensation {
        /// Whether it is on.
        on: bool,
    },
    /// A text for the operator.
    Comment,
    /// A text for the controller. Its writer decides what of it can be passed on.
    Insert,
    /// A statement without motion that the reader passes on.
    Other,
    /// Tool length compensation: the moves that follow have the length of an entry of the table of lengths (H of G43,
    /// G43.4 and G43.5), or no length (G49). Before the first such event there is no length either.
    LengthOffset {
        /// The entry of the table; none after G49.
        number: Option<u32>,
    },
    /// The origin of the points that follow is that of another work offset. Before the first such event it is that of
    /// G54. The move before and the next one have different origins, so the next move has no start.
    WorkOffset(WorkOffset),
    /// Control of the tool centre point begins or ends; its end ends a cut.
    CentrePointControl {
        /// Whether it is on.
        on: bool,
    },
    /// A tilted plane begins (G68.2) or ends (G69), which ends a cut. The points of the moves are in the program's
    /// frame all the same.
    TiltedPlane {
        /// Whether it is on.
        on: bool,
    },
}

/// A statement about the spindle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spindle {
    /// Revolutions per minute, if the program states them here.
    pub speed: Option<f64>,
    /// Its sense, if the program states it here.
    pub rotation: Option<Rotation>,
}

/// The sense of the spindle, seen from the holder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Rotation {
    /// Clockwise, M3.
    Clockwise,
    /// Counter-clockwise, M4.
    CounterClockwise,
    /// It stands, M5.
    Off,
}

/// The coolant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Coolant {
    /// None, M9.
    Off,
    /// Flood, M8. Also a coolant that is only called on.
    Flood,
    /// Mist, M7.
    Mist,
    /// Through the tool.
    Through,
}

/// A wait.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Dwell {
    /// Seconds.
    Seconds(f64),
    /// Turns of the spindle.
    Revolutions(f64),
}

impl EventKind {
    /// Whether the end of the move before is no point in the frame of the next move.
    pub(crate) fn hides_start(&self) -> bool {
        matches!(self, Self::Home | Self::WorkOffset(_))
    }

    /// Whether the numbers of the event are finite and not negative.
    pub(crate) fn is_valid(&self) -> bool {
        let number = match *self {
            Self::Tool { length, .. } => length,
            Self::Spindle(Spindle { speed, .. }) => speed,
            Self::Dwell(Dwell::Seconds(value) | Dwell::Revolutions(value)) => Some(value),
            Self::WorkOffset(offset) => return offset.is_valid(),
            _ => None,
        };
        number.is_none_or(|value| value.is_finite() && value >= 0.0)
    }
}
