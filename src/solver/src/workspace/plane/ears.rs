//! Triangulation of a polygon by ear clipping, best ears first.

use super::super::observer::Pace;
use super::super::request::WorkspaceError;
use super::site::Site;

/// Penalties of an ear: a cut between two points at which the sheets meet, a point inside, and a corner that is not
/// convex, whose cut may be another polygon's side.
const MEETING: f64 = 2.0;
const COVERING: f64 = 4.0;
const REFLEX: f64 = 8.0;
/// Penalty of a cut that is already an edge of another triangle: the surface would not be a manifold.
const TAKEN: f64 = 16.0;

/// The triangles, counter-clockwise, by the polygon's own numbers: always two fewer than its points. `taken` says
/// which pairs of points an edge elsewhere joins.
///
/// Each cut changes two ears, and those that its point penalised. So the time is quadratic in the number of points.
pub(super) fn triangulate(
    polygon: &[&Site],
    taken: impl Fn(usize, usize) -> bool,
    pace: &mut Pace<'_>,
) -> Result<Vec<[usize; 3]>, WorkspaceError> {
    let mut triangles = Vec::with_capacity(polygon.len().saturating_sub(2));
    let mut left: Vec<usize> = (0..polygon.len()).collect();
    if left.len() > 3 {
        let outline = Outline { polygon, taken };
        let mut ears = Vec::with_capacity(left.len());
        for i in 0..left.len() {
            ears.push(outline.ear(&left, i, pace)?);
        }
        while left.len() > 3 {
            let i = best(&ears);
            let count = left.len();
            triangles.push([left[(i + count - 1) % count], left[i], left[(i + 1) % count]]);
            let gone = left.remove(i);
            ears.remove(i);
            let count = left.len();
            let beside = [(i + count - 1) % count, i % count];
            for (other, ear) in ears.iter_mut().enumerate() {
                if beside.contains(&other) || ear.covers == Some(gone) {
                    *ear = outline.ear(&left, other, pace)?;
                }
            }
        }
    }
    if let [a, b, c] = left[..] {
        triangles.push([a, b, c]);
    }
    Ok(triangles)
}

/// A corner that may be cut off.
#[derive(Clone, Copy, Debug)]
struct Ear {
    worth: f64,
    /// A point of the polygon that lies inside.
    covers: Option<usize>,
}

/// The first of the best ears.
fn best(ears: &[Ear]) -> usize {
    let first = (0, f64::NEG_INFINITY);
    let better =
        |best: (usize, f64), (i, ear): (usize, &Ear)| if ear.worth > best.1 { (i, ear.worth) } else { best };
    ears.iter().enumerate().fold(first, better).0
}

struct Outline<'a, F> {
    polygon: &'a [&'a Site],
    taken: F,
}

impl<F: Fn(usize, usize) -> bool> Outline<'_, F> {
    /// The score of an ear: its area over the sum of its sides' squares, less its penalties.
    fn ear(&self, left: &[usize], i: usize, pace: &mut Pace<'_>) -> Result<Ear, WorkspaceError> {
        let count = left.len();
        let around = [i + count - 1, i, i + 1].map(|n| left[n % count]);
        let corners = around.map(|n| self.polygon[n].at());
        let taken = if (self.taken)(around[0], around[2]) { TAKEN } else { 0.0 };
        let shape = quality(corners);
        if shape <= 0.0 {
            return Ok(Ear { worth: shape - REFLEX - taken, covers: None });
        }
        let mut covers = None;
        let bounds = bounds(corners);
        for &n in left {
            pace.step()?;
            let at = self.polygon[n].at();
            if in_bounds(bounds, at) && !around.contains(&n) && within(corners, at) {
                covers = Some(n);
                break;
            }
        }
        let meeting = self.polygon[around[0]].pinched() && self.polygon[around[2]].pinched();
        let covering = if covers.is_some() { COVERING } else { 0.0 };
        Ok(Ear { worth: shape - covering - if meeting { MEETING } else { 0.0 } - taken, covers })
    }
}

fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let coordinate = |[x, y]: [f64; 2]| robust::Coord { x, y };
    robust::orient2d(coordinate(a), coordinate(b), coordinate(c))
}

fn quality([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let square = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
    let sides = square(a, b) + square(b, c) + square(c, a);
    if sides > 0.0 { turn(a, b, c) / sides } else { 0.0 }
}

/// Least and greatest coordinates of a triangle.
fn bounds([a, b, c]: [[f64; 2]; 3]) -> [[f64; 2]; 2] {
    [[0, 1].map(|i| a[i].min(b[i]).min(c[i])), [0, 1].map(|i| a[i].max(b[i]).max(c[i]))]
}

fn in_bounds([low, high]: [[f64; 2]; 2], [x, y]: [f64; 2]) -> bool {
    low[0] <= x && x <= high[0] && low[1] <= y && y <= high[1]
}

fn within([a, b, c]: [[f64; 2]; 3], p: [f64; 2]) -> bool {
    turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::cell::Cell;
    use std::f64::consts::TAU;

    use super::super::super::domain::Domain;
    use super::super::super::observer::{Observer, Pace, Unobserved};
    use super::super::super::request::{Kind, Request, WorkspaceError};
    use super::{Site, triangulate};
    use crate::machine::Machine;

    fn round(points: u32) -> Vec<Site> {
        let machine = Machine::verne();
        let request = Request {
            kind: Kind::Platform,
            tool_length: 0.0,
            table_clearance: None,
            tool_radius: 0.0,
            phi1: 0.0,
            phi2: 0.0,
            tolerance: 1.0,
        };
        let domain = Domain::new(&machine, &request, None);
        let at = |n: u32| (TAU * f64::from(n) / f64::from(points)).sin_cos();
        (0..points)
            .map(|n| {
                let (y, x) = at(n);
                // Not convex.
                Site::new(&domain, if n % 7 == 0 { [9.0 * x, 9.0 * y] } else { [10.0 * x, 10.0 * y] })
            })
            .collect()
    }

    /// An ear is scored again where a cut has changed it, not after every cut.
    #[test]
    fn corners_are_looked_at_a_few_times() {
        for points in [4, 50, 400] {
            let sites = round(points);
            let looks = Cell::new(0);
            let taken = |_: usize, _: usize| {
                looks.set(looks.get() + 1);
                false
            };
            let sites: Vec<&Site> = sites.iter().collect();
            let triangles = triangulate(&sites, taken, &mut Pace::new(&Unobserved)).unwrap();
            assert_eq!(triangles.len(), sites.len() - 2);
            assert!(looks.get() <= 5 * points, "{points} points, {} looks", looks.get());
        }
    }

    #[test]
    fn cutting_can_be_stopped() {
        struct Stopped;
        impl Observer for Stopped {
            fn progress(&self, _part: f64) {}

            fn cancelled(&self) -> bool {
                true
            }
        }
        let sites = round(400);
        let sites: Vec<&Site> = sites.iter().collect();
        let stopped = triangulate(&sites, |_, _| false, &mut Pace::new(&Stopped));
        assert_eq!(stopped.err(), Some(WorkspaceError::Cancelled));
    }
}
