//! TLON: along a circle up to its intersection with a line, as CATIA and Creo write arcs.
//!
//! ```text
//! INDIRV/ tangent at the start
//! TLON,GOFWD/ (CIRCLE/ x,y,z,r),ON,(LINE/ x1,y1,z1, x2,y2,z2)
//! TLON,GOFWD/ (CIRCLE/ x,y,z,r),ON,2,INTOF,(LINE/ x1,y1,z1, x2,y2,z2)
//! ```

use nalgebra::Vector3;

use crate::apt::lexer::Token;
use crate::apt::state::State;
use crate::apt::statement::Statement;
use crate::arc::{Polar, Sweep};
use crate::builder::Circle;
use crate::error::ProgramError;
use crate::orientation::unit;

const TLON: &str = "TLON,GOFWD/(CIRCLE/x,y,z,r),ON,(LINE/x1,y1,z1,x2,y2,z2), with 2,INTOF, after ON for the second \
                    intersection";
const INDIRV: &str = "INDIRV/i,j,k";
const PSIS: &str = "PSIS/(PLANE/i,j,k,d)";

/// INDIRV: the direction at the start of the arc.
pub(crate) fn direction(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let numbers = statement.numbers::<3>(INDIRV)?;
    let direction = <[f64; 3]>::try_from(numbers.as_slice()).ok().and_then(unit);
    state.guides.direction =
        Some(direction.ok_or_else(|| statement.fault(format!("no direction; accepted: {INDIRV}")))?);
    Ok(())
}

/// PSIS: the plane of the arc.
pub(crate) fn part_surface(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    let mut cursor = Cursor { statement, rest: statement.arguments(), accepted: PSIS };
    let [i, j, k, _] = cursor.geometry("PLANE")?;
    let plane = unit([i, j, k]);
    state.guides.plane = Some(plane.ok_or_else(|| statement.fault(format!("no plane; accepted: {PSIS}")))?);
    Ok(())
}

/// TLON: the arc.
pub(crate) fn tool_on(state: &mut State, statement: &Statement<'_>) -> Result<(), ProgramError> {
    if statement.head().get(1).is_none_or(|token| !token.is("GOFWD")) {
        return Err(statement.fault(format!("accepted: {TLON}")));
    }
    let mut cursor = Cursor { statement, rest: statement.arguments(), accepted: TLON };
    let millimetres = state.millimetres(statement)?;
    let [x, y, z, radius] = cursor.geometry("CIRCLE")?.map(|value| value * millimetres);
    cursor.expect("ON")?;
    let intersection = cursor.intersection()?;
    let line = cursor.geometry::<6>("LINE")?.map(|value| value * millimetres);
    if !cursor.rest.is_empty() {
        return Err(statement.fault(format!("accepted: {TLON}")));
    }
    let start = state.position(statement)?;
    let normal = sense(state, statement, start, [x, y, z])?;
    let arc = ExitArc { start: start.into(), centre: [x, y, z], normal, radius };
    let end = arc.end(line, intersection).map_err(|detail| statement.fault(detail))?;
    let target = state.target(statement, end);
    let circle = Circle { centre: arc.centre, normal, sweep: Sweep::ToEnd { turns: 0 } };
    state.builder.arc(target, circle).map_err(|detail| statement.fault(detail))
}

/// The normal about which the arc is right-handed.
fn sense(
    state: &mut State,
    statement: &Statement<'_>,
    start: Vector3<f64>,
    centre: [f64; 3],
) -> Result<[f64; 3], ProgramError> {
    let direction = state.guides.direction.take();
    let direction = direction
        .ok_or_else(|| statement.fault(format!("the direction is missing; write {INDIRV} before it")))?;
    let normal = Vector3::from(state.guides.plane.unwrap_or(state.axis));
    let tangent = normal.cross(&(start - Vector3::from(centre)));
    let along = tangent.dot(&Vector3::from(direction));
    // The tangent is as long as the radius. CATIA's directions have five decimals.
    if along.abs() < 0.1 * tangent.norm() || tangent.norm() == 0.0 {
        return Err(statement.fault("INDIRV does not point along the circle".to_owned()));
    }
    Ok(if along < 0.0 { (-normal).add_scalar(0.0).into() } else { normal.into() })
}

/// An arc whose end is on a line.
struct ExitArc {
    start: [f64; 3],
    centre: [f64; 3],
    normal: [f64; 3],
    radius: f64,
}

impl ExitArc {
    /// The end: the second point of the line if it lies on the circle, else the intersection of this number.
    fn end(&self, line: [f64; 6], intersection: usize) -> Result<[f64; 3], String> {
        let [x1, y1, z1, x2, y2, z2] = line;
        let (centre, normal) = (Vector3::from(self.centre), Vector3::from(self.normal));
        let from = Polar::of(self.start, self.centre, self.normal);
        let near = 0.01 + 1e-3 * self.radius;
        if (from.radius - self.radius).abs() > near {
            return Err(format!(
                "the present point is {:.6} mm from the axis of the circle, not {:.6} mm as stated",
                from.radius, self.radius
            ));
        }
        let in_plane = |x, y, z| {
            let from_centre = Vector3::new(x, y, z) - centre;
            from_centre - normal * from_centre.dot(&normal)
        };
        let (first, second) = (in_plane(x1, y1, z1), in_plane(x2, y2, z2));
        let along = second - first;
        // |first + s along| = radius
        let (a, half_b, c) =
            (along.norm_squared(), first.dot(&along), first.norm_squared() - self.radius * self.radius);
        let discriminant = half_b * half_b - a * c;
        if a == 0.0 || discriminant < 0.0 {
            return Err("the line does not meet the circle".to_owned());
        }
        let ends = [-1.0, 1.0].map(|sign| {
            let s = (-half_b + sign * discriminant.sqrt()) / a;
            let end: [f64; 3] = (centre + first + along * s + normal * from.height).into();
            end
        });
        let [before, after] = ends;
        if (second.norm() - self.radius).abs() <= near {
            let distance =
                |end: [f64; 3]| (Vector3::from(end) - centre - normal * from.height - second).norm();
            return Ok(if distance(after) <= distance(before) { after } else { before });
        }
        let turn = |end| from.angle_to(&Polar::of(end, self.centre, self.normal), self.normal);
        let (near_end, far_end) = if turn(before) <= turn(after) { (before, after) } else { (after, before) };
        Ok(if intersection == 1 { near_end } else { far_end })
    }
}

/// Reads the arguments one after another.
struct Cursor<'s, 'a> {
    statement: &'s Statement<'a>,
    rest: &'s [Token<'a>],
    accepted: &'static str,
}

impl<'s, 'a> Cursor<'s, 'a> {
    fn next(&mut self) -> Result<&'s Token<'a>, ProgramError> {
        let missing =
            || self.statement.fault(format!("the statement ends too early; accepted: {}", self.accepted));
        let (token, rest) = self.rest.split_first().ok_or_else(missing)?;
        self.rest = rest;
        Ok(token)
    }

    fn expect(&mut self, text: &str) -> Result<(), ProgramError> {
        let token = self.next()?;
        if token.is(text) {
            return Ok(());
        }
        Err(self.statement.fault_at(token, format!("{text} is expected here; accepted: {}", self.accepted)))
    }

    /// `(WORD/ numbers)`.
    fn geometry<const N: usize>(&mut self, word: &str) -> Result<[f64; N], ProgramError> {
        self.expect("(")?;
        self.expect(word)?;
        self.expect("/")?;
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            let token = self.next()?;
            *number = self.statement.number(token, self.accepted)?;
        }
        self.expect(")")?;
        Ok(numbers)
    }

    /// `n,INTOF`, which may be missing.
    fn intersection(&mut self) -> Result<usize, ProgramError> {
        let Some(number) = self.rest.first().and_then(Token::number) else { return Ok(1) };
        let token = self.next()?;
        self.expect("INTOF")?;
        match number {
            1.0 => Ok(1),
            2.0 => Ok(2),
            _ => Err(self.statement.fault_at(token, "a circle and a line have two intersections".to_owned())),
        }
    }
}
