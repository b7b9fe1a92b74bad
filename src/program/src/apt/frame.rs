//! Units and coordinate systems.

use crate::apt::state::State;
use crate::apt::statement::Statement;
use crate::error::ProgramError;
use crate::event::EventKind;
use crate::options::Units;

const UNITS: &str = "UNITS/MM or UNITS/INCHES";
const CSYS: &str = "CSYS with twelve numbers: three rows of rotation and shift";
const MSYS: &str = "MSYS with nine numbers: origin, x axis, y axis";
/// The CSYS that changes nothing.
const IDENTITY: [f64; 12] = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
/// Elements of a matrix that differ by less than this are equal.
const SAME: f64 = 1e-9;

/// UNITS or UNIT: the unit of lengths from here on.
pub(crate) fn units(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let units = match statement.arguments() {
        [word] => match word.text {
            "MM" | "MILLIMETER" | "MILLIMETERS" => Some(Units::Millimetres),
            "INCH" | "INCHES" | "IN" => Some(Units::Inches),
            _ => None,
        },
        _ => None,
    };
    let units = units.ok_or_else(|| statement.fault(format!("the unit is not known; accepted: {UNITS}")))?;
    if state.units.is_some_and(|present| present != units) && state.builder.move_count() > 0 {
        let detail = "the unit changes after the first motion";
        state.builder.diagnostics.warn(statement.line(), statement.word(), detail);
    } else {
        state.builder.set_units(units);
    }
    state.units = Some(units);
    Ok(())
}

/// CSYS: a coordinate system. Points are in it unless TRNTYP/WORLD is in force.
pub(crate) fn coordinate_system(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let numbers = statement.numbers::<12>(CSYS)?;
    if numbers.len() != 12 {
        return Err(statement.fault(format!("accepted: {CSYS}")));
    }
    let is_identity = numbers.iter().zip(IDENTITY).all(|(value, expected)| (value - expected).abs() <= SAME);
    let detail = "the points are in a coordinate system of their own; post them in world coordinates \
                  (TRNTYP/WORLD) or with a CSYS that is the identity";
    state.frames.local = (!is_identity).then(|| statement.fault(detail.to_owned()));
    event(state, statement)
}

/// TRNTYP: whether points are in world coordinates.
pub(crate) fn transformation_type(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    state.frames.world = statement.has("WORLD");
    event(state, statement)
}

/// MSYS of NX: the system in which the points are. All paths of a file must have the same.
pub(crate) fn machine_system(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let numbers = statement.numbers::<9>(MSYS)?;
    let system: [f64; 9] =
        numbers.as_slice().try_into().map_err(|_| statement.fault(format!("accepted: {MSYS}")))?;
    if let Some(present) = state.frames.machine.replace(system)
        && present.iter().zip(system).any(|(a, b)| (a - b).abs() > SAME)
        && state.builder.move_count() > 0
    {
        let detail = "the points that follow are in another coordinate system than those before; post one system per \
                      file";
        return Err(statement.fault(detail.to_owned()));
    }
    event(state, statement)
}

/// ORIGIN and TRANS: accepted if they shift nothing.
pub(crate) fn shift(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    if let Some(token) = statement.arguments().iter().find(|token| token.number() != Some(0.0)) {
        let detail = "the word shifts the points that follow; post them in one system, and shift with setup";
        return Err(statement.fault_at(token, detail.to_owned()));
    }
    event(state, statement)
}

/// The fault of a motion in a coordinate system of its own.
pub(crate) fn check(state: &mut State) -> Result<(), ProgramError> {
    if state.frames.world {
        return Ok(());
    }
    // Once is enough.
    state.frames.local.take().map_or(Ok(()), Err)
}

fn event(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let added = state.builder.event(statement.line(), EventKind::Frame, statement.text);
    added.map_err(|detail| statement.fault(detail))
}
