//! The moves of a block: straight ones, arcs and holes.

use crate::builder::Target;
use crate::error::ProgramError;
use crate::event::EventKind;
use crate::gcode::block::Block;
use crate::gcode::codes::Codes;
use crate::gcode::coordinates::{AXES, target, to_program};
use crate::gcode::position::Position;
use crate::gcode::state::State;
use crate::gcode::turn::{ANGLES, VECTOR, turn};
use crate::gcode::vocabulary::{Group, Meaning, Motion};
use crate::gcode::{circle, feed, hole, home};
use crate::moves::MoveKind;

/// Does what G0 to G3, the cycles, G28, G30 and G53 of a block say, and its coordinates.
pub(crate) fn apply(state: &mut State, block: &Block<'_>, codes: &Codes<'_, '_>) -> Result<(), ProgramError> {
    if codes.get(Group::CycleOff).is_some() {
        state.cycle = None;
    }
    let once = codes.get(Group::Once);
    match codes.get(Group::Motion) {
        Some(Meaning::Motion(motion)) => {
            state.motion = Some(motion);
            state.cycle = None;
        }
        Some(Meaning::Cycle(kind)) if once.is_none() => return hole::begin(state, block, kind),
        _ => {}
    }
    match once {
        Some(Meaning::Reference) => return home::reference(state, block, codes),
        Some(Meaning::MachineCoordinates) => return home::machine_coordinates(state, block, codes),
        _ => {}
    }
    if state.cycle.is_some() {
        return hole::holes(state, block);
    }
    if moves(state, block) { go(state, block) } else { Ok(()) }
}

/// Whether the words of a block move the tool.
fn moves(state: &State, block: &Block<'_>) -> bool {
    let arc = matches!(state.motion, Some(Motion::Clockwise | Motion::CounterClockwise));
    block.has_any(&AXES)
        || block.has_any(&ANGLES)
        || block.has_any(&VECTOR) && (arc || state.centre_point.has_vector())
        || arc && block.has_any(b"R")
}

/// A straight move or an arc.
fn go(state: &mut State, block: &Block<'_>) -> Result<(), ProgramError> {
    let Some(motion) = state.motion else {
        return Err(
            block.fault("no motion is in force; accepted is G0, G1, G2 or G3 before coordinates".to_owned())
        );
    };
    let arc = matches!(motion, Motion::Clockwise | Motion::CounterClockwise);
    turn(state, block, arc)?;
    let kind = if motion == Motion::Rapid { MoveKind::Rapid } else { feed::kind(state, block.line) };
    if !points_are_known(state) {
        return leave(state, block, kind);
    }
    let end = target(state, block)?;
    let Some(point) = end.point() else { return incomplete(state, block, kind, end) };
    let target = Target {
        line: block.line,
        kind,
        tip: to_program(state, point),
        orientation: state.axis.orientation(state.builder.options.rotary_sense),
        feed: state.feed,
    };
    if arc {
        circle::arc(state, block, motion, target, point)?;
    } else {
        state.builder.line(target).map_err(|detail| block.fault(detail))?;
    }
    state.position = end;
    Ok(())
}

/// Without control of the tool centre point, the points are in the part only while nothing is turned, or in a tilted
/// plane to which the tool is aligned.
fn points_are_known(state: &State) -> bool {
    let aligned = state.tilt.as_ref().is_some_and(|tilt| tilt.aligned);
    state.centre_point.is_on() || aligned || state.axis.is_upright()
}

/// A rapid to a point that is not known.
fn leave(state: &mut State, block: &Block<'_>, kind: MoveKind) -> Result<(), ProgramError> {
    let detail = "the tool is tilted or the part is turned while control of the tool centre point is off, so the point \
                  in the part is not known";
    if kind == MoveKind::Feed {
        // One such fault is enough.
        state.centre_point.always = true;
        let accepted = "accepted are G43.4 or G43.5 before, or tcp, or codes in tcp_on that switch it";
        return Err(block.fault(format!("{detail}; {accepted}")));
    }
    for letter in AXES {
        block.take(letter);
    }
    state.builder.diagnostics.warn(block.line, "", &format!("{detail}: the rapid is an event"));
    state.position = Position { coordinates: [None; 3], left: true };
    let event = state.builder.event(block.line, EventKind::Home, &block.text_of(b"GXYZ"));
    event.map_err(|detail| block.fault(detail))
}

/// A move to a position of which coordinates are not known: at the beginning, and in another work offset.
fn incomplete(
    state: &mut State,
    block: &Block<'_>,
    kind: MoveKind,
    end: Position,
) -> Result<(), ProgramError> {
    if kind == MoveKind::Feed {
        let detail = "the position is not known yet; accepted is a move with X, Y and Z before this one";
        // One such fault is enough.
        state.position = Position::at(end.coordinates.map(Option::unwrap_or_default));
        return Err(block.fault(detail.to_owned()));
    }
    let detail = "a rapid before X, Y and Z are all known is left out";
    state.builder.diagnostics.warn(block.line, "", detail);
    state.position = end;
    Ok(())
}
