//! Expands the holes of drilling cycles into moves along the tool's axis, which must be z.

use crate::builder::Target;
use crate::drilling::{ROUNDING, pecks};
use crate::error::ProgramError;
use crate::event::{Dwell, EventKind};
use crate::gcode::block::Block;
use crate::gcode::coordinates::{length, length_of, target};
use crate::gcode::cycle::Cycle;
use crate::gcode::position::Position;
use crate::gcode::state::State;
use crate::gcode::turn::turn;
use crate::gcode::vocabulary::{CycleKind, FeedMode, Plane};
use crate::gcode::{auxiliary, feed};
use crate::moves::MoveKind;

/// The most repetitions of a hole.
const MOST_REPETITIONS: u32 = 1000;
/// The axis is z within so many radians.
const UPRIGHT: f64 = 1e-9;

/// G73, G81 to G83, G85 and G89.
pub(crate) fn begin(state: &mut State, block: &Block<'_>, kind: CycleKind) -> Result<(), ProgramError> {
    if let Some(cycle) = &mut state.cycle {
        cycle.kind = kind;
    } else {
        let Some([_, _, z]) = state.position.point() else {
            let detail =
                "the position before the cycle is not known; accepted is a move with X, Y and Z before it";
            return Err(block.fault(detail.to_owned()));
        };
        state.cycle = Some(Cycle::new(kind, z));
    }
    holes(state, block)
}

/// A block while a cycle is in force: with a coordinate it is a hole.
pub(crate) fn holes(state: &mut State, block: &Block<'_>) -> Result<(), ProgramError> {
    let Some(mut cycle) = state.cycle else { return Ok(()) };
    let drills = block.has_any(b"XYZRABC");
    parameters(state, block, &mut cycle)?;
    state.cycle = Some(cycle);
    let repetitions = repetitions(block)?;
    if !drills {
        return Ok(());
    }
    turn(state, block, false)?;
    check(state, block)?;
    let hole = Hole::new(state, block, cycle)?;
    // With G91 each repetition is a step further.
    let from = state.position;
    let to = target(state, block)?;
    let (Some(start), Some(end)) = (from.point(), to.point()) else {
        let detail = "the position is not known; accepted is a move with X, Y and Z before the cycle";
        return Err(block.fault(detail.to_owned()));
    };
    let step = if state.modes.incremental { [end[0] - start[0], end[1] - start[1]] } else { [0.0; 2] };
    let first = [end[0], end[1]];
    for count in 0..repetitions {
        let place = [0, 1].map(|k| first[k] + step[k] * f64::from(count));
        hole.drill(state, block, place)?;
    }
    Ok(())
}

/// Takes Z, R, Q and P.
fn parameters(state: &mut State, block: &Block<'_>, cycle: &mut Cycle) -> Result<(), ProgramError> {
    if let Some(start) = length_of(state, block, b'R')? {
        cycle.start = Some(if state.modes.incremental { cycle.initial + start } else { start });
    }
    if let Some(bottom) = length_of(state, block, b'Z')? {
        let base = if state.modes.incremental { cycle.start.unwrap_or(cycle.initial) } else { 0.0 };
        cycle.bottom = Some(base + bottom);
    }
    if let Some(word) = block.take(b'Q') {
        let step = length(state, block, word)?.abs();
        if step <= 0.0 {
            return Err(block.fault_at(word, "the step of a peck must be positive".to_owned()));
        }
        cycle.step = Some(step);
    }
    if let Some(word) = block.take(b'P') {
        cycle.dwell = Some(Dwell::Seconds(auxiliary::seconds(state, block, word)?));
    }
    Ok(())
}

/// L or K: how often the hole is drilled.
fn repetitions(block: &Block<'_>) -> Result<u32, ProgramError> {
    let Some(word) = block.take(b'L').or_else(|| block.take(b'K')) else { return Ok(1) };
    let count = block.count(word)?;
    if count > MOST_REPETITIONS {
        return Err(block.fault_at(word, format!("a hole has at most {MOST_REPETITIONS} repetitions")));
    }
    Ok(count)
}

/// Whether a hole along z is one along the tool.
fn check(state: &State, block: &Block<'_>) -> Result<(), ProgramError> {
    let [x, y, z] = state.axis.orientation(state.builder.options.rotary_sense).axis();
    let turned = !state.centre_point.is_on() && !state.axis.is_upright();
    let detail = if state.tilt.is_some() || x.hypot(y) > UPRIGHT || z < 0.0 || turned {
        "a cycle with a tilted axis is not read; post the moves of the hole"
    } else if state.modes.plane != Plane::Xy {
        "a cycle along another axis than z is not read; accepted is G17 before it"
    } else if state.feed_mode == FeedMode::InverseTime {
        "a cycle with inverse time is not read; accepted is G94 or G95 before it"
    } else {
        return Ok(());
    };
    Err(block.fault(detail.to_owned()))
}

/// The heights of a hole, mm.
struct Hole {
    cycle: Cycle,
    start: f64,
    bottom: f64,
    retract: f64,
    feed: MoveKind,
}

impl Hole {
    fn new(state: &mut State, block: &Block<'_>, cycle: Cycle) -> Result<Self, ProgramError> {
        let (Some(start), Some(bottom)) = (cycle.start, cycle.bottom) else {
            let detail = "the cycle needs R, where the feed begins, and Z, where the hole ends";
            return Err(block.fault(detail.to_owned()));
        };
        if start < bottom {
            return Err(block.fault("the cycle begins below its end; R must be at least Z".to_owned()));
        }
        let retract = if state.modes.return_to_initial { cycle.initial.max(start) } else { start };
        let feed = feed::kind(state, block.line);
        Ok(Self { cycle, start, bottom, retract, feed })
    }

    /// Drills a hole. Like a controller, the tool first rises if it is too low, goes over the hole, and down to where
    /// the feed begins.
    fn drill(&self, state: &mut State, block: &Block<'_>, [x, y]: [f64; 2]) -> Result<(), ProgramError> {
        let Some([x0, y0, z0]) = state.position.point() else { return Ok(()) };
        let level = z0.max(self.start);
        if level > z0 + ROUNDING {
            go(state, block, MoveKind::Rapid, [x0, y0, level])?;
        }
        let mut stroke = |kind, z| go(state, block, kind, [x, y, z]);
        stroke(MoveKind::Rapid, level)?;
        stroke(MoveKind::Rapid, self.start)?;
        match (self.cycle.kind, self.cycle.step) {
            (CycleKind::Peck(kind), Some(step)) => {
                let strokes =
                    pecks(kind, self.start, self.bottom, step).map_err(|detail| block.fault(detail))?;
                for (kind, height) in strokes {
                    stroke(if kind == MoveKind::Feed { self.feed } else { kind }, height)?;
                }
            }
            (CycleKind::Peck(_), None) => {
                return Err(block.fault("the cycle needs Q, the depth of a peck".to_owned()));
            }
            _ => stroke(self.feed, self.bottom)?,
        }
        if let (CycleKind::Drill { dwell: true } | CycleKind::Bore { dwell: true }, Some(dwell)) =
            (self.cycle.kind, self.cycle.dwell)
        {
            let event = state.builder.event(block.line, EventKind::Dwell(dwell), "G4");
            event.map_err(|detail| block.fault(detail))?;
        }
        if let CycleKind::Bore { .. } = self.cycle.kind {
            go(state, block, self.feed, [x, y, self.start])?;
        }
        go(state, block, MoveKind::Rapid, [x, y, self.retract])
    }
}

/// Goes to a point, if the tool is not there.
fn go(state: &mut State, block: &Block<'_>, kind: MoveKind, point: [f64; 3]) -> Result<(), ProgramError> {
    let orientation = state.axis.orientation(state.builder.options.rotary_sense);
    let here = state.builder.position();
    if here.is_none_or(|last| last.tip() != point || last.orientation() != orientation) {
        let target = Target { line: block.line, kind, tip: point, orientation, feed: state.feed };
        state.builder.line(target).map_err(|detail| block.fault(detail))?;
    }
    state.position = Position::at(point);
    Ok(())
}
