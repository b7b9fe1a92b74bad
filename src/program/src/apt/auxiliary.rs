//! Tools, spindle, coolant, waits and compensation.

use crate::apt::lexer::Token;
use crate::apt::state::State;
use crate::apt::statement::Statement;
use crate::error::ProgramError;
use crate::event::{Coolant, Dwell, EventKind, Rotation, Spindle};
use crate::options::Compensation;

const LOADTL: &str = "LOADTL/number with an optional LENGTH,value, or LOAD/TOOL,number";
const SPINDL: &str = "SPINDL/value,RPM,CLW, SPINDL/ON or SPINDL/OFF";
const DELAY: &str = "DELAY/seconds, or DELAY/REV,turns";

/// Adds an event with the text of the statement.
pub(crate) fn event(
    state: &mut State,
    statement: &Statement<'_>,
    kind: EventKind,
) -> Result<(), ProgramError> {
    state.builder.event(statement.line(), kind, statement.text).map_err(|detail| statement.fault(detail))
}

/// LOADTL.
pub(crate) fn load_tool(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    load(state, statement, statement.arguments())
}

/// LOAD/TOOL; other things are passed on.
pub(crate) fn load_something(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    match statement.arguments() {
        [what, rest @ ..] if what.is("TOOL") => load(state, statement, rest),
        _ => event(state, statement, EventKind::Other),
    }
}

fn load(state: &mut State, statement: &Statement<'_>, arguments: &[Token<'_>]) -> Result<(), ProgramError> {
    let number = match arguments.first() {
        Some(first) if first.number().is_some() => Some(statement.count(first)?),
        Some(_) => {
            let detail = "the tool has a name and no number: a table of lengths cannot name it";
            state.builder.diagnostics.warn(statement.line(), statement.word(), detail);
            None
        }
        None => return Err(statement.fault(format!("the tool has no number; accepted: {LOADTL}"))),
    };
    let named = arguments.iter().position(|token| token.is("LENGTH"));
    let token = match named {
        Some(at) => arguments.get(at + 1),
        // Fusion: number, 0, length, entry.
        None if arguments.len() == 4 && arguments.iter().all(|token| token.number().is_some()) => {
            arguments.get(2).filter(|token| token.number() != Some(0.0))
        }
        None => None,
    };
    if named.is_some() && token.is_none() {
        return Err(statement.fault(format!("LENGTH has no value; accepted: {LOADTL}")));
    }
    let length = match token {
        Some(token) => {
            let length = statement.number(token, LOADTL)? * state.millimetres(statement)?;
            if !(0.0..=1e6).contains(&length) {
                let detail = "a tool's length lies between 0 and 1000000 mm".to_owned();
                return Err(statement.fault_at(token, detail));
            }
            Some(length)
        }
        None => None,
    };
    event(state, statement, EventKind::Tool { number, length })
}

/// SPINDL: speed and sense in any order.
pub(crate) fn spindle(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let (mut speed, mut rotation, mut surface) = (None, None, false);
    let mut arguments = statement.arguments().iter();
    while let Some(token) = arguments.next() {
        match token.text {
            "CLW" => rotation = Some(Rotation::Clockwise),
            "CCLW" => rotation = Some(Rotation::CounterClockwise),
            "OFF" => rotation = Some(Rotation::Off),
            "SFM" | "SMM" => surface = true,
            // The number of these does not concern the speed.
            "RANGE" | "MAXRPM" | "RADIUS" | "ORIENT" => drop(arguments.next()),
            _ if token.number().is_some() && speed.is_none() => {
                speed = Some(statement.number(token, SPINDL)?);
            }
            _ => {}
        }
    }
    if speed.is_some_and(|speed| speed < 0.0) {
        return Err(statement.fault(format!("a speed cannot be negative; accepted: {SPINDL}")));
    }
    if surface {
        let detail = "the speed is one of the surface: turns per minute are not known";
        state.builder.diagnostics.warn(statement.line(), statement.word(), detail);
        speed = None;
    }
    event(state, statement, EventKind::Spindle(Spindle { speed, rotation }))
}

/// COOLNT.
pub(crate) fn coolant(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let coolant = match statement.arguments().first().map(|token| token.text) {
        Some("OFF") => Coolant::Off,
        None | Some("ON" | "FLOOD") => Coolant::Flood,
        Some("MIST") => Coolant::Mist,
        Some("THRU" | "THROUGH") => Coolant::Through,
        Some(_) => return event(state, statement, EventKind::Other),
    };
    event(state, statement, EventKind::Coolant(coolant))
}

/// DELAY.
pub(crate) fn delay(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let number = statement.arguments().iter().find(|token| token.number().is_some());
    let number = number.ok_or_else(|| statement.fault(format!("accepted: {DELAY}")))?;
    let value = statement.number(number, DELAY)?;
    if value < 0.0 {
        return Err(statement.fault_at(number, format!("a wait cannot be negative; accepted: {DELAY}")));
    }
    let dwell = if statement.has("REV") { Dwell::Revolutions(value) } else { Dwell::Seconds(value) };
    event(state, statement, EventKind::Dwell(dwell))
}

/// CUTCOM: the points are the tool's path, whatever the controller adds.
pub(crate) fn compensation(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let on = !statement.has("OFF");
    if on && state.builder.options.compensation == Compensation::Refuse {
        let detail =
            "cutter radius compensation is refused; post the tool's path, or accept it with compensation";
        return Err(statement.fault(detail.to_owned()));
    }
    if on {
        let detail = "cutter radius compensation: the points are taken as the tool's path";
        state.builder.diagnostics.warn(statement.line(), statement.word(), detail);
    }
    event(state, statement, EventKind::Compensation { on })
}
