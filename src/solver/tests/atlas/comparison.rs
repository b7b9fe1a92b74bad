//! The solver's answer at points of the plane, compared with that of an atlas.

#![allow(dead_code, reason = "each user takes what it wants")]

use verne_solver::atlas::{Atlas, AtlasRequest, Face, Space, Window};
use verne_solver::{KinematicsError, Machine, forward, forward_working, platform, platform_working};

use crate::random::Random;

/// The number of solutions at a point; `None` if they form a curve.
pub(crate) fn solutions(machine: &Machine, space: Space, [u, v]: [f64; 2]) -> Option<usize> {
    let found = match space {
        Space::Platform => platform(machine, [u, v, 0.0]),
        Space::Joints => forward(machine, [0.0, u, v]),
    };
    match found {
        Ok(postures) => Some(postures.len()),
        Err(KinematicsError::Unreachable(_)) => Some(0),
        Err(_) => None,
    }
}

/// Whether a solution is in the working mode at a point.
pub(crate) fn has_working(machine: &Machine, space: Space, [u, v]: [f64; 2]) -> bool {
    match space {
        Space::Platform => platform_working(machine, [u, v, 0.0]).is_ok(),
        Space::Joints => forward_working(machine, [0.0, u, v]).is_ok(),
    }
}

/// The outcome of a comparison at many points.
#[derive(Debug, Default)]
pub(crate) struct Comparison {
    /// Points that were compared.
    pub(crate) compared: usize,
    /// Points within the tolerance of a side, which were not.
    pub(crate) near: usize,
    /// Points at which the answers differ.
    pub(crate) wrong: Vec<[f64; 2]>,
}

impl Comparison {
    fn add(&mut self, at: [f64; 2], is_near: bool, is_right: bool) {
        if is_near {
            self.near += 1;
        } else {
            self.compared += 1;
            if !is_right {
                self.wrong.push(at);
            }
        }
    }
}

/// Compares the numbers of solutions at random points of the window.
pub(crate) fn compare_numbers(
    machine: &Machine,
    request: &AtlasRequest,
    atlas: &Atlas,
    points: usize,
) -> Comparison {
    let mut comparison = Comparison::default();
    for at in random_points(&request.window, points) {
        let beside = atlas.regions.iter().map(|region| beside(&region.face, &request.window, at));
        let (mut numbers, mut nearest) = (Vec::new(), f64::INFINITY);
        for (region, (is_inside, distance)) in atlas.regions.iter().zip(beside) {
            nearest = nearest.min(distance);
            if is_inside {
                numbers.push(region.solutions);
            }
        }
        let is_right = solutions(machine, request.space, at).is_none_or(|number| numbers == [number]);
        comparison.add(at, nearest <= request.tolerance, is_right);
    }
    comparison
}

/// Compares the working mode's domain with the solver at random points of the window.
pub(crate) fn compare_working(
    machine: &Machine,
    request: &AtlasRequest,
    atlas: &Atlas,
    points: usize,
) -> Comparison {
    let mut comparison = Comparison::default();
    for at in random_points(&request.window, points) {
        let (mut pieces, mut nearest) = (0, f64::INFINITY);
        for face in &atlas.working {
            let (is_inside, distance) = beside(face, &request.window, at);
            nearest = nearest.min(distance);
            pieces += usize::from(is_inside);
        }
        let is_right = pieces == usize::from(has_working(machine, request.space, at));
        comparison.add(at, nearest <= request.tolerance, is_right);
    }
    comparison
}

fn random_points(window: &Window, count: usize) -> impl Iterator<Item = [f64; 2]> {
    let mut draw = Random::new(0xA71A5);
    std::iter::repeat_with(move || [window.u, window.v].map(|[low, high]| draw.between(low, high)))
        .take(count)
}

/// Whether a point is inside a face, and its distance from the nearest side that is none of the window's.
fn beside(face: &Face, window: &Window, at: [f64; 2]) -> (bool, f64) {
    let (mut is_inside, mut nearest) = (false, f64::INFINITY);
    for ring in std::iter::once(&face.outer).chain(&face.holes) {
        for (i, a) in ring.iter().enumerate() {
            let b = &ring[(i + 1) % ring.len()];
            if (a[1] <= at[1]) != (b[1] <= at[1])
                && at[0] < a[0] + (b[0] - a[0]) * (at[1] - a[1]) / (b[1] - a[1])
            {
                is_inside = !is_inside;
            }
            if !is_on_border(window, [*a, *b]) {
                nearest = nearest.min(distance(at, [*a, *b]));
            }
        }
    }
    (is_inside, nearest)
}

/// Whether a side is on a side of the window.
fn is_on_border(window: &Window, [a, b]: [[f64; 2]; 2]) -> bool {
    let sides = [(0, window.u[0]), (0, window.u[1]), (1, window.v[0]), (1, window.v[1])];
    let slack = 1e-9 * (window.u[1] - window.u[0]).max(window.v[1] - window.v[0]);
    sides.into_iter().any(|(axis, side)| (a[axis] - side).abs() < slack && (b[axis] - side).abs() < slack)
}

/// The distance of a point from a segment.
pub(crate) fn distance(at: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let (chord, offset) = ([b[0] - a[0], b[1] - a[1]], [at[0] - a[0], at[1] - a[1]]);
    let square = chord[0] * chord[0] + chord[1] * chord[1];
    let along = offset[0] * chord[0] + offset[1] * chord[1];
    let fraction = if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 };
    (offset[0] - fraction * chord[0]).hypot(offset[1] - fraction * chord[1])
}

/// The area in which the number of solutions has each value, by counting the points of a lattice with `count` points
/// along each side.
pub(crate) fn lattice_areas(machine: &Machine, request: &AtlasRequest, count: u32) -> [f64; 25] {
    let Window { u, v } = request.window;
    let steps = [u, v].map(|[low, high]| (high - low) / f64::from(count));
    let mut areas = [0.0; 25];
    for row in 0..count {
        for column in 0..count {
            let at = [u[0] + steps[0] * (f64::from(column) + 0.5), v[0] + steps[1] * (f64::from(row) + 0.5)];
            if let Some(number) = solutions(machine, request.space, at) {
                areas[number] += steps[0] * steps[1];
            }
        }
    }
    areas
}

/// The same of an atlas.
pub(crate) fn region_areas(atlas: &Atlas) -> [f64; 25] {
    let mut areas = [0.0; 25];
    for region in &atlas.regions {
        areas[region.solutions] += region.face.area;
    }
    areas
}
