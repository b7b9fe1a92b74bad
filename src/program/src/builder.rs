//! Builds a program move by move, and checks what holds in every format.

use std::num::NonZeroU32;

use nalgebra::Vector3;

use crate::arc::{Arc, Sweep};
use crate::diagnostics::Diagnostics;
use crate::error::{ProgramError, ProgramErrors, Warnings};
use crate::event::{Event, EventKind, Rotation, Spindle};
use crate::moves::{Feed, FeedUnit, Move, MoveKind};
use crate::options::{ReadOptions, Units};
use crate::orientation::Orientation;
use crate::program::{LengthSource, Program};

/// The largest coordinate in mm: beyond it, squares and differences lose what they mean.
const LARGEST: f64 = 1e7;
/// The memory that events may take, bytes.
const EVENT_BUDGET: usize = 32 << 20;
/// A pair of axes is opposite if the sine of its angle is below this.
const OPPOSITE: f64 = 1e-9;

/// Where a move leads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    pub(crate) line: u32,
    pub(crate) kind: MoveKind,
    pub(crate) tip: [f64; 3],
    pub(crate) orientation: Orientation,
    pub(crate) feed: ProgrammedFeed,
}

/// A feed as programmed: it depends on whether the tip moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ProgrammedFeed {
    /// The feed of moves with a length.
    pub(crate) travel: Option<Feed>,
    /// The feed of moves of the axis alone.
    pub(crate) turn: Option<Feed>,
}

/// The circle of an arc.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    pub(crate) centre: [f64; 3],
    /// A unit vector.
    pub(crate) normal: [f64; 3],
    pub(crate) sweep: Sweep,
}

/// A program under construction.
#[derive(Debug)]
pub(crate) struct Builder {
    pub(crate) diagnostics: Diagnostics,
    pub(crate) options: ReadOptions,
    program: Program,
    /// Whether the last move is where the tool is.
    known: bool,
    event_bytes: usize,
    /// The spindle as the program has stated it last.
    spindle: Spindle,
}

impl Builder {
    pub(crate) fn new(options: &ReadOptions) -> Self {
        let program = Program {
            units: options.units.unwrap_or(Units::Millimetres),
            length_source: LengthSource::Tool,
            moves: Vec::new(),
            arcs: Vec::new(),
            events: Vec::new(),
            warnings: Warnings::default(),
        };
        let spindle = Spindle { speed: None, rotation: None };
        let (diagnostics, known, event_bytes) = (Diagnostics::default(), false, 0);
        Self { diagnostics, options: options.clone(), program, known, event_bytes, spindle }
    }

    pub(crate) fn set_units(&mut self, units: Units) {
        self.program.units = units;
    }

    pub(crate) fn set_length_source(&mut self, source: LengthSource) {
        self.program.length_source = source;
    }

    /// Adds an angle to phi2 of all moves with rotary words.
    pub(crate) fn add_to_phi2(&mut self, angle: f64) {
        self.program.moves.iter_mut().for_each(|one| one.add_to_phi2(angle));
    }

    pub(crate) fn move_count(&self) -> usize {
        self.program.moves.len()
    }

    /// About the bytes of the program so far.
    pub(crate) fn memory(&self) -> usize {
        let Program { moves, arcs, .. } = &self.program;
        size_of_val(moves.as_slice()) + size_of_val(arcs.as_slice()) + self.event_bytes
    }

    /// The last move, if the tool is at its end.
    pub(crate) fn position(&self) -> Option<&Move> {
        self.program.moves.last().filter(|_| self.known)
    }

    /// Adds a straight move, or says in a sentence why not.
    pub(crate) fn line(&mut self, target: Target) -> Result<(), String> {
        let start = self.position().copied();
        if let Some(start) = start
            && start.tip() == target.tip
            && start.orientation() == target.orientation
        {
            self.diagnostics.warn(target.line, "", "a move without length and turning is left out");
            return Ok(());
        }
        let turning_only = start.is_some_and(|start| start.tip() == target.tip);
        let accepted = self.accepted(target, turning_only)?;
        self.program.moves.push(accepted);
        self.known = true;
        Ok(())
    }

    /// Adds an arc from the present point, or says in a sentence why not.
    pub(crate) fn arc(&mut self, target: Target, circle: Circle) -> Result<(), String> {
        let Some(start) = self.position().copied() else {
            return Err("an arc needs a point to begin at; write a straight move to it before".to_owned());
        };
        if circle.centre.iter().any(|value| value.abs() > LARGEST) {
            return Err(too_far());
        }
        let accepted = self.accepted(target, false)?;
        let arc = Arc::new(start.tip(), target.tip, circle.centre, circle.normal, circle.sweep)?;
        self.program.arcs.push(arc);
        let number = u32::try_from(self.program.arcs.len()).ok().and_then(NonZeroU32::new);
        let number = number.ok_or_else(|| "a program has fewer than 2^32 arcs".to_owned())?;
        self.program.moves.push(accepted.with_arc(number));
        Ok(())
    }

    /// Adds an event in its place. Beyond the budget, comments are left out and other events are refused.
    pub(crate) fn event(&mut self, line: u32, kind: EventKind, text: &str) -> Result<(), String> {
        self.event_bytes = self.event_bytes.saturating_add(size_of::<Event>() + text.len());
        if self.event_bytes > EVENT_BUDGET {
            if kind != EventKind::Comment {
                return Err("the events of a program take at most 32 MiB; split the program".to_owned());
            }
            self.event_bytes -= size_of::<Event>() + text.len();
            self.diagnostics.warn(line, "", "comments beyond 32 MiB are left out");
            return Ok(());
        }
        let before = u32::try_from(self.program.moves.len()).map_err(|_| "too many moves".to_owned())?;
        if kind.hides_start() {
            self.known = false;
        }
        if let EventKind::Spindle(Spindle { speed, rotation }) = kind {
            let before = self.spindle;
            self.spindle = Spindle { speed: speed.or(before.speed), rotation: rotation.or(before.rotation) };
        }
        self.program.events.push(Event { line, before, kind, text: text.into() });
        Ok(())
    }

    /// The program, or its faults.
    pub(crate) fn finish(self) -> Result<Program, ProgramErrors> {
        let Self { diagnostics, mut program, .. } = self;
        program.warnings = diagnostics.into_result()?;
        if program.moves.is_empty() {
            let detail = "the program has no moves".to_owned();
            let error = ProgramError { line: 1, column: 1, word: String::new(), detail };
            return Err(ProgramErrors { errors: vec![error], complete: true });
        }
        program.moves.shrink_to_fit();
        program.arcs.shrink_to_fit();
        program.events.shrink_to_fit();
        Ok(program)
    }

    /// Whether the spindle turns at a known speed.
    fn turns(&self) -> bool {
        let Spindle { speed, rotation } = self.spindle;
        rotation != Some(Rotation::Off) && speed.is_some_and(|speed| speed > 0.0)
    }

    /// The checks of every move.
    fn accepted(&mut self, target: Target, turning_only: bool) -> Result<Move, String> {
        let Target { line, kind, tip, orientation, feed } = target;
        // Adding zero turns -0.0 into 0.0.
        let tip = tip.map(|value| value + 0.0);
        if tip.iter().any(|value| value.abs() > LARGEST) {
            return Err(too_far());
        }
        if self.program.moves.len() >= self.options.most_moves.min(u32::MAX as usize) {
            return Err(format!("a program has at most {} moves; split it", self.options.most_moves));
        }
        if kind == MoveKind::Rapid {
            return Ok(Move::new(line, kind, tip, orientation, None));
        }
        if let Some(start) = self.position()
            && let (Orientation::Vector(from), Orientation::Vector(to)) = (start.orientation(), orientation)
            && are_opposite(from, to)
        {
            return Err("the axis is opposite to the one before, so it could turn either way; \
                        put a point with an axis between them, or make the move a rapid"
                .to_owned());
        }
        let chosen = if turning_only { feed.turn } else { feed.travel };
        if chosen.is_none() && (feed.travel.is_some() || feed.turn.is_some()) {
            let detail = "the feed does not fit the move: mm/min and mm/rev need a way of the tip, deg/min a move of \
                          the axis alone; the drives decide";
            self.diagnostics.warn(line, "", detail);
        }
        if chosen.is_some_and(|feed| feed.unit == FeedUnit::MillimetresPerRevolution) && !self.turns() {
            let detail = "a feed per turn of the spindle, which does not turn or has no speed (S, SPINDL): the drives \
                          decide";
            self.diagnostics.warn(line, "", detail);
        }
        Ok(Move::new(line, kind, tip, orientation, chosen))
    }
}

fn too_far() -> String {
    format!("a coordinate is beyond {LARGEST} mm; check the units")
}

fn are_opposite(from: [f64; 3], to: [f64; 3]) -> bool {
    let (from, to) = (Vector3::from(from), Vector3::from(to));
    from.dot(&to) < 0.0 && from.cross(&to).norm() < OPPOSITE
}
