//! G2 and G3: arcs, circles and helices.

use nalgebra::Vector2;

use crate::arc::Sweep;
use crate::builder::{Circle, Target};
use crate::error::ProgramError;
use crate::gcode::block::Block;
use crate::gcode::coordinates::{length, length_of};
use crate::gcode::lexer::Word;
use crate::gcode::state::State;
use crate::gcode::vocabulary::{Motion, Plane};
use crate::orientation::unit;

/// A radius may be too small for its chord by so many mm, and by a thousandth.
const MISS: f64 = 0.01;
/// The most turns.
const MOST_TURNS: u32 = 1000;

/// The letters of the centre, in the order of the axes.
const OFFSETS: [u8; 3] = *b"IJK";

impl Plane {
    /// Its two axes in the order in which they turn right-handed about the third.
    fn axes(self) -> [usize; 3] {
        match self {
            Self::Xy => [0, 1, 2],
            Self::Zx => [2, 0, 1],
            Self::Yz => [1, 2, 0],
        }
    }
}

/// Adds the arc to a target whose coordinates in the block's frame are `end`.
pub(crate) fn arc(
    state: &mut State,
    block: &Block<'_>,
    motion: Motion,
    target: Target,
    end: [f64; 3],
) -> Result<(), ProgramError> {
    let Some(start) = state.position.point() else {
        let detail = "the start of the arc is not known; accepted is a move with X, Y and Z before it";
        return Err(block.fault(detail.to_owned()));
    };
    let axes = state.modes.plane.axes();
    let turns = turns(block)?;
    let centre = match block.take(b'R') {
        Some(word) if block.has_any(&OFFSETS) => {
            let detail = "the arc has both R and a centre; accepted is one of them";
            return Err(block.fault_at(word, detail.to_owned()));
        }
        Some(word) => centre_of_radius(state, block, word, motion, start, end)?,
        None => centre(state, block, start)?,
    };
    let mut normal = [0.0; 3];
    normal[axes[2]] = if motion == Motion::CounterClockwise { 1.0 } else { -1.0 };
    let (centre, normal) = match &state.tilt {
        Some(tilt) => (tilt.point_to_program(centre), tilt.direction_to_program(normal)),
        None => (centre, normal),
    };
    let normal = unit(normal).ok_or_else(|| block.fault("the plane of the arc has no normal".to_owned()))?;
    let circle = Circle { centre, normal, sweep: Sweep::ToEnd { turns } };
    state.builder.arc(target, circle).map_err(|detail| block.fault(detail))
}

/// Whole turns before the last one: P is the number of turns.
fn turns(block: &Block<'_>) -> Result<u16, ProgramError> {
    let Some(word) = block.take(b'P') else { return Ok(0) };
    let count = block.count(word)?;
    u16::try_from(count).ok().filter(|count| (1..=MOST_TURNS).contains(&u32::from(*count))).map_or_else(
        || Err(block.fault_at(word, "P of an arc is its number of turns, from 1 to 1000".to_owned())),
        |count| Ok(count - 1),
    )
}

/// The centre that I, J and K state.
fn centre(state: &mut State, block: &Block<'_>, start: [f64; 3]) -> Result<[f64; 3], ProgramError> {
    let axes = state.modes.plane.axes();
    let normal = OFFSETS[axes[2]];
    if let Some(word) = block.take(normal)
        && word.value != 0.0
    {
        let letters = [OFFSETS[axes[0]], OFFSETS[axes[1]]].map(char::from);
        let detail = format!("the centre lies in the plane; accepted are {} and {}", letters[0], letters[1]);
        return Err(block.fault_at(word, detail));
    }
    let mut centre = start;
    let mut found = 0;
    for axis in [axes[0], axes[1]] {
        let offset = length_of(state, block, OFFSETS[axis])?;
        found += usize::from(offset.is_some());
        centre[axis] = match offset {
            Some(offset) if state.modes.centre_absolute => offset,
            Some(offset) => start[axis] + offset,
            None => start[axis],
        };
    }
    let needed = if state.modes.centre_absolute { 2 } else { 1 };
    if found < needed {
        let detail = "the arc has no centre; accepted are I, J, K in its plane (both with G90.1), or R";
        return Err(block.fault(detail.to_owned()));
    }
    Ok(centre)
}

/// The centre of an arc with a radius: a negative one is that of the longer arc.
fn centre_of_radius(
    state: &mut State,
    block: &Block<'_>,
    word: &Word<'_>,
    motion: Motion,
    start: [f64; 3],
    end: [f64; 3],
) -> Result<[f64; 3], ProgramError> {
    let stated = length(state, block, word)?;
    let axes = state.modes.plane.axes();
    let [from, to] = [start, end].map(|point| Vector2::new(point[axes[0]], point[axes[1]]));
    let half = (to - from) / 2.0;
    let radius = stated.abs();
    if half.norm() <= f64::EPSILON * from.norm() {
        let detail =
            "an arc with R needs an end other than its start; accepted are I, J, K for a full circle";
        return Err(block.fault_at(word, detail.to_owned()));
    }
    let square = radius * radius - half.norm_squared();
    if half.norm() - radius > MISS + 1e-3 * radius {
        let detail = format!(
            "the end is {:.6} mm away, more than twice the radius; accepted is a radius of at least {:.6} mm",
            2.0 * half.norm(),
            half.norm()
        );
        return Err(block.fault_at(word, detail));
    }
    let left = Vector2::new(-half.y, half.x) / half.norm() * square.max(0.0).sqrt();
    let centre_is_left = (motion == Motion::CounterClockwise) == (stated > 0.0);
    let centre = from + half + if centre_is_left { left } else { -left };
    let mut point = start;
    point[axes[0]] = centre.x;
    point[axes[1]] = centre.y;
    Ok(point)
}
