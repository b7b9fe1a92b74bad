//! Tool length, control of the tool centre point, and work offsets.

use crate::error::ProgramError;
use crate::event::EventKind;
use crate::gcode::block::Block;
use crate::gcode::codes::{Codes, Switch};
use crate::gcode::position::Position;
use crate::gcode::state::{AxisWords, State};
use crate::gcode::vocabulary::{Group, Length, Meaning};

/// Does what G43, G43.4, G43.5, G49, H and the codes of the request say.
pub(crate) fn apply(state: &mut State, block: &Block<'_>, codes: &Codes<'_, '_>) -> Result<(), ProgramError> {
    let was_on = state.centre_point.is_on();
    if let Some(word) = block.take(b'H') {
        state.tool.entry = Some(block.count(word)?);
        // Without a code, another entry replaces the one in force.
        if codes.get(Group::Length).is_none() && (state.tool.length.is_some() || codes.switch.is_some()) {
            set_length(state, block, state.tool.entry, "H")?;
        }
    }
    if let (Some(Meaning::Length(length)), Some(word)) = (codes.get(Group::Length), codes.word(Group::Length))
    {
        state.centre_point.by_length = match length {
            Length::Rotary => Some(AxisWords::Angles),
            Length::Vector => Some(AxisWords::Vector),
            Length::Along | Length::Off => None,
        };
        if length == Length::Off {
            set_length(state, block, None, word.text)?;
        } else {
            let entry = state.tool.entry.or(state.tool.loaded);
            if entry.is_none() {
                let detail =
                    "the length has no number; accepted are G43, G43.4 and G43.5 with H, or after M6";
                return Err(block.fault_at(word, detail.to_owned()));
            }
            set_length(state, block, entry, word.text)?;
        }
    }
    let mut text = codes.word(Group::Length).map_or("", |word| word.text);
    if let Some((switch, word)) = codes.switch {
        let control = &mut state.centre_point;
        control.by_code = match switch {
            Switch::On => true,
            Switch::Off => false,
            Switch::Toggle => !control.is_on(),
        };
        control.by_length = control.by_length.filter(|_| control.by_code);
        text = word.text;
    }
    let on = state.centre_point.is_on();
    if on == was_on {
        return Ok(());
    }
    add(state, block, EventKind::CentrePointControl { on }, text)
}

/// G54 to G59.3: the coordinates of the tool in another offset are not known here.
pub(crate) fn apply_offset(
    state: &mut State,
    block: &Block<'_>,
    codes: &Codes<'_, '_>,
) -> Result<(), ProgramError> {
    let Some(Meaning::Offset(offset)) = codes.get(Group::Offset) else { return Ok(()) };
    if offset == state.offset {
        return Ok(());
    }
    state.offset = offset;
    state.position = Position { coordinates: [None; 3], ..state.position };
    add(state, block, EventKind::WorkOffset(offset), offset.name())
}

fn set_length(
    state: &mut State,
    block: &Block<'_>,
    entry: Option<u32>,
    code: &str,
) -> Result<(), ProgramError> {
    if state.tool.length == entry {
        return Ok(());
    }
    state.tool.length = entry;
    let h = block.text_of(b"H");
    let text = match code {
        "H" => h,
        code if h.is_empty() => code.to_owned(),
        code => format!("{code} {h}"),
    };
    add(state, block, EventKind::LengthOffset { number: entry }, &text)
}

fn add(state: &mut State, block: &Block<'_>, kind: EventKind, text: &str) -> Result<(), ProgramError> {
    state.builder.event(block.line, kind, text).map_err(|detail| block.fault(detail))
}
