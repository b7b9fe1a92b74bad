//! Finds what a statement does.

use crate::apt::lexer::{Token, TokenKind};
use crate::apt::state::{Extent, State};
use crate::apt::statement::Statement;
use crate::apt::vocabulary::Word;
use crate::apt::{auxiliary, circle, cycle, exit_line, feed, frame, motion};
use crate::diagnostics::shortened;
use crate::error::ProgramError;
use crate::event::EventKind;

/// So many numbers may be a point.
const POINT: usize = 3;

/// Does what a statement says.
pub(crate) fn execute(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    if state.extent == Extent::Finished {
        state.builder.diagnostics.warn(statement.line(), "", "what follows FINI is not read");
        return Ok(());
    }
    if statement.head().is_empty() {
        return row_of_numbers(state, statement);
    }
    let word = Word::of(statement.word());
    // Only points, and a feed between them, go on with a circle that may have ended.
    if !matches!(word, Word::Goto | Word::Feedrate) && state.arc.is_some_and(|arc| arc.swept.is_some()) {
        state.arc = None;
    }
    match word {
        Word::Goto => moving(state, statement, motion::goto),
        Word::Godlta => moving(state, statement, motion::godlta),
        Word::From => moving(state, statement, motion::from),
        Word::GoHome => moving(state, statement, motion::go_home),
        Word::ToolOn => moving(state, statement, exit_line::tool_on),
        Word::Circle => moving(state, statement, circle::circle),
        Word::MoveArc => moving(state, statement, circle::move_arc),
        Word::ToolAxis => motion::tool_axis(state, statement),
        Word::MultiAxis => motion::multi_axis(state, statement),
        Word::Direction => exit_line::direction(state, statement),
        Word::PartSurface => exit_line::part_surface(state, statement),
        Word::Units => frame::units(state, statement),
        Word::CoordinateSystem => frame::coordinate_system(state, statement),
        Word::TransformationType => frame::transformation_type(state, statement),
        Word::MachineSystem => frame::machine_system(state, statement),
        Word::Shift => frame::shift(state, statement),
        Word::LoadTool => auxiliary::load_tool(state, statement),
        Word::Load => auxiliary::load_something(state, statement),
        Word::Spindle => auxiliary::spindle(state, statement),
        Word::Coolant => auxiliary::coolant(state, statement),
        Word::Delay => auxiliary::delay(state, statement),
        Word::CutterCompensation => auxiliary::compensation(state, statement),
        Word::Feedrate => feedrate(state, statement),
        Word::Cycle => switch_cycle(state, statement),
        other => simple(state, statement, other),
    }
}

/// The words that need no module of their own.
fn simple(state: &mut State, statement: &Statement<'_>, word: Word) -> Result<(), ProgramError> {
    match word {
        Word::Rapid => state.rapid = true,
        Word::AutomaticPartSurface => state.guides.plane = None,
        Word::Stop => return auxiliary::event(state, statement, EventKind::Stop),
        Word::OptionalStop => return auxiliary::event(state, statement, EventKind::OptionalStop),
        Word::PassedOn => return auxiliary::event(state, statement, EventKind::Other),
        Word::End => {
            state.extent = Extent::Ended;
            return auxiliary::event(state, statement, EventKind::End);
        }
        Word::EndOfPath => state.extent = Extent::Ended,
        Word::Fini => state.extent = Extent::Finished,
        Word::ToolPath if statement.head().get(1).is_some_and(|token| token.is("PATH")) => {
            state.extent = Extent::Begun;
        }
        Word::Silent => {}
        Word::Moving(detail) => return Err(statement.fault(detail.to_owned())),
        _ => return unknown(state, statement),
    }
    Ok(())
}

/// A word that no table knows: a fault if its numbers may be a point, otherwise a warning.
fn unknown(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let arguments = statement.arguments();
    let numbers = |tokens: &[Token<'_>]| tokens.iter().all(|token| token.number().is_some());
    let point = arguments.windows(POINT).any(numbers);
    let moves = ["GO", "TLON", "TLL", "TLR", "MOV"].iter().any(|start| statement.word().starts_with(start));
    if point || moves || arguments.iter().any(|token| token.is("=")) {
        let detail = "the word is not known and may move the tool; accepted are GOTO, GODLTA, FROM, CIRCLE, MOVARC, \
                      TLON and CYCLE";
        return Err(statement.fault(detail.to_owned()));
    }
    let detail = "the word is not known and does not move the tool; it is left out";
    state.builder.diagnostics.warn(statement.line(), &shortened(statement.word()), detail);
    Ok(())
}

/// Creo may write the points of a circle as rows of numbers.
fn row_of_numbers(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let first = statement.arguments().first();
    let number = first.is_some_and(|token| matches!(token.kind, TokenKind::Number(_)));
    if number && state.arc.is_some_and(|arc| arc.swept.is_some()) {
        return moving(state, statement, motion::goto);
    }
    let detail =
        "a statement begins with a word, as in GOTO/x,y,z; a line that goes on ends with $".to_owned();
    Err(match first {
        Some(token) => statement.fault_at(token, detail),
        None => statement.fault(detail),
    })
}

fn moving(
    state: &mut State,
    statement: &Statement<'_>,
    motion: fn(&mut State, &Statement<'_>) -> Result<(), ProgramError>,
) -> Result<(), ProgramError> {
    if state.extent == Extent::Ended {
        state.extent = Extent::Begun;
    }
    frame::check(state)?;
    motion(state, statement)
}

fn feedrate(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let (value, rate) = feed::parse(statement)?;
    let millimetres = if rate.needs_units() { state.millimetres(statement)? } else { 1.0 };
    state.feed = rate.feed(value, millimetres).map_err(|detail| statement.fault(detail))?;
    Ok(())
}

fn switch_cycle(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    match cycle::parse(statement)? {
        cycle::Switch::Begin(cycle) => {
            state.cycle = Some(cycle);
            state.last_cycle = Some(cycle);
        }
        cycle::Switch::Resume => {
            let last = state.last_cycle;
            state.cycle =
                Some(last.ok_or_else(|| statement.fault("CYCLE/ON needs a cycle before it".to_owned()))?);
        }
        cycle::Switch::End => state.cycle = None,
        cycle::Switch::Keep => {}
    }
    Ok(())
}
