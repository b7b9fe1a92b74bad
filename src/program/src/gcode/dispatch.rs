//! Does what a block says, in the order in which controllers do it.

use crate::error::ProgramError;
use crate::event::EventKind;
use crate::gcode::block::Block;
use crate::gcode::codes::Codes;
use crate::gcode::state::{Extent, State};
use crate::gcode::vocabulary::{Group, Meaning};
use crate::gcode::{auxiliary, feed, length, motion, tilt};

/// Does what a block says.
pub(crate) fn execute(state: &mut State, block: &Block<'_>) -> Result<(), ProgramError> {
    let first = matches!(state.extent, Extent::Empty | Extent::Marked);
    state.extent = match state.extent {
        Extent::Empty => Extent::Open,
        Extent::Marked => Extent::OpenMarked,
        Extent::Finished => {
            state.builder.diagnostics.warn(block.line, "", "what follows the end of the program is not read");
            return Ok(());
        }
        other => other,
    };
    block.take(b'N');
    if let Some(word) = block.take(b'O') {
        if !first {
            let detail = "a second program number: subprograms are not read; post one program without calls";
            return Err(block.fault_at(word, detail.to_owned()));
        }
        let event = state.builder.event(block.line, EventKind::Comment, word.text);
        event.map_err(|detail| block.fault(detail))?;
    }
    let codes = Codes::of(block, &state.builder.options)?;
    modes(state, block, &codes);
    feed::apply(state, block, &codes)?;
    auxiliary::before_motion(state, block, &codes)?;
    auxiliary::dwell(state, block, &codes)?;
    auxiliary::compensation(state, block, &codes)?;
    auxiliary::path_control(state, block, &codes)?;
    length::apply(state, block, &codes)?;
    length::apply_offset(state, block, &codes)?;
    tilt::apply(state, block, &codes)?;
    motion::apply(state, block, &codes)?;
    auxiliary::after_motion(state, block, &codes)?;
    leftovers(state, block)
}

/// The modes that later steps use.
fn modes(state: &mut State, block: &Block<'_>, codes: &Codes<'_, '_>) {
    if let Some(Meaning::Units(units)) = codes.get(Group::Units)
        && state.units != Some(units)
    {
        if state.units.is_some() && state.builder.move_count() > 0 {
            let detail = "the unit of lengths changes within the program";
            state.builder.diagnostics.warn(block.line, "", detail);
        } else {
            state.builder.set_units(units);
        }
        state.units = Some(units);
    }
    if let Some(Meaning::Plane(plane)) = codes.get(Group::Plane) {
        state.modes.plane = plane;
    }
    if let Some(Meaning::Incremental(incremental)) = codes.get(Group::Distance) {
        state.modes.incremental = incremental;
    }
    if let Some(Meaning::CentreAbsolute(absolute)) = codes.get(Group::CentreDistance) {
        state.modes.centre_absolute = absolute;
    }
    if let Some(Meaning::ReturnToInitial(initial)) = codes.get(Group::Return) {
        state.modes.return_to_initial = initial;
    }
}

/// Words that nothing has used: faults if they may move the tool.
fn leftovers(state: &mut State, block: &Block<'_>) -> Result<(), ProgramError> {
    if let Some(word) = block.first_of(b"EUVW") {
        let detail = "the machine has no such axis; accepted are X, Y, Z, and A or B with C";
        return Err(block.fault_at(word, detail.to_owned()));
    }
    if let Some(word) = block.first_of(b"IJKRXYZABC") {
        let detail = "nothing uses the word; I, J, K and R belong to arcs, cycles and tilted planes, and I, J, K are \
                      an axis with G43.5";
        return Err(block.fault_at(word, detail.to_owned()));
    }
    for letter in b"DLPQ" {
        if let Some(word) = block.take(*letter) {
            state.builder.diagnostics.warn(block.line, word.text, "nothing uses the word; it is left out");
        }
    }
    Ok(())
}
