//! Least distance between the axes of two rods.

use crate::machine::Geometry;
use crate::rods::{FAMILY, RODS, Rods};

/// Of two rods whose directions differ by less than the square root of this, any point of the one
/// will do to start from: the distance does not depend on where along them it is measured.
const PARALLEL: f64 = 1e-14;
/// The nearest pair so far: square of the distance, and the rods as indices of the six.
type Nearest = (f64, usize, usize);

/// The least distance between two rods' axes as segments, mm, and the two rods' numbers.
#[inline]
pub(crate) fn nearest(g: &Geometry, rods: &Rods) -> (f64, [u8; 2]) {
    let ends = rods.platform_ends(g);
    let mut nearest = (f64::INFINITY, 0, 0);
    // A leg's own rods first: they are usually the nearest, and the rest is then seen to be
    // further apart at a glance. Rods 22 and 32 stand to each other as 21 and 31 do.
    meet(&mut nearest, &ends, rods, [0, 1]);
    let half = g.parallelogram_half_width;
    for (leg, first) in [(2, 2), (3, 4)] {
        let square = square_parallel(2.0 * half, &rods.vectors[leg]);
        if square < nearest.0 {
            nearest = (square, first, first + 1);
        }
    }
    for i in [0, 1] {
        for j in [2, 4] {
            if !far(&nearest, &to_middle(&ends, i, j, half), rods, [i, j], half) {
                meet(&mut nearest, &ends, rods, [i, j]);
                meet(&mut nearest, &ends, rods, [i, j + 1]);
            }
        }
    }
    if !far(&nearest, &difference(ends[2], ends[4]), rods, [2, 4], 2.0 * half) {
        for pair in [[2, 4], [2, 5], [3, 4]] {
            meet(&mut nearest, &ends, rods, pair);
        }
    }
    let (square, i, j) = nearest;
    (square.sqrt(), [RODS[i], RODS[j]])
}

/// Whether two rods are at least as far apart as the nearest pair, by what can be told without
/// their nearest points, wherever one of them is shifted along x by up to `shift` either way: the
/// segments' projections on the gap's direction are at least so far apart, times |gap|.
#[inline]
fn far(nearest: &Nearest, gap: &[f64; 3], rods: &Rods, [i, j]: [usize; 2], shift: f64) -> bool {
    let (a, b) = (&rods.vectors[FAMILY[i]], &rods.vectors[FAMILY[j]]);
    let square_gap = dot(gap, gap);
    let apart = square_gap - dot(a, gap).max(0.0) + dot(b, gap).min(0.0) - shift * gap[0].abs();
    apart > 0.0 && apart * apart >= nearest.0 * square_gap
}

#[inline]
fn meet(nearest: &mut Nearest, ends: &[[f64; 3]; 6], rods: &Rods, [i, j]: [usize; 2]) {
    let gap = difference(ends[i], ends[j]);
    if far(nearest, &gap, rods, [i, j], 0.0) {
        return;
    }
    let square = square_distance(&gap, &rods.vectors[FAMILY[i]], &rods.vectors[FAMILY[j]]);
    if square < nearest.0 {
        *nearest = (square, i, j);
    }
}

/// Squared distance of a parallelogram's two rods, `width` apart along x: a foot of the
/// perpendicular where there is one, else an end.
#[inline]
fn square_parallel(width: f64, rod: &[f64; 3]) -> f64 {
    let (along, square) = (width * rod[0], dot(rod, rod));
    let t = (along / square).clamp(-1.0, 1.0);
    width * width - t * (2.0 * along - t * square)
}

/// Squared distance of two segments that run back from their platform ends, which lie `gap`
/// apart, along -a and -b: the nearest points of the lines, then each clamped to its segment in
/// turn (C. Ericson, Real-Time Collision Detection, 2005, section 5.1.9).
fn square_distance(gap: &[f64; 3], a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let (along_a, along_b) = (dot(a, gap), dot(b, gap));
    let (square_a, square_b, across) = (dot(a, a), dot(b, b), dot(a, b));
    let gram = square_a * square_b - across * across;
    let parallel = gram <= PARALLEL * square_a * square_b;
    let s = if parallel { 0.0 } else { ((along_a * square_b - across * along_b) / gram).clamp(0.0, 1.0) };
    let t = ((across * s - along_b) / square_b).clamp(0.0, 1.0);
    let s = ((across * t + along_a) / square_a).clamp(0.0, 1.0);
    let at = |axis: usize| gap[axis] - a[axis] * s + b[axis] * t;
    let nearest = [at(0), at(1), at(2)];
    dot(&nearest, &nearest)
}

/// The gap between rod `i`'s platform end and the middle of a parallelogram's two, of which `j` is
/// the one at the greater x.
#[inline]
fn to_middle(ends: &[[f64; 3]; 6], i: usize, j: usize, half_width: f64) -> [f64; 3] {
    let [x, y, z] = difference(ends[i], ends[j]);
    [x + half_width, y, z]
}

#[inline]
fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline]
fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
