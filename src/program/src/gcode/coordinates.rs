//! X, Y and Z of blocks: lengths in mm, and the positions to which they lead.

use crate::error::ProgramError;
use crate::gcode::block::Block;
use crate::gcode::lexer::Word;
use crate::gcode::position::Position;
use crate::gcode::state::State;

/// The letters of the coordinates.
pub(crate) const AXES: [u8; 3] = *b"XYZ";
/// The largest coordinate in mm, as for every format.
const LARGEST: f64 = 1e7;

/// The length of a word in mm.
pub(crate) fn length(state: &mut State, block: &Block<'_>, word: &Word<'_>) -> Result<f64, ProgramError> {
    // Adding zero turns -0.0 into 0.0.
    let length = word.value * state.millimetres(block.line) + 0.0;
    if length.abs() > LARGEST {
        return Err(block.fault_at(word, format!("the length is beyond {LARGEST} mm; check the units")));
    }
    Ok(length)
}

/// The length of the word of a letter in mm, if the block has one.
pub(crate) fn length_of(
    state: &mut State,
    block: &Block<'_>,
    letter: u8,
) -> Result<Option<f64>, ProgramError> {
    block.take(letter).map(|word| length(state, block, word)).transpose()
}

/// The position to which the words X, Y and Z of a block lead. Coordinates may still be unknown.
pub(crate) fn target(state: &mut State, block: &Block<'_>) -> Result<Position, ProgramError> {
    let mut target = state.position;
    for (letter, coordinate) in AXES.into_iter().zip(&mut target.coordinates) {
        let Some(word) = block.take(letter) else { continue };
        let value = length(state, block, word)?;
        *coordinate = Some(if state.modes.incremental {
            let detail = "the position is not known; accepted is a move with X, Y and Z under G90 before G91";
            coordinate.ok_or_else(|| block.fault_at(word, detail.to_owned()))? + value
        } else {
            value
        });
    }
    if state.position.left && target.point().is_none() {
        // One such fault is enough.
        state.position = Position::at(target.coordinates.map(Option::unwrap_or_default));
        let detail = "after G28, G30 or G53 the position is not known: the next move needs X, Y and Z";
        return Err(block.fault(detail.to_owned()));
    }
    Ok(Position { left: false, ..target })
}

/// The point in the program's frame of a point in the coordinates of blocks.
pub(crate) fn to_program(state: &State, point: [f64; 3]) -> [f64; 3] {
    state.tilt.as_ref().map_or(point, |tilt| tilt.point_to_program(point))
}
