//! Triangles of a small polygon, by cutting off its best ears.

use super::site::Site;

/// What lessens an ear's worth: a cut between two points at which the sheets meet, a point inside,
/// and a corner that is not convex, whose cut may be another polygon's side.
const MEETING: f64 = 2.0;
const COVERING: f64 = 4.0;
const REFLEX: f64 = 8.0;
/// A cut that is an edge of another triangle already: the surface would not be one.
const TAKEN: f64 = 16.0;

/// Triangles, counter-clockwise, by the polygon's own numbers: always two fewer than its points.
/// `taken` tells which pairs of points are joined by an edge elsewhere.
pub(super) fn triangulate(polygon: &[&Site], taken: impl Fn(usize, usize) -> bool) -> Vec<[usize; 3]> {
    let mut left: Vec<usize> = (0..polygon.len()).collect();
    let mut triangles = Vec::with_capacity(polygon.len().saturating_sub(2));
    while left.len() > 3 {
        let count = left.len();
        let mut best = (0, f64::NEG_INFINITY);
        for i in 0..count {
            let cut = [left[(i + count - 1) % count], left[(i + 1) % count]];
            let worth = worth(polygon, &left, i) - if taken(cut[0], cut[1]) { TAKEN } else { 0.0 };
            if worth > best.1 {
                best = (i, worth);
            }
        }
        let i = best.0;
        triangles.push([left[(i + count - 1) % count], left[i], left[(i + 1) % count]]);
        left.remove(i);
    }
    if let [a, b, c] = left[..] {
        triangles.push([a, b, c]);
    }
    triangles
}

/// How good an ear is: its area over its sides' squares, less what is wrong with it.
fn worth(polygon: &[&Site], left: &[usize], i: usize) -> f64 {
    let count = left.len();
    let around = [i + count - 1, i, i + 1].map(|n| left[n % count]);
    let [a, b, c] = around.map(|n| polygon[n].at());
    let shape = quality(a, b, c);
    if shape <= 0.0 {
        return shape - REFLEX;
    }
    let mut others = left.iter().filter(|n| !around.contains(n));
    let covering = others.any(|&n| within(a, b, c, polygon[n].at()));
    let meeting = polygon[around[0]].pinched() && polygon[around[2]].pinched();
    shape - if covering { COVERING } else { 0.0 } - if meeting { MEETING } else { 0.0 }
}

fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let coordinate = |[x, y]: [f64; 2]| robust::Coord { x, y };
    robust::orient2d(coordinate(a), coordinate(b), coordinate(c))
}

fn quality(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let square = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
    let sides = square(a, b) + square(b, c) + square(c, a);
    if sides > 0.0 { turn(a, b, c) / sides } else { 0.0 }
}

fn within(a: [f64; 2], b: [f64; 2], c: [f64; 2], p: [f64; 2]) -> bool {
    turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0
}
