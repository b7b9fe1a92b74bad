//! The words that move the tool along straight lines, and those that set its axis.

use nalgebra::Vector3;

use crate::apt::circle;
use crate::apt::hole;
use crate::apt::state::State;
use crate::apt::statement::Statement;
use crate::builder::Target;
use crate::error::ProgramError;
use crate::event::EventKind;
use crate::moves::MoveKind;
use crate::orientation::unit;

const GOTO: &str = "3 or 6 numbers: x,y,z or x,y,z,i,j,k";
const GODLTA: &str = "GODLTA/dx,dy,dz, or GODLTA/d along the tool axis";
const TLAXIS: &str = "TLAXIS/i,j,k";

/// GOTO: a point, the end of an arc, or a hole.
pub(crate) fn goto(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let tip = point(state, statement)?;
    to(state, statement, tip)
}

/// GODLTA: a point relative to the present one.
pub(crate) fn godlta(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let numbers = statement.numbers::<3>(GODLTA)?;
    let millimetres = state.millimetres(statement)?;
    let delta = match *numbers.as_slice() {
        [along] => Vector3::from(state.axis) * along,
        [x, y, z] => Vector3::new(x, y, z),
        _ => return Err(statement.fault(format!("accepted: {GODLTA}"))),
    };
    if state.cycle.is_some() {
        return Err(statement.fault("the holes of a cycle are given by GOTO".to_owned()));
    }
    let tip = state.position(statement)? + delta * millimetres;
    to(state, statement, tip.into())
}

/// FROM: where the tool begins.
pub(crate) fn from(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    if state.builder.move_count() > 0 {
        let detail = "a FROM after the first motion is read as a rapid to its point";
        state.builder.diagnostics.warn(statement.line(), statement.word(), detail);
    }
    let tip = point(state, statement)?;
    rapid(state, statement, tip)
}

/// GOHOME: a rapid to a point, or to a place that the file does not state.
pub(crate) fn go_home(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    if !statement.arguments().is_empty() {
        let tip = point(state, statement)?;
        return rapid(state, statement, tip);
    }
    let detail =
        "the tool goes to a place that the file does not state; the next point is not checked from there";
    state.builder.diagnostics.warn(statement.line(), statement.word(), detail);
    let event = state.builder.event(statement.line(), EventKind::Home, statement.text);
    event.map_err(|detail| statement.fault(detail))
}

/// TLAXIS: the axis of the points that follow.
pub(crate) fn tool_axis(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let numbers = statement.numbers::<3>(TLAXIS)?;
    let &[i, j, k] = numbers.as_slice() else { return Err(statement.fault(format!("accepted: {TLAXIS}"))) };
    state.axis = axis(statement, [i, j, k])?;
    Ok(())
}

/// MULTAX: points have an axis, or with OFF the axis (0, 0, 1).
pub(crate) fn multi_axis(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    match statement.arguments() {
        [] => state.fixed_axis = false,
        [word] if word.is("ON") => state.fixed_axis = false,
        [word] if word.is("OFF") => {
            state.fixed_axis = true;
            state.axis = [0.0, 0.0, 1.0];
        }
        [other, ..] => {
            return Err(statement.fault_at(other, "accepted: MULTAX, MULTAX/ON and MULTAX/OFF".to_owned()));
        }
    }
    Ok(())
}

/// The point of the arguments in mm. Its axis, if it has one, becomes the present axis.
fn point(state: &mut State, statement: &Statement<'_>) -> Result<[f64; 3], ProgramError> {
    let numbers = statement.numbers::<9>(GOTO)?;
    let (tip, direction) = match numbers.as_slice() {
        &[x, y, z] => ([x, y, z], None),
        &[x, y, z, i, j, k] => ([x, y, z], Some([i, j, k])),
        [_, _, _, _, _, _, _, _, _] => {
            let detail =
                format!("cutter-contact points with a surface normal are not read; accepted: {GOTO}");
            return Err(statement.fault(detail));
        }
        other => {
            return Err(statement.fault(format!("the point has {} numbers; accepted: {GOTO}", other.len())));
        }
    };
    if let Some(direction) = direction {
        state.axis = axis(statement, direction)?;
        if state.fixed_axis {
            let detail = "the point has an axis though MULTAX/OFF is in force: the axis is used";
            state.builder.diagnostics.warn(statement.line(), statement.word(), detail);
        }
    }
    let millimetres = state.millimetres(statement)?;
    Ok(tip.map(|value| value * millimetres))
}

fn axis(statement: &Statement<'_>, direction: [f64; 3]) -> Result<[f64; 3], ProgramError> {
    unit(direction).ok_or_else(|| {
        statement.fault("the axis is (0, 0, 0); accepted is a vector from the tip to the holder".to_owned())
    })
}

fn to(state: &mut State, statement: &Statement<'_>, tip: [f64; 3]) -> Result<(), ProgramError> {
    if let Some(cycle) = state.cycle {
        return hole::drill(state, statement, cycle, tip);
    }
    if let Some(arc) = state.arc.take() {
        return circle::end(state, statement, arc, tip);
    }
    let target = state.target(statement, tip);
    state.builder.line(target).map_err(|detail| statement.fault(detail))
}

fn rapid(state: &mut State, statement: &Statement<'_>, tip: [f64; 3]) -> Result<(), ProgramError> {
    state.rapid = true;
    let target = Target { kind: MoveKind::Rapid, ..state.target(statement, tip) };
    state.builder.line(target).map_err(|detail| statement.fault(detail))
}
