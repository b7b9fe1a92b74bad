//! Points in the interior of a face, far from its sides.

use super::arc_node::distance_to_segment;
use super::arrangement::Faces;

/// A point in the interior, in grid steps from the window's corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interior {
    pub(super) at: [f64; 2],
    /// Its distance from the nearest side.
    pub(super) clearance: f64,
}

/// Lines across a face, along u and along v.
const LINES: u32 = 12;
/// Steps of the search for a better place.
const STEPS: usize = 24;

/// Up to `most` points, the one with the greatest clearance first, none with less than `least`.
pub(super) fn interior(faces: &Faces, face: usize, most: usize, least: f64) -> Vec<Interior> {
    #[expect(clippy::cast_precision_loss, reason = "grid points have at most 34 bits")]
    let number = |point: [i64; 2]| point.map(|coordinate| coordinate as f64);
    let (outer, holes) = &faces.rings[face];
    let half_edges = outer.half_edges.iter().chain(holes.iter().flat_map(|hole| &hole.half_edges));
    let sides: Vec<[[f64; 2]; 2]> = half_edges.map(|half_edge| faces.ends(*half_edge).map(number)).collect();
    let clearance =
        |at: [f64; 2]| sides.iter().map(|side| distance_to_segment(at, *side)).fold(f64::INFINITY, f64::min);
    let mut found: Vec<Interior> = Vec::new();
    for axis in 0..2 {
        let ends = || sides.iter().map(|side| side[0][axis]);
        let (low, high) = (ends().fold(f64::INFINITY, f64::min), ends().fold(f64::NEG_INFINITY, f64::max));
        for line in 0..LINES {
            // Not in the middle, where symmetric machines have curves.
            let at = low + (high - low) * (f64::from(line) + 0.4871) / f64::from(LINES);
            let Some(middle) = widest_middle(&sides, axis, at) else { continue };
            let at = if axis == 0 { [at, middle] } else { [middle, at] };
            found.push(Interior { at, clearance: clearance(at) });
        }
    }
    found.sort_by(|a, b| b.clearance.total_cmp(&a.clearance));
    if let Some(best) = found.first_mut() {
        *best = improved(*best, &sides, &clearance);
    }
    found.retain(|place| place.clearance > least);
    found.truncate(most);
    found
}

/// The middle of the widest interval in which the line `axis` = `at` is inside.
fn widest_middle(sides: &[[[f64; 2]; 2]], axis: usize, at: f64) -> Option<f64> {
    let mut crossings: Vec<f64> = sides
        .iter()
        .filter(|[a, b]| (a[axis] <= at) != (b[axis] <= at))
        .map(|[a, b]| {
            let other = 1 - axis;
            a[other] + (b[other] - a[other]) * (at - a[axis]) / (b[axis] - a[axis])
        })
        .collect();
    crossings.sort_by(f64::total_cmp);
    let widest = crossings.chunks_exact(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
    Some(0.5 * (widest[0] + widest[1]))
}

/// A point near another with more clearance, by a pattern search.
fn improved(start: Interior, sides: &[[[f64; 2]; 2]], clearance: &impl Fn([f64; 2]) -> f64) -> Interior {
    let (mut best, mut step) = (start, start.clearance);
    for _ in 0..STEPS {
        let tries = [[step, 0.0], [-step, 0.0], [0.0, step], [0.0, -step]];
        let better = tries.into_iter().find_map(|shift| {
            let at = [best.at[0] + shift[0], best.at[1] + shift[1]];
            let found = Interior { at, clearance: clearance(at) };
            (found.clearance > best.clearance && is_inside(sides, at)).then_some(found)
        });
        match better {
            Some(found) => best = found,
            None => step *= 0.5,
        }
    }
    best
}

fn is_inside(sides: &[[[f64; 2]; 2]], at: [f64; 2]) -> bool {
    let crosses = |[a, b]: &&[[f64; 2]; 2]| {
        (a[1] <= at[1]) != (b[1] <= at[1]) && at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1])
    };
    sides.iter().filter(crosses).count() % 2 == 1
}
