//! The feeds and the standstills of a program, as the timer needs them.

use verne_program::{Dwell, Event, EventKind, FeedUnit, Program, Rotation};
use verne_solver::toolpath::{Feed, Pace};

use crate::wire::degrees::from_degrees;

const SECONDS_PER_MINUTE: f64 = 60.0;

/// Goes through a program once, and states the pace of each move.
pub(crate) struct ProgramPace<'a> {
    program: &'a Program,
    events: std::iter::Peekable<std::slice::Iter<'a, Event>>,
    /// Turns of the spindle per second that the program has stated last.
    speed: Option<f64>,
    /// Whether the program has stopped the spindle.
    is_off: bool,
    waited: f64,
}

impl<'a> ProgramPace<'a> {
    /// Begins before the first move.
    pub(crate) fn new(program: &'a Program) -> Self {
        let events = program.events().iter().peekable();
        Self { program, events, speed: None, is_off: false, waited: 0.0 }
    }

    /// The pace of a move. Moves must come in order.
    pub(crate) fn of(&mut self, index: usize) -> Pace {
        let from_rest = self.pass(index);
        let step = self.program.moves().get(index);
        let feed = step.and_then(verne_program::Move::feed).map_or(Feed::Drives, |feed| {
            let per_second = feed.value / SECONDS_PER_MINUTE;
            match feed.unit {
                FeedUnit::MillimetresPerMinute => Feed::Tip(per_second),
                FeedUnit::InverseMinutes => Feed::Duration(1.0 / per_second),
                FeedUnit::DegreesPerMinute => Feed::Axis(from_degrees(per_second)),
                FeedUnit::MillimetresPerRevolution => {
                    self.spindle().map_or(Feed::Drives, |turns| Feed::Tip(feed.value * turns))
                }
            }
        });
        Pace { feed, from_rest }
    }

    /// Seconds that the program waits, after the last move.
    pub(crate) fn waits(mut self) -> f64 {
        self.pass(usize::MAX);
        self.waited
    }

    /// Turns of the spindle per second, if it turns.
    fn spindle(&self) -> Option<f64> {
        self.speed.filter(|speed| !self.is_off && *speed > 0.0)
    }

    /// Passes the events before a move; whether the machine stands still at one of them.
    fn pass(&mut self, index: usize) -> bool {
        let mut stands = false;
        while let Some(event) = self.events.next_if(|event| event.before as usize <= index) {
            match event.kind {
                EventKind::Spindle(spindle) => {
                    let speed = spindle.speed.map(|speed| speed / SECONDS_PER_MINUTE);
                    self.speed = speed.or(self.speed);
                    self.is_off = spindle.rotation.map_or(self.is_off, |sense| sense == Rotation::Off);
                }
                EventKind::Dwell(Dwell::Seconds(seconds)) => {
                    self.waited += seconds;
                    stands = true;
                }
                EventKind::Dwell(Dwell::Revolutions(turns)) => {
                    self.waited += self.spindle().map_or(0.0, |per_second| turns / per_second);
                    stands = true;
                }
                EventKind::Tool { .. } | EventKind::Stop | EventKind::OptionalStop | EventKind::Home => {
                    stands = true;
                }
                _ => {}
            }
        }
        stands
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use verne_program::{Format, ReadOptions, Units, read};
    use verne_solver::toolpath::{Feed, Pace};

    use super::ProgramPace;

    fn program(text: &str) -> verne_program::Program {
        let options = ReadOptions { units: Some(Units::Millimetres), ..ReadOptions::default() };
        read(Format::Apt, text.as_bytes(), &options).unwrap()
    }

    #[test]
    fn each_move_has_its_feed_in_seconds() {
        let text = "UNITS/MM\nSPINDL/1200,RPM,CLW\nRAPID\nGOTO/0,0,9\nFEDRAT/600,MMPM\nGOTO/1,0,9\n\
                    FEDRAT/0.2,MMPR\nGOTO/2,0,9\nFEDRAT/30,INVERS\nGOTO/3,0,9\nSPINDL/OFF\n\
                    FEDRAT/0.2,MMPR\nGOTO/4,0,9\nFINI\n";
        let program = program(text);
        let mut pace = ProgramPace::new(&program);
        let feeds = [0, 1, 2, 3, 4].map(|index| pace.of(index).feed);
        let expected =
            [Feed::Drives, Feed::Tip(10.0), Feed::Tip(0.2 * 20.0), Feed::Duration(2.0), Feed::Drives];
        assert_eq!(feeds, expected);
    }

    #[test]
    fn the_machine_stands_at_stops_and_waits() {
        let text = "UNITS/MM\nFEDRAT/60,MMPM\nGOTO/0,0,9\nGOTO/1,0,9\nDELAY/2.5\nGOTO/2,0,9\nSTOP\nGOTO/3,0,9\n\
                    DELAY/1\nFINI\n";
        let program = program(text);
        let mut pace = ProgramPace::new(&program);
        let rests = [0, 1, 2, 3].map(|index| {
            let Pace { from_rest, .. } = pace.of(index);
            from_rest
        });
        assert_eq!(rests, [false, false, true, true]);
        assert!((pace.waits() - 3.5).abs() < 1e-12);
    }
}
