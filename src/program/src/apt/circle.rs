//! CIRCLE and MOVARC: the arc from the present point to the next point.

use std::f64::consts::TAU;

use arrayvec::ArrayVec;

use crate::apt::state::{PendingArc, State};
use crate::apt::statement::Statement;
use crate::arc::{Polar, Sweep};
use crate::builder::Circle;
use crate::error::ProgramError;
use crate::orientation::unit;

const CIRCLE: &str = "CIRCLE/x,y,z,i,j,k with an optional radius, and TIMES,n";
const MOVARC: &str = "MOVARC/x,y,z,i,j,k,radius,ANGLE,degrees";
/// Further points of a circle lie on it within this distance in mm, and 1e-5 of the radius.
const ON_CIRCLE: f64 = 1e-3;

/// CIRCLE: centre and normal. NX adds radius, tolerances and diameters.
pub(crate) fn circle(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    // Creo writes blanks around the slash, and its header may be missing.
    state.creo |= statement.text.as_bytes().get("CIRCLE".len()) == Some(&b' ');
    let (numbers, words) = leading_numbers(statement, CIRCLE)?;
    let turns = match words {
        [] => 0,
        [times, count] if times.is("TIMES") => {
            let count = statement.count(count)?;
            let turns = u16::try_from(count).ok().filter(|turns| (1..=1000).contains(turns));
            let turns =
                turns.ok_or_else(|| statement.fault("TIMES needs a number from 1 to 1000".to_owned()))?;
            turns - 1
        }
        [other, ..] => return Err(statement.fault_at(other, format!("accepted: {CIRCLE}"))),
    };
    begin(state, statement, &numbers, Sweep::ToEnd { turns }, CIRCLE)
}

/// MOVARC: centre, normal, radius and angle.
pub(crate) fn move_arc(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let (numbers, words) = leading_numbers(statement, MOVARC)?;
    let [angle, degrees] = words else { return Err(statement.fault(format!("accepted: {MOVARC}"))) };
    if !angle.is("ANGLE") {
        return Err(statement.fault_at(angle, format!("accepted: {MOVARC}")));
    }
    let degrees = statement.number(degrees, MOVARC)?;
    if degrees <= 0.0 {
        return Err(statement.fault("the angle must be positive; the normal gives the sense".to_owned()));
    }
    begin(state, statement, &numbers, Sweep::About(degrees.to_radians()), MOVARC)
}

/// The point that ends the arc. Another point may follow on a circle of Creo.
pub(crate) fn end(
    state: &mut State,
    statement: &Statement<'_>,
    arc: PendingArc,
    tip: [f64; 3],
) -> Result<(), ProgramError> {
    let start = state.position(statement)?;
    let from = Polar::of(start.into(), arc.centre, arc.normal);
    let to = Polar::of(tip, arc.centre, arc.normal);
    if let Some(swept) = arc.swept {
        let near = ON_CIRCLE + 1e-5 * from.radius;
        let turned = swept + from.angle_to(&to, arc.normal);
        let on_circle = (to.radius - from.radius).abs() <= near && (to.height - from.height).abs() <= near;
        if !on_circle || turned > TAU + near / from.radius {
            let target = state.target(statement, tip);
            return state.builder.line(target).map_err(|detail| statement.fault(detail));
        }
    }
    if let Some(radius) = arc.radius
        && (radius - from.radius).abs() > 0.01 + 1e-3 * radius
    {
        let detail = format!(
            "the present point is {:.6} mm from the axis of the circle, not {radius:.6} mm as stated",
            from.radius
        );
        return Err(statement.fault(detail));
    }
    let target = state.target(statement, tip);
    let circle = Circle { centre: arc.centre, normal: arc.normal, sweep: arc.sweep };
    state.builder.arc(target, circle).map_err(|detail| statement.fault(detail))?;
    if state.creo && matches!(arc.sweep, Sweep::ToEnd { turns: 0 }) {
        let swept = Some(arc.swept.unwrap_or(0.0) + from.angle_to(&to, arc.normal));
        state.arc = Some(PendingArc { swept, ..arc });
    }
    Ok(())
}

fn begin(
    state: &mut State,
    statement: &Statement<'_>,
    numbers: &[f64],
    sweep: Sweep,
    accepted: &str,
) -> Result<(), ProgramError> {
    let &[x, y, z, i, j, k, ref rest @ ..] = numbers else {
        return Err(statement.fault(format!("centre and normal need six numbers; accepted: {accepted}")));
    };
    if state.arc.is_some_and(|arc| arc.swept.is_none()) {
        return Err(
            statement.fault("the circle before has no end; write a GOTO after each circle".to_owned())
        );
    }
    if state.cycle.is_some() {
        return Err(statement.fault("a cycle cannot contain a circle; write CYCLE/OFF before it".to_owned()));
    }
    let millimetres = state.millimetres(statement)?;
    let normal = unit([i, j, k]);
    let normal = normal.ok_or_else(|| statement.fault("the normal of the circle is (0, 0, 0)".to_owned()))?;
    let radius = rest.first().map(|radius| radius * millimetres);
    let centre = [x, y, z].map(|value| value * millimetres);
    state.arc = Some(PendingArc { centre, normal, sweep, radius, swept: None });
    Ok(())
}

/// The arguments up to the first word, and the others.
fn leading_numbers<'s, 'a>(
    statement: &'s Statement<'a>,
    accepted: &str,
) -> Result<(ArrayVec<f64, 12>, &'s [crate::apt::lexer::Token<'a>]), ProgramError> {
    let arguments = statement.arguments();
    let count = arguments.iter().take_while(|token| token.number().is_some()).count();
    let mut numbers = ArrayVec::new();
    for token in &arguments[..count] {
        let value = statement.number(token, accepted)?;
        if numbers.try_push(value).is_err() {
            return Err(statement.fault(format!("there are too many numbers; accepted: {accepted}")));
        }
    }
    Ok((numbers, &arguments[count..]))
}
