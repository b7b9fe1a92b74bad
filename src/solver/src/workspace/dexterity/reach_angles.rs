//! The angles psi, at one radius, at which part points are reachable, and at which they are dexterous.
//!
//! psi = beta - theta1 and phi1 = alpha - theta1. If the part's map does not fold, alpha - beta falls along an arc. A
//! position beta then allows phi1 from `from` to `to` and theta1 within its range exactly for psi from max(beta -
//! tilt_max, beta - alpha + from) to min(beta - tilt_min, beta - alpha + to). All these rise with beta, so over an
//! interval of beta the psi form one interval. A point at psi has all of phi1 on the arc if it has both its ends:
//! `to` at the lesser beta, where theta1 is least, and `from` at the greater.
//!
//! The phi1 that an interval of beta allows at a psi are themselves one interval. Some of them keep the table's plane
//! if the one with the least depth does, and all of them if the one with the greatest depth does.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::arc::{Arc, Circle, arcs, segments};
use super::floor::Floor;
use super::inclination::turns;
use super::monotone_piece::MonotonePiece;
use super::section::ToolWorkspace;
use crate::workspace::feasible_intervals::{LimitFunctions, intervals};

/// The total angles, rad, of reachable and of dexterous points.
pub(super) fn reach_angles(
    tool: &ToolWorkspace<'_>,
    section: &[MonotonePiece],
    radius: f64,
    phi1: [f64; 2],
) -> [f64; 2] {
    let (mut some, mut all) = (Vec::new(), Vec::new());
    for arc in arcs(tool, section, radius) {
        for tilt in tilts(tool, phi1) {
            reachable(&arc, phi1, tilt, &mut some);
            dexterous(&arc, phi1, tilt, &mut all);
        }
    }
    [united(&some), united(&all)]
}

/// The tilting range, shifted by whole turns to where alpha - phi1 may lie.
fn tilts(tool: &ToolWorkspace<'_>, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    let Some([middle, half]) = tool.tilt else { return vec![[f64::NEG_INFINITY, f64::INFINITY]] };
    let (least, greatest) = (-FRAC_PI_2 - to, FRAC_PI_2 - from);
    turns(least - middle - half, greatest - middle + half)
        .map(|turn| [middle + turn - half, middle + turn + half])
        .collect()
}

fn reachable(arc: &Arc<'_>, [from, to]: [f64; 2], [low, high]: [f64; 2], found: &mut Vec<[f64; 2]>) {
    let lead = |beta: f64| beta - arc.circle.alpha(beta);
    for [start, end] in inclined(arc.circle, arc.ends, [low + from, high + to]) {
        let psi = [f64::max(start - high, lead(start) + from), f64::min(end - low, lead(end) + to)];
        let Some(floor) = &arc.circle.tool.floor else {
            found.push(psi);
            continue;
        };
        if psi[0] < psi[1] {
            let inclinations = |psi: f64| {
                [
                    f64::max(from, psi - lead(end.min(psi + high))),
                    f64::min(to, psi - lead(start.max(psi + low))),
                ]
            };
            let height = HeightOverTable { floor, radius: arc.circle.radius, inclinations };
            found
                .extend(intervals(&height, psi, segments(psi)).into_iter().map(|cuts| cuts.map(|cut| cut.t)));
        }
    }
}

fn dexterous(arc: &Arc<'_>, [from, to]: [f64; 2], [low, high]: [f64; 2], found: &mut Vec<[f64; 2]>) {
    let lead = |beta: f64| beta - arc.circle.alpha(beta);
    // A whole circle is taken twice: the two ends may lie on both sides of the cut.
    let ends = if arc.closed() { [-PI, 3.0 * PI] } else { arc.ends };
    let last_positions = inclined(arc.circle, ends, [f64::NEG_INFINITY, high + from]);
    for [a, b] in inclined(arc.circle, ends, [low + to, f64::INFINITY]) {
        let first = [lead(a) + to, lead(b) + to];
        for [a, b] in &last_positions {
            let both = [first[0].max(lead(*a) + from), first[1].min(lead(*b) + from)];
            match &arc.circle.tool.floor {
                _ if both[0] >= both[1] => {}
                Some(floor) => floor.overlap(arc.circle.radius, [from, to], both, found),
                None => found.push(both),
            }
        }
    }
}

/// The portions of an interval of beta on which alpha is within a range.
fn inclined(circle: Circle<'_>, ends: [f64; 2], [least, greatest]: [f64; 2]) -> Vec<[f64; 2]> {
    let [low, high] = circle.piece.alphas;
    if least <= low && high <= greatest {
        return vec![ends];
    }
    let limits = Inclination { circle, least, greatest };
    intervals(&limits, ends, segments(ends)).into_iter().map(|cuts| cuts.map(|cut| cut.t)).collect()
}

/// The margin of the table's plane at a psi for the best phi1 that is possible there, mm.
struct HeightOverTable<'a, F> {
    floor: &'a Floor<'a>,
    radius: f64,
    inclinations: F,
}

impl<F: Fn(f64) -> [f64; 2]> LimitFunctions<1> for HeightOverTable<'_, F> {
    fn values(&self, psi: f64) -> [f64; 1] {
        [self.value(0, psi)]
    }

    fn value(&self, _: usize, psi: f64) -> f64 {
        self.floor.height(self.radius, psi) - self.floor.lowest((self.inclinations)(psi))
    }
}

struct Inclination<'a> {
    circle: Circle<'a>,
    least: f64,
    greatest: f64,
}

impl LimitFunctions<2> for Inclination<'_> {
    fn values(&self, beta: f64) -> [f64; 2] {
        let alpha = self.circle.alpha(beta);
        [(alpha - self.least).min(PI), (self.greatest - alpha).min(PI)]
    }

    fn value(&self, limit: usize, beta: f64) -> f64 {
        self.values(beta)[limit]
    }
}

/// The angle of the circle that intervals cover together.
fn united(intervals: &[[f64; 2]]) -> f64 {
    let mut arcs: Vec<[f64; 2]> = Vec::with_capacity(intervals.len() + 1);
    for &[from, to] in intervals {
        if to - from >= TAU {
            return TAU;
        }
        if from < to {
            let start = from.rem_euclid(TAU);
            let end = start + (to - from);
            arcs.push([start, end.min(TAU)]);
            if end > TAU {
                arcs.push([0.0, end - TAU]);
            }
        }
    }
    arcs.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut covered, mut reached) = (0.0, 0.0);
    for [from, to] in arcs {
        if to > reached {
            covered += to - f64::max(from, reached);
            reached = to;
        }
    }
    covered
}
