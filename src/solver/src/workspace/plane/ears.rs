//! Triangles of a small polygon, by cutting off its best ears.

use super::site::Site;

/// Worth of an ear whose cut joins two points at which the sheets meet: last of all.
const FLAT: f64 = -2.0;

/// Triangles, counter-clockwise, by the polygon's own numbers: always two fewer than its points.
pub(super) fn triangulate(polygon: &[&Site]) -> Vec<[usize; 3]> {
    let mut left: Vec<usize> = (0..polygon.len()).collect();
    let mut triangles = Vec::with_capacity(polygon.len().saturating_sub(2));
    while left.len() > 3 {
        let count = left.len();
        let mut best = (0, f64::NEG_INFINITY);
        for i in 0..count {
            let worth = worth(polygon, &left, i);
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

/// How good an ear is: its area over its sides' squares, less than -1 where it is none.
fn worth(polygon: &[&Site], left: &[usize], i: usize) -> f64 {
    let count = left.len();
    let [a, b, c] = [i + count - 1, i, i + 1].map(|n| polygon[left[n % count]]);
    let shape = quality(a.at(), b.at(), c.at());
    let others = left.iter().filter(|&&n| ![a, b, c].iter().any(|site| std::ptr::eq(*site, polygon[n])));
    let covers = shape > 0.0 && others.into_iter().any(|&n| within(a.at(), b.at(), c.at(), polygon[n].at()));
    let pinched = a.pinched() && c.pinched();
    shape + if pinched { FLAT } else { 0.0 } + if covers { 2.0 * FLAT } else { 0.0 }
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
