//! Turns the tool as A, B and C, or with G43.5 as I, J and K say.

use crate::error::ProgramError;
use crate::gcode::block::Block;
use crate::gcode::lexer::Word;
use crate::gcode::state::State;
use crate::gcode::tool_axis::{LARGEST, TiltLetter};
use crate::orientation::unit;

/// The letters of the angles.
pub(crate) const ANGLES: [u8; 3] = *b"ABC";
/// The letters of a centre or an axis.
pub(crate) const VECTOR: [u8; 3] = *b"IJK";

/// Turns the tool as the angles or the vector of a block say.
pub(crate) fn turn(state: &mut State, block: &Block<'_>, arc: bool) -> Result<(), ProgramError> {
    if let Some(word) = block.first_of(&ANGLES) {
        if !state.centre_point.is_on() {
            let detail = "words A, B and C need control of the tool centre point, which is off; accepted are G43.4 \
                          before them, tcp in the request, or the codes that switch it in tcp_on";
            state.builder.diagnostics.fault(block.fault_at(word, detail.to_owned()));
            // One such fault says it all: the rest of the program is checked as if the control were on.
            state.centre_point.always = true;
        }
        let detail = if state.centre_point.has_vector() {
            "with G43.5 the axis is stated as I, J, K; accepted are words A, B and C with G43.4"
        } else if state.tilt.is_some() {
            "words A, B and C in a tilted plane are not read; accepted is G69 before them"
        } else {
            return turn_by_words(state, block);
        };
        return Err(block.fault_at(word, detail.to_owned()));
    }
    if state.centre_point.has_vector()
        && !arc
        && let Some(first) = block.first_of(&VECTOR)
    {
        let vector = VECTOR.map(|letter| block.take(letter).map_or(0.0, |word| word.value));
        let vector = state.tilt.as_ref().map_or(vector, |tilt| tilt.direction_to_program(vector));
        let Some(axis) = unit(vector) else {
            let detail = "the axis is (0, 0, 0); accepted is a vector I, J, K from the tip to the holder";
            return Err(block.fault_at(first, detail.to_owned()));
        };
        state.axis.set_vector(axis);
    }
    Ok(())
}

fn turn_by_words(state: &mut State, block: &Block<'_>) -> Result<(), ProgramError> {
    let words = ANGLES.map(|letter| block.take(letter));
    let (letter, tilt) = match words {
        [Some(_), Some(word), _] => {
            let detail = "A with B is not read; accepted are A with C, or B with C";
            return Err(block.fault_at(word, detail.to_owned()));
        }
        [Some(word), None, _] => (Some(TiltLetter::A), Some(word)),
        [None, Some(word), _] => (Some(TiltLetter::B), Some(word)),
        [None, None, _] => (state.axis.letter, None),
    };
    if let (Some(known), Some(word)) = (state.axis.letter, tilt)
        && letter != Some(known)
    {
        let detail = format!(
            "the program tilts the tool by {known:?} before; accepted is one of A and B in a program"
        );
        return Err(block.fault_at(word, detail));
    }
    let angle = |word, before: Option<f64>| {
        let Some(word): Option<&Word<'_>> = word else {
            let detail = "the angles after an axis of I, J, K or G53.1 are not known; accepted are both words, A or B, \
                          and C";
            return before.ok_or_else(|| block.fault(detail.to_owned()));
        };
        let base = if state.modes.incremental { before } else { Some(0.0) };
        let value = base.map(|base| base + word.value).filter(|value| value.abs() <= LARGEST);
        value.ok_or_else(|| {
            let detail =
                "an angle must lie within 1000000 degrees, and with G91 the one before must be known";
            block.fault_at(word, detail.to_owned())
        })
    };
    let (tilt, turn) = (angle(tilt, state.axis.tilt())?, angle(words[2], state.axis.turn())?);
    if letter == Some(TiltLetter::B) && state.axis.letter.is_none() {
        // Until now phi1 is 0, and the axis does not depend on phi2. Now it is known that C counts from the y axis.
        state.builder.add_to_phi2(std::f64::consts::FRAC_PI_2);
    }
    state.axis.letter = letter;
    state.axis.set_words(tilt, turn);
    Ok(())
}
