//! The box around the region of origins.

use rayon::prelude::*;

use super::constraining::constraining_places;
use super::cut_windings::Windings;
use super::membership::Membership;
use crate::machine::Machine;
use crate::pose::Point;
use crate::toolpath::PlanError;
use crate::toolpath::placement::interior_set_ups;
use crate::toolpath::planned_places::PlannedPlaces;
use crate::toolpath::set_up::SetUp;
use crate::workspace::dexterity::Grid;
use crate::workspace::observer::check_cancelled;
use crate::workspace::{Observer, WorkspaceError};

/// Half of the box at first, mm.
const FIRST: f64 = 16.0;
/// Fraction of the box's width by which a side moves out while an origin on it is inside.
const GROWTH: f64 = 0.25;
/// Greatest number of moves.
const MOVES: u32 = 200;
/// Number of intervals of a side in each direction between the origins that are examined.
const INTERVALS: u32 = 24;
/// Fraction of the box's width that is added on each side.
const ROOM: f64 = 0.02;

/// What takes long in a survey. Other parts of the same computation can begin with it.
#[derive(Clone, Debug, PartialEq)]
pub struct OriginExtent {
    /// Indices of the places that limit the region, ascending.
    pub places: Vec<u32>,
    /// The box around the region; `None` if no origin was found in it.
    pub bounds: Option<[[f64; 3]; 2]>,
}

/// The places that limit the region, and the box around it.
pub(super) fn extent(
    machine: &Machine,
    places: &PlannedPlaces,
    windings: &[Windings],
    observer: &dyn Observer,
) -> Result<OriginExtent, WorkspaceError> {
    let bounds = reach(machine, places);
    let interior = interior_set_ups(machine, places, bounds, observer).map_err(|error| match error {
        PlanError::Cancelled => WorkspaceError::Cancelled,
        PlanError::TooManyRows => WorkspaceError::TooFine,
    })?;
    let interior: Vec<(Point, bool)> =
        interior.iter().map(|found| (found.set_up.origin, found.other)).collect();
    let set = constraining_places(machine, places, windings, &interior, observer)?;
    let membership = Membership::new(machine, places, &set, windings);
    let mut around: Option<[Point; 2]> = None;
    for (origin, _) in interior {
        if !membership.contains(origin, &mut 0) {
            continue;
        }
        let first = [origin.map(|c| c - FIRST), origin.map(|c| c + FIRST)];
        let mut found = around.map_or(first, |known| hull(known, first));
        for _ in 0..MOVES {
            check_cancelled(observer)?;
            let Some(wider) = widened(&membership, found) else { break };
            found = wider;
        }
        around = Some(found);
    }
    Ok(OriginExtent { places: set, bounds: around })
}

fn hull([a, b]: [Point; 2], [c, d]: [Point; 2]) -> [Point; 2] {
    [std::array::from_fn(|i| a[i].min(c[i])), std::array::from_fn(|i| b[i].max(d[i]))]
}

/// The box with those sides moved out on which an origin is inside; `None` if there is none.
fn widened(membership: &Membership<'_>, [low, high]: [Point; 2]) -> Option<[Point; 2]> {
    let sides: Vec<(usize, bool)> = (0..3).flat_map(|axis| [(axis, false), (axis, true)]).collect();
    let touched: Vec<bool> = sides
        .par_iter()
        .map(|&(axis, is_high)| {
            let others = [(axis + 1) % 3, (axis + 2) % 3];
            let mut hint = 0;
            let mut at: Point = low;
            at[axis] = if is_high { high[axis] } else { low[axis] };
            for i in 0..=INTERVALS {
                for j in 0..=INTERVALS {
                    for (other, step) in others.into_iter().zip([i, j]) {
                        let part = f64::from(step) / f64::from(INTERVALS);
                        at[other] = low[other] + part * (high[other] - low[other]);
                    }
                    if membership.contains(at, &mut hint) {
                        return true;
                    }
                }
            }
            false
        })
        .collect();
    let mut found = [low, high];
    for ((axis, is_high), touched) in sides.into_iter().zip(&touched) {
        if *touched {
            let step = GROWTH * (high[axis] - low[axis]);
            found[usize::from(is_high)][axis] += if is_high { step } else { -step };
        }
    }
    touched.contains(&true).then_some(found)
}

/// Bounds of the origins that the machine could reach with the middle of the program: no rod is longer than it is, and
/// no slider leaves its stroke.
fn reach(machine: &Machine, places: &PlannedPlaces) -> [[f64; 2]; SetUp::PARAMETERS] {
    let (g, table, given) = (machine.geometry(), machine.table(), places.set_up);
    let adjusted = places.places.iter().filter(|place| place.is_adjusted);
    let none = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    let [low, high] = adjusted.fold(none, |ends, place| hull(ends, [place.tip; 2]));
    let longest = g.L1.max(g.L2).max(g.L3);
    let strokes = machine.limits().stroke;
    let top = strokes.iter().map(|stroke| stroke[0]).fold(f64::INFINITY, f64::min);
    let bottom = strokes.iter().map(|stroke| stroke[1]).fold(f64::NEG_INFINITY, f64::max) + longest;
    let tool = places.places.iter().map(|place| place.tool_length).fold(0.0, f64::max);
    let across = longest + tool;
    // Above the table, less what tilting moves.
    let heights = [table.da + table.dt - bottom - across, table.da + table.dt - top + across];
    let mut bounds = given.parameters().map(|fixed| [fixed; 2]);
    for axis in 0..3 {
        let from = given.origin[axis] - 0.5 * (low[axis] + high[axis]);
        let [least, greatest] = if axis == 2 { heights } else { [-across, across] };
        if from.is_finite() {
            bounds[axis] = [from + least, from + greatest];
        }
    }
    bounds
}

/// A grid over the box with at least one layer beyond it.
pub(super) fn grid(bounds: Option<[Point; 2]>, step: f64) -> Result<Grid, WorkspaceError> {
    let Some([low, high]) = bounds else {
        return Ok(Grid::empty(step, 0.0));
    };
    let room = [0, 1, 2].map(|axis| ROOM * (high[axis] - low[axis]));
    Grid::over([low, high], room, step, 0.0)
}
