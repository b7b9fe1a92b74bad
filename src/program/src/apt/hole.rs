//! Expands a hole of a cycle into moves along its axis.

use nalgebra::Vector3;

use crate::apt::cycle::{Cycle, CycleKind};
use crate::apt::state::State;
use crate::apt::statement::Statement;
use crate::builder::{ProgrammedFeed, Target};
use crate::drilling::{PeckKind, ROUNDING, pecks};
use crate::error::ProgramError;
use crate::event::{Dwell, EventKind};
use crate::moves::MoveKind;
use crate::orientation::Orientation;

/// Drills the hole at `tip` along the present axis. Like a controller, the tool first rises if it is too low, goes
/// over the hole at that height, and then down to where the feed begins.
pub(crate) fn drill(
    state: &mut State,
    statement: &Statement<'_>,
    cycle: Cycle,
    tip: [f64; 3],
) -> Result<(), ProgramError> {
    let millimetres = state.millimetres(statement)?;
    state.rapid = false;
    let feed = match cycle.feed {
        Some((value, rate)) => rate.feed(value, millimetres).map_err(|detail| statement.fault(detail))?,
        None => state.feed,
    };
    let axis = Vector3::from(state.axis);
    let [bottom, start, retract] =
        [cycle.bottom, cycle.start, cycle.retract].map(|height| height * millimetres);
    let mut hole = Hole { statement, tip: Vector3::from(tip), axis, feed, state };
    hole.approach(start, start.max(retract))?;
    let step = cycle.step.map(|step| step * millimetres);
    match (cycle.kind, step) {
        (CycleKind::Peck(kind), Some(step)) => hole.peck(kind, start, bottom, step)?,
        (CycleKind::Peck(_), None) => {
            let detail = "the cycle has no step: it is one stroke";
            hole.state.builder.diagnostics.warn(statement.line(), statement.word(), detail);
            hole.go(MoveKind::Feed, bottom)?;
        }
        _ => hole.go(MoveKind::Feed, bottom)?,
    }
    hole.dwell(cycle.dwell)?;
    match cycle.kind {
        CycleKind::Bore => hole.go(MoveKind::Feed, start)?,
        CycleKind::Tap => {
            let detail = "a tapping cycle is two strokes; the spindle's reversal is not passed on";
            hole.state.builder.diagnostics.warn(statement.line(), statement.word(), detail);
            hole.go(MoveKind::Feed, start)?;
        }
        CycleKind::Drill | CycleKind::Peck(_) => {}
    }
    hole.go(MoveKind::Rapid, retract)
}

/// A hole that is being drilled.
struct Hole<'s, 'a> {
    statement: &'s Statement<'a>,
    tip: Vector3<f64>,
    axis: Vector3<f64>,
    feed: ProgrammedFeed,
    state: &'s mut State,
}

impl Hole<'_, '_> {
    fn approach(&mut self, start: f64, level: f64) -> Result<(), ProgramError> {
        let last = self.state.builder.position().copied();
        let mut height = level;
        if let Some(last) = last.filter(|last| last.axis() == self.state.axis) {
            let present = (Vector3::from(last.tip()) - self.tip).dot(&self.axis);
            height = present.max(level);
            if present < level - ROUNDING {
                self.rapid_to(Vector3::from(last.tip()) + self.axis * (level - present))?;
            }
        }
        self.go(MoveKind::Rapid, height)?;
        self.go(MoveKind::Rapid, start)
    }

    fn peck(&mut self, kind: PeckKind, from: f64, bottom: f64, step: f64) -> Result<(), ProgramError> {
        let strokes = pecks(kind, from, bottom, step).map_err(|detail| self.statement.fault(detail))?;
        strokes.into_iter().try_for_each(|(kind, height)| self.go(kind, height))
    }

    fn dwell(&mut self, dwell: Option<Dwell>) -> Result<(), ProgramError> {
        let Some(dwell) = dwell else { return Ok(()) };
        let event = self.state.builder.event(self.statement.line(), EventKind::Dwell(dwell), "CYCLE");
        event.map_err(|detail| self.statement.fault(detail))
    }

    /// Goes to a height above the programmed point.
    fn go(&mut self, kind: MoveKind, height: f64) -> Result<(), ProgramError> {
        self.go_to(kind, self.tip + self.axis * height)
    }

    fn rapid_to(&mut self, tip: Vector3<f64>) -> Result<(), ProgramError> {
        self.go_to(MoveKind::Rapid, tip)
    }

    fn go_to(&mut self, kind: MoveKind, tip: Vector3<f64>) -> Result<(), ProgramError> {
        let target = Target {
            line: self.statement.line(),
            kind,
            tip: tip.into(),
            orientation: Orientation::Vector(self.state.axis),
            feed: self.feed,
        };
        let here = self.state.builder.position();
        if here.is_some_and(|last| last.tip() == target.tip && last.orientation() == target.orientation) {
            return Ok(());
        }
        self.state.builder.line(target).map_err(|detail| self.statement.fault(detail))
    }
}
