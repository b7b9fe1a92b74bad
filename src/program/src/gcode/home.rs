//! G28, G30 and G53: the tool leaves for a place of the machine, which the program does not state.

use crate::error::ProgramError;
use crate::event::EventKind;
use crate::gcode::block::Block;
use crate::gcode::codes::Codes;
use crate::gcode::position::Position;
use crate::gcode::state::State;
use crate::gcode::vocabulary::{Group, Motion};

/// The letters that these codes use.
const LETTERS: &[u8; 6] = b"XYZABC";

/// G28 and G30.
pub(crate) fn reference(
    state: &mut State,
    block: &Block<'_>,
    codes: &Codes<'_, '_>,
) -> Result<(), ProgramError> {
    leave(state, block, codes, |_| Some(0.0))
}

/// G53.
pub(crate) fn machine_coordinates(
    state: &mut State,
    block: &Block<'_>,
    codes: &Codes<'_, '_>,
) -> Result<(), ProgramError> {
    if !block.has_any(LETTERS) {
        return Ok(());
    }
    if state.motion != Some(Motion::Rapid) {
        let detail = "machine coordinates in a cut are not read; accepted is G53 with G0".to_owned();
        return Err(codes.fault(block, Group::Once, detail));
    }
    let incremental = state.modes.incremental;
    leave(state, block, codes, |angle| angle.filter(|_| !incremental))
}

/// `angle` gives an angle of the tool there from its word.
fn leave(
    state: &mut State,
    block: &Block<'_>,
    codes: &Codes<'_, '_>,
    angle: impl Fn(Option<f64>) -> Option<f64>,
) -> Result<(), ProgramError> {
    let code = codes.word(Group::Once).map_or("", |word| word.text);
    let detail = "the tool goes to a place that the program does not state; the next move needs X, Y and Z";
    state.builder.diagnostics.warn(block.line, code, detail);
    let text = format!("{code} {}", block.text_of(LETTERS));
    for letter in b"XYZ" {
        block.take(*letter);
    }
    let tilt = block.take(b'A').or_else(|| block.take(b'B'));
    block.take(b'B');
    let turn = block.take(b'C');
    let stated = |word: Option<&crate::gcode::lexer::Word<'_>>, known: Option<f64>| match word {
        Some(word) => angle(Some(word.value)),
        None => known,
    };
    let (tilt, turn) = (stated(tilt, state.axis.tilt()), stated(turn, state.axis.turn()));
    if let (Some(tilt), Some(turn)) = (tilt, turn) {
        state.axis.set_words(tilt, turn);
    }
    state.position = Position { coordinates: [None; 3], left: true };
    let event = state.builder.event(block.line, EventKind::Home, text.trim_end());
    event.map_err(|detail| block.fault(detail))
}
