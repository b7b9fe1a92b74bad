//! Events as lines of a joint program.

use super::text::{comment, is_auxiliary, line};
use crate::event::{Coolant, Dwell, Event, EventKind, Rotation, Spindle};

/// A line for an event.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum EventLine {
    /// Words for the controller.
    Code(String),
    /// A text for the controller that is passed on as it is. It may move the axes: M6 does on some machines.
    Insert(String),
    /// A comment.
    Comment(String),
}

/// The line that states an event to the controller. The text of a statement that it has no word for is a comment.
///
/// The end of a program is stated by its foot. A move home is only named, since the program does not state where the
/// joints are then. `speed` is the spindle's, in revolutions per minute: a dwell in revolutions is written in seconds.
pub(super) fn event_line(event: &Event, speed: Option<f64>) -> Option<EventLine> {
    let code = |words: &str| Some(EventLine::Code(words.to_owned()));
    match event.kind {
        EventKind::Tool { number: Some(number), .. } => Some(EventLine::Code(format!("T{number} M6"))),
        EventKind::Tool { number: None, .. } => Some(EventLine::Code(format!("M6 {}", comment(&event.text)))),
        EventKind::Spindle(spindle) => spindle_words(spindle).map(EventLine::Code),
        EventKind::Coolant(Coolant::Off) => code("M9"),
        EventKind::Coolant(Coolant::Flood) => code("M8"),
        EventKind::Coolant(Coolant::Mist) => code("M7"),
        // There is no standard word for it.
        EventKind::Coolant(Coolant::Through) => Some(EventLine::Code(format!("M8 {}", comment(&event.text)))),
        EventKind::Dwell(Dwell::Seconds(seconds)) => Some(dwell(seconds)),
        EventKind::Dwell(Dwell::Revolutions(turns)) => match speed.filter(|speed| *speed > 0.0) {
            Some(speed) => Some(dwell(60.0 * turns / speed)),
            None => Some(EventLine::Comment(comment(&event.text))),
        },
        EventKind::Stop => code("M0"),
        EventKind::OptionalStop => code("M1"),
        EventKind::End => None,
        EventKind::Insert => Some(insert(&event.text)),
        EventKind::Home
        | EventKind::Frame
        | EventKind::Compensation { .. }
        | EventKind::LengthOffset { .. }
        | EventKind::WorkOffset(_)
        | EventKind::CentrePointControl { .. }
        | EventKind::TiltedPlane { .. }
        | EventKind::Comment
        | EventKind::Other => Some(EventLine::Comment(comment(&event.text))),
    }
}

/// A text for the controller. Other words than M, S and T could move the axes, or change what the words of all later
/// blocks mean; so such a text is a comment.
fn insert(text: &str) -> EventLine {
    if is_auxiliary(text) {
        EventLine::Insert(line(text))
    } else {
        EventLine::Comment(comment(&format!("not passed on: {}", line(text))))
    }
}

fn dwell(seconds: f64) -> EventLine {
    EventLine::Code(format!("G4 P{seconds:.3}"))
}

/// S without a decimal point, as most controllers ask for it.
fn spindle_words(spindle: Spindle) -> Option<String> {
    let speed = spindle.speed.map(|speed| format!("S{speed:.0}"));
    let sense = spindle.rotation.map(|rotation| match rotation {
        Rotation::Clockwise => "M3",
        Rotation::CounterClockwise => "M4",
        Rotation::Off => "M5",
    });
    match (speed, sense) {
        (Some(speed), Some(sense)) => Some(format!("{speed} {sense}")),
        (Some(speed), None) => Some(speed),
        (None, Some(sense)) => Some(sense.to_owned()),
        (None, None) => None,
    }
}
