//! Least distance between the axes of two rods.

use crate::fast_math::{greater, lesser};
use crate::mechanism::Mechanism;
use crate::pose::PlatformPose;
use crate::rods::{FAMILY, RODS, Rods};

/// Square of the difference of two rods' directions below which they count as parallel. Any point of the one then
/// serves as the start: the distance does not depend on it.
const PARALLEL: f64 = 1e-14;
/// Square of the sine of the angle between two lines below which their distance loses digits.
const NEARLY_PARALLEL: f64 = 1e-6;
/// Allowance for rounding in the square of the distance of two lines, as a factor.
const LINE_ROUNDING: f64 = 1.0 + 1e-9;
/// Allowance for rounding in the square of a distance, as a factor.
const ROUNDING: f64 = 1.0 + 1e-12;

/// The nearest pair so far: square of the distance, and the rods' numbers.
struct NearestPair {
    square: f64,
    rods: [u8; 2],
}

impl NearestPair {
    /// Replaces the pair by a nearer one.
    #[inline(always)]
    fn compare(&mut self, square: f64, rods: [usize; 2]) {
        if square < self.square {
            *self = Self { square, rods: rods.map(|rod| RODS[rod]) };
        }
    }

    /// The distance, and the rods' numbers.
    #[inline(always)]
    fn distance(&self) -> (f64, [u8; 2]) {
        (self.square.sqrt(), self.rods)
    }
}

/// The least distance between two rods' axes as segments, mm, and the two rods' numbers.
#[inline(always)]
pub(crate) fn least_distance(d: &Mechanism, rods: &Rods) -> (f64, [u8; 2]) {
    let ends = rods.platform_ends(d);
    // Leg I's own rods come first: they are usually the nearest, and the other pairs are then quickly seen to be
    // further apart.
    let (square, leg) = of_one_leg(d, &ends, rods);
    let mut nearest = NearestPair { square, rods: rods_of_leg(leg) };
    compare_between_legs(&mut nearest, d, &ends, rods);
    nearest.distance()
}

/// The same of a parallelogram's two rods.
#[inline]
pub(super) fn least_distance_in_parallelograms(d: &Mechanism, rods: &Rods) -> (f64, [u8; 2]) {
    let [second, third] = squares_of_parallelograms(d, rods);
    let (square, leg) = if third < second { (third, 2) } else { (second, 1) };
    (square.sqrt(), rods_of_leg(leg))
}

/// The same of all other pairs.
#[inline]
pub(super) fn least_distance_of_others(d: &Mechanism, rods: &Rods) -> (f64, [u8; 2]) {
    let ends = rods.platform_ends(d);
    let mut nearest = NearestPair { square: square_of_leg_one(&ends, rods), rods: rods_of_leg(0) };
    compare_between_legs(&mut nearest, d, &ends, rods);
    nearest.distance()
}

/// The least distance between the two rods of a leg, and the leg: 0, 1 or 2.
pub(super) struct NearestWithinLegs {
    pub(super) distance: f64,
    pub(super) leg: u64,
    /// Whether rods of different legs are certainly not nearer.
    pub(super) others_are_farther: bool,
}

/// The least distance between the two rods of a leg, mm.
#[inline(always)]
pub(super) fn nearest_within_legs(d: &Mechanism, rods: &Rods) -> NearestWithinLegs {
    let ends = rods.platform_ends(d);
    let (square, leg) = of_one_leg(d, &ends, rods);
    let others_are_farther = others_are_farther(square, d, &ends, rods);
    NearestWithinLegs { distance: square.sqrt(), leg, others_are_farther }
}

/// The numbers of a leg's two rods, from 0, 1 or 2 for the leg.
#[inline]
pub(super) fn rods_of_leg(leg: u64) -> [u8; 2] {
    // Without branches: which leg's rods are nearest is unpredictable.
    let of = |leg: [u8; 2], chosen: bool| leg.map(|rod| rod * u8::from(chosen));
    let [first, second, third] = [of([11, 12], leg == 0), of([21, 22], leg == 1), of([31, 32], leg == 2)];
    [first[0] + second[0] + third[0], first[1] + second[1] + third[1]]
}

/// The square of the least distance between the two rods of a leg, and 0, 1 or 2 for the leg.
#[inline(always)]
fn of_one_leg(d: &Mechanism, ends: &[[f64; 3]; 6], rods: &Rods) -> (f64, u64) {
    let first = square_of_leg_one(ends, rods);
    let [second, third] = squares_of_parallelograms(d, rods);
    let (square, leg) = if second < first { (second, 1) } else { (first, 0) };
    if third < square { (third, 2) } else { (square, leg) }
}

/// The least distances between two rods' axes, mm: of leg I's, of a parallelogram's, and of rods of
/// different legs. Their minimum is [`least_distance`]'s; it has a kink where another of them becomes the
/// least, and each of them has none there.
#[inline(always)]
pub(crate) fn least_distances_by_legs(d: &Mechanism, rods: &Rods) -> [f64; 3] {
    let ends = rods.platform_ends(d);
    let first = square_of_leg_one(&ends, rods);
    let [second, third] = squares_of_parallelograms(d, rods);
    let mut between = NearestPair { square: f64::INFINITY, rods: [11, 12] };
    for &pair in pairs_between_legs(d) {
        compare_pair(&mut between, &ends, rods, pair);
    }
    [first, lesser(second, third), between.square].map(f64::sqrt)
}

/// Positive only if all rods are clearly further apart than a distance, which is not negative: leg
/// I's across the platform, leg I from the others along x, legs II and III from each other along
/// y, a parallelogram's two as the lines that they lie on.
#[inline(always)]
pub(super) fn separation_bound(d: &Mechanism, pose: &PlatformPose, rods: &Rods, distance: f64) -> f64 {
    let least = ROUNDING * distance * distance;
    let (g, half) = (&d.geometry, d.geometry.parallelogram_half_width);
    let [along, across] = d.pair_offset.map(f64::abs);
    let along_x = interval_distance([pose.x + g.D1, g.d1], [pose.x + g.D2, g.d2]) - along;
    let sides = g.R2 * rods.c;
    let along_y = interval_distance([pose.y - sides, -g.r4], [pose.y + sides, g.r4]) - 2.0 * across;
    let clear = lesser(along_x, along_y);
    let [second, third] = along_pairs(d, rods);
    let parallel = 4.0 * half * half * (1.0 - greater(second * second, third * third));
    // The projections on leg I's arms, of half the length between them.
    let inner = |rod: usize| rods.c * rods.vectors[rod][1] + rods.s * rods.vectors[rod][2];
    let first = 2.0 * g.R1 - greater(inner(0), 0.0) + lesser(inner(1), 0.0);
    let legs = lesser(lesser(clear, first), parallel - least);
    lesser(legs, lesser(clear * clear, first * first) - least)
}

/// Distance between two intervals, each by its ends in any order; not positive if they meet.
#[inline(always)]
fn interval_distance([a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
    greater(lesser(a, b) - greater(c, d), lesser(c, d) - greater(a, b))
}

/// The square of the distance between leg I's two rods.
#[inline(always)]
fn square_of_leg_one(ends: &[[f64; 3]; 6], rods: &Rods) -> f64 {
    square_distance(&difference(ends[0], ends[1]), &rods.vectors[0], &rods.vectors[1])
}

/// The squares of the distances between the two rods of each parallelogram.
#[inline(always)]
fn squares_of_parallelograms(d: &Mechanism, rods: &Rods) -> [f64; 2] {
    let (g, width) = (&d.geometry, 2.0 * d.geometry.parallelogram_half_width);
    let [second, third] = along_pairs(d, rods);
    [square_parallel(width, g.L2, second), square_parallel(width, g.L3, third)]
}

/// The components of the directions of legs II and III along the widths of their parallelograms.
#[inline(always)]
fn along_pairs(d: &Mechanism, rods: &Rods) -> [f64; 2] {
    let ([c, s], [.., second, third]) = (d.pair_direction, &rods.directions);
    [second[0] * c + second[1] * s, third[0] * c - third[1] * s]
}

/// Whether all rods of different legs are at least as far apart as the nearest pair, whose distance's square is given.
#[inline(always)]
fn others_are_farther(nearest: f64, d: &Mechanism, ends: &[[f64; 3]; 6], rods: &Rods) -> bool {
    let [along, across] = d.pair_offset;
    let (second, third) = ([along, across], [along, -across]);
    let extent = |gap: &[f64; 3], [x, y]: [f64; 2]| (gap[0] * x + gap[1] * y).abs();
    let from_leg_one = |i: usize, j: usize| {
        let offset = if j == 2 { second } else { third };
        lines_are_farther(nearest, &to_middle(ends, i, j, offset), rods, [i, j], offset)
    };
    // From the middle of the one to the middle of the other.
    let [x, y, z] = difference(ends[2], ends[4]);
    let gap = [x, y - 2.0 * across, z];
    let parallelograms = is_farther(nearest, &gap, rods, [2, 4], extent(&gap, second) + extent(&gap, third));
    from_leg_one(0, 2) & from_leg_one(0, 4) & from_leg_one(1, 2) & from_leg_one(1, 4) & parallelograms
}

/// Pairs of rods of different legs.
const BETWEEN_LEGS: [[usize; 2]; 12] =
    [[0, 2], [0, 3], [0, 4], [0, 5], [1, 2], [1, 3], [1, 4], [1, 5], [2, 4], [2, 5], [3, 4], [3, 5]];

/// The pairs that have distances of their own. Parallelograms along x have rods 22 and 32 at the same distance as 21
/// and 31.
pub(crate) fn pairs_between_legs(d: &Mechanism) -> &'static [[usize; 2]] {
    &BETWEEN_LEGS[..if d.pair_offset[1] == 0.0 { 11 } else { 12 }]
}

/// The pairs of rods of different legs.
#[inline(always)]
fn compare_between_legs(nearest: &mut NearestPair, d: &Mechanism, ends: &[[f64; 3]; 6], rods: &Rods) {
    // Nearly always all are farther.
    if !others_are_farther(nearest.square, d, ends, rods) {
        for &pair in pairs_between_legs(d) {
            compare_pair(nearest, ends, rods, pair);
        }
    }
}

/// Whether two rods are at least as far apart as the nearest pair, whose distance's square is given, decided without
/// their nearest points, if their ends are shifted by up to `extent` along the gap, times |gap|: the segments'
/// projections on the gap's direction are at least so far apart, times |gap|.
#[inline(always)]
fn is_farther(nearest: f64, gap: &[f64; 3], rods: &Rods, [i, j]: [usize; 2], extent: f64) -> bool {
    let (a, b) = (&rods.vectors[FAMILY[i]], &rods.vectors[FAMILY[j]]);
    let square_gap = dot(gap, gap);
    let apart = square_gap - greater(dot(a, gap), 0.0) + lesser(dot(b, gap), 0.0) - extent;
    (apart > 0.0) & (apart * apart >= nearest * square_gap)
}

/// Whether the lines on which two rods lie, and so the rods, are certainly at least as far apart as the nearest pair,
/// whose distance's square is given, if one of them is shifted by up to `offset` along x and y
/// either way. Rods of leg I cross
/// the others at a large angle and at a distance: nearly always this decides.
#[inline(always)]
fn lines_are_farther(
    nearest: f64,
    gap: &[f64; 3],
    rods: &Rods,
    [i, j]: [usize; 2],
    offset: [f64; 2],
) -> bool {
    let normal = cross(&rods.directions[FAMILY[i]], &rods.directions[FAMILY[j]]);
    let square = dot(&normal, &normal);
    let apart = dot(gap, &normal).abs() - (normal[0] * offset[0] + normal[1] * offset[1]).abs();
    (square > NEARLY_PARALLEL) & (apart > 0.0) & (apart * apart >= LINE_ROUNDING * nearest * square)
}

#[inline(always)]
fn compare_pair(nearest: &mut NearestPair, ends: &[[f64; 3]; 6], rods: &Rods, [i, j]: [usize; 2]) {
    let gap = difference(ends[i], ends[j]);
    if is_farther(nearest.square, &gap, rods, [i, j], 0.0) {
        return;
    }
    let square = square_distance(&gap, &rods.vectors[FAMILY[i]], &rods.vectors[FAMILY[j]]);
    nearest.compare(square, [i, j]);
}

/// Squared distance of a parallelogram's two rods, `width` apart, whose direction has the component `x` along the
/// width: a foot of the perpendicular where there is one, else an end. It is the same to the last bit for legs II and
/// III of one length, which are equally bad if the widths lie along x.
#[inline(always)]
fn square_parallel(width: f64, length: f64, x: f64) -> f64 {
    let along = width * x.abs();
    if along <= length {
        width * width * (1.0 - x * x)
    } else {
        width * width - length * (2.0 * along - length)
    }
}

/// Squared distance of two segments that run back from their platform ends, which lie `gap`
/// apart, along -a and -b: the nearest points of the lines, then each clamped to its segment in
/// turn (C. Ericson, Real-Time Collision Detection, 2005, section 5.1.9).
#[inline(always)]
pub(crate) fn square_distance(gap: &[f64; 3], a: &[f64; 3], b: &[f64; 3]) -> f64 {
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

/// The gap between rod `i`'s platform end and the middle of a parallelogram's two, of which `j` is the one at the
/// offset.
#[inline(always)]
fn to_middle(ends: &[[f64; 3]; 6], i: usize, j: usize, offset: [f64; 2]) -> [f64; 3] {
    let [x, y, z] = difference(ends[i], ends[j]);
    [x + offset[0], y + offset[1], z]
}

#[inline(always)]
fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
