//! Triangulation of a polygon by ear clipping, best ears first.

use super::sample::Sample;
use crate::workspace::observer::StepCounter;
use crate::workspace::request::WorkspaceError;

/// Penalties of an ear: a cut between two points at which the sheets meet, a point inside, and a corner that is not
/// convex, whose cut may be another polygon's side.
const PINCHED: f64 = 2.0;
const COVERING: f64 = 4.0;
const REFLEX: f64 = 8.0;
/// Penalty of a cut that is already an edge of another triangle: the surface would not be a manifold.
const EDGE: f64 = 16.0;

/// The triangles, counter-clockwise, by the polygon's own numbers: always two fewer than its points. `is_edge` tells
/// whether an edge elsewhere joins two points.
///
/// Each cut changes two ears, and those that its point penalised. So the time is quadratic in the number of points.
pub(super) fn triangulate(
    polygon: &[&Sample],
    is_edge: impl Fn(usize, usize) -> bool,
    steps: &mut StepCounter<'_>,
) -> Result<Vec<[usize; 3]>, WorkspaceError> {
    let mut triangles = Vec::with_capacity(polygon.len().saturating_sub(2));
    let mut left: Vec<usize> = (0..polygon.len()).collect();
    if left.len() > 3 {
        let outline = Outline { polygon, is_edge };
        let mut ears = Vec::with_capacity(left.len());
        for i in 0..left.len() {
            ears.push(outline.ear(&left, i, steps)?);
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
                    *ear = outline.ear(&left, other, steps)?;
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
    score: f64,
    /// A point of the polygon that lies inside.
    covers: Option<usize>,
}

/// The first of the best ears.
fn best(ears: &[Ear]) -> usize {
    let first = (0, f64::NEG_INFINITY);
    let better =
        |best: (usize, f64), (i, ear): (usize, &Ear)| if ear.score > best.1 { (i, ear.score) } else { best };
    ears.iter().enumerate().fold(first, better).0
}

struct Outline<'a, F> {
    polygon: &'a [&'a Sample],
    is_edge: F,
}

impl<F: Fn(usize, usize) -> bool> Outline<'_, F> {
    /// The score of an ear: its area over the sum of its sides' squares, less its penalties.
    fn ear(&self, left: &[usize], i: usize, steps: &mut StepCounter<'_>) -> Result<Ear, WorkspaceError> {
        let count = left.len();
        let around = [i + count - 1, i, i + 1].map(|n| left[n % count]);
        let corners = around.map(|n| self.polygon[n].at());
        let existing = if (self.is_edge)(around[0], around[2]) { EDGE } else { 0.0 };
        let shape = quality(corners);
        if shape <= 0.0 {
            return Ok(Ear { score: shape - REFLEX - existing, covers: None });
        }
        let mut covers = None;
        let bounds = bounds(corners);
        for &n in left {
            steps.step()?;
            let at = self.polygon[n].at();
            if in_bounds(bounds, at) && !around.contains(&n) && within(corners, at) {
                covers = Some(n);
                break;
            }
        }
        let pinched = self.polygon[around[0]].pinched() && self.polygon[around[2]].pinched();
        let covering = if covers.is_some() { COVERING } else { 0.0 };
        Ok(Ear { score: shape - covering - if pinched { PINCHED } else { 0.0 } - existing, covers })
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

    use super::{Sample, triangulate};
    use crate::machine::Machine;
    use crate::workspace::domain::Domain;
    use crate::workspace::observer::{Observer, StepCounter, Unobserved};
    use crate::workspace::request::{Kind, Request, WorkspaceError};

    fn round(points: u32) -> Vec<Sample> {
        let machine = Machine::verne();
        let request = Request::new(Kind::Platform, 1.0);
        let domain = Domain::new(&machine, &request, None);
        let at = |n: u32| (TAU * f64::from(n) / f64::from(points)).sin_cos();
        (0..points)
            .map(|n| {
                let (y, x) = at(n);
                // Not convex.
                Sample::new(&domain, if n % 7 == 0 { [9.0 * x, 9.0 * y] } else { [10.0 * x, 10.0 * y] })
            })
            .collect()
    }

    /// An ear is scored again where a cut has changed it, not after every cut.
    #[test]
    fn an_ear_is_scored_a_few_times() {
        for points in [4, 50, 400] {
            let samples = round(points);
            let calls = Cell::new(0);
            let is_edge = |_: usize, _: usize| {
                calls.set(calls.get() + 1);
                false
            };
            let samples: Vec<&Sample> = samples.iter().collect();
            let triangles = triangulate(&samples, is_edge, &mut StepCounter::new(&Unobserved)).unwrap();
            assert_eq!(triangles.len(), samples.len() - 2);
            assert!(calls.get() <= 5 * points, "{points} points, {} calls", calls.get());
        }
    }

    #[test]
    fn the_observer_can_stop_the_triangulation() {
        struct AlwaysCancelled;
        impl Observer for AlwaysCancelled {
            fn progress(&self, _part: f64) {}

            fn cancelled(&self) -> bool {
                true
            }
        }
        let samples = round(400);
        let samples: Vec<&Sample> = samples.iter().collect();
        let answer = triangulate(&samples, |_, _| false, &mut StepCounter::new(&AlwaysCancelled));
        assert_eq!(answer.err(), Some(WorkspaceError::Cancelled));
    }
}
