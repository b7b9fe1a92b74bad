//! Spindle, tools, coolant, waits and the other codes without motion.

use crate::error::ProgramError;
use crate::event::{Dwell, EventKind, Rotation, Spindle};
use crate::gcode::block::Block;
use crate::gcode::codes::Codes;
use crate::gcode::lexer::Word;
use crate::gcode::state::{Extent, State};
use crate::gcode::vocabulary::{Group, Meaning, Miscellaneous};
use crate::options::Compensation;

/// A whole number of at least so many without a point is in milliseconds, as Fanuc counts.
const MILLISECONDS: f64 = 100.0;

/// Does what S, T and the M codes say that act before the motion.
pub(crate) fn before_motion(
    state: &mut State,
    block: &Block<'_>,
    codes: &Codes<'_, '_>,
) -> Result<(), ProgramError> {
    spindle(state, block, codes)?;
    if let Some(word) = block.take(b'T') {
        state.tool.selected = Some((block.count(word)?, block.line));
    }
    for (code, word) in &codes.miscellaneous {
        match code {
            Miscellaneous::ToolChange => change_tool(state, block)?,
            Miscellaneous::Coolant(coolant) => {
                add(state, block, EventKind::Coolant(*coolant), word.text)?;
            }
            Miscellaneous::Unknown => pass_on(state, block, codes, word)?,
            _ => {}
        }
    }
    Ok(())
}

/// Does what M0, M1, M2 and M30 say.
pub(crate) fn after_motion(
    state: &mut State,
    block: &Block<'_>,
    codes: &Codes<'_, '_>,
) -> Result<(), ProgramError> {
    for (code, word) in &codes.miscellaneous {
        let kind = match code {
            Miscellaneous::Stop => EventKind::Stop,
            Miscellaneous::OptionalStop => EventKind::OptionalStop,
            Miscellaneous::End => {
                state.extent = Extent::Finished;
                EventKind::End
            }
            _ => continue,
        };
        add(state, block, kind, word.text)?;
    }
    Ok(())
}

/// G4: P, or X or U in seconds.
pub(crate) fn dwell(state: &mut State, block: &Block<'_>, codes: &Codes<'_, '_>) -> Result<(), ProgramError> {
    if codes.get(Group::Once) != Some(Meaning::Dwell) {
        return Ok(());
    }
    let text = block.text_of(b"GPXU");
    let Some(word) = block.take(b'P').or_else(|| block.take(b'X')).or_else(|| block.take(b'U')) else {
        let detail = "the wait has no time; accepted is G4 P, or G4 X in seconds";
        return Err(codes.fault(block, Group::Once, detail.to_owned()));
    };
    let seconds = seconds(state, block, word)?;
    add(state, block, EventKind::Dwell(Dwell::Seconds(seconds)), &text)
}

/// The seconds of P, X or U.
pub(crate) fn seconds(state: &mut State, block: &Block<'_>, word: &Word<'_>) -> Result<f64, ProgramError> {
    if word.value < 0.0 {
        return Err(block.fault_at(word, "a wait cannot be negative".to_owned()));
    }
    if word.letter == b'P' && word.value >= MILLISECONDS && !word.digits.contains('.') {
        let detail = "a wait of 100 or more without a point is taken as milliseconds";
        state.builder.diagnostics.warn(block.line, "P", detail);
        return Ok(word.value / 1000.0);
    }
    Ok(word.value + 0.0)
}

/// G40 to G42: the points are the tool's path, whatever the controller adds.
pub(crate) fn compensation(
    state: &mut State,
    block: &Block<'_>,
    codes: &Codes<'_, '_>,
) -> Result<(), ProgramError> {
    let (Some(Meaning::Compensation(on)), Some(word)) =
        (codes.get(Group::Compensation), codes.word(Group::Compensation))
    else {
        return Ok(());
    };
    block.take(b'D');
    if on && state.builder.options.compensation == Compensation::Refuse {
        let detail =
            "cutter radius compensation is refused; post the tool's path, or accept it with compensation";
        return Err(block.fault_at(word, detail.to_owned()));
    }
    if on {
        let detail = "cutter radius compensation: the points are taken as the tool's path";
        state.builder.diagnostics.warn(block.line, word.text, detail);
    }
    if on == state.compensated {
        return Ok(());
    }
    state.compensated = on;
    add(state, block, EventKind::Compensation { on }, word.text)
}

/// G61 and G64 are for the controller.
pub(crate) fn path_control(
    state: &mut State,
    block: &Block<'_>,
    codes: &Codes<'_, '_>,
) -> Result<(), ProgramError> {
    let Some(word) = codes.word(Group::PathControl) else { return Ok(()) };
    let parameters = [b'P', b'Q'].into_iter().filter_map(|letter| block.take(letter));
    let text = parameters.fold(word.text.to_owned(), |text, word| text + " " + word.text);
    add(state, block, EventKind::Insert, &text)
}

fn spindle(state: &mut State, block: &Block<'_>, codes: &Codes<'_, '_>) -> Result<(), ProgramError> {
    let speed = block.take(b'S');
    let rotation = codes.miscellaneous.iter().find_map(|(code, word)| match code {
        Miscellaneous::Spindle(rotation) => Some((*rotation, *word)),
        _ => None,
    });
    if let Some(word) = speed.filter(|word| word.value < 0.0) {
        return Err(
            block.fault_at(word, "a speed cannot be negative; accepted are S with M3 or M4".to_owned())
        );
    }
    let text = match (speed, rotation) {
        (None, None) => return Ok(()),
        (Some(speed), Some((_, rotation))) => format!("{} {}", speed.text, rotation.text),
        (Some(word), None) | (None, Some((_, word))) => word.text.to_owned(),
    };
    let spindle = Spindle {
        speed: speed.map(|word| word.value + 0.0),
        rotation: rotation.map(|(rotation, _): (Rotation, _)| rotation),
    };
    add(state, block, EventKind::Spindle(spindle), &text)
}

/// M6 loads the tool of the last T.
fn change_tool(state: &mut State, block: &Block<'_>) -> Result<(), ProgramError> {
    let number = state.tool.selected.take().map(|(number, _)| number).or(state.tool.loaded);
    state.tool.loaded = number;
    state.tool.entry = None;
    let text = number.map_or("M6".to_owned(), |number| format!("T{number} M6"));
    add(state, block, EventKind::Tool { number, length: None }, &text)
}

/// A code of the machine, with its parameters if no G code can use them.
fn pass_on(
    state: &mut State,
    block: &Block<'_>,
    codes: &Codes<'_, '_>,
    word: &Word<'_>,
) -> Result<(), ProgramError> {
    state.builder.diagnostics.warn(block.line, word.text, "the M code is not known; it is passed on");
    let mut text = word.text.to_owned();
    if codes.get(Group::Once).is_none() && codes.get(Group::Motion).is_none() && state.cycle.is_none() {
        for parameter in [b'P', b'Q', b'L'].into_iter().filter_map(|letter| block.take(letter)) {
            text = text + " " + parameter.text;
        }
    }
    add(state, block, EventKind::Insert, &text)
}

fn add(state: &mut State, block: &Block<'_>, kind: EventKind, text: &str) -> Result<(), ProgramError> {
    state.builder.event(block.line, kind, text).map_err(|detail| block.fault(detail))
}
