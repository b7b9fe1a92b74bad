//! The least distance between the rods, against a minimisation of the distance itself.

use nalgebra::{Vector3, Vector4};
use verne_solver::{Machine, Margins, PostureColumns, Registers, margin_rows, platform_working};

use crate::lengths::scale;
use crate::oracle::constructed_postures::{hung, postures, upright};
use crate::oracle::{Found, Legs};
use crate::random::Random;

const RODS: [u8; 6] = [11, 12, 21, 22, 31, 32];

type Segment = [Vector3<f64>; 2];

fn segment(legs: &Legs, found: &Found, rod: u8) -> Segment {
    let mut start = legs.on_slider(rod);
    start.z += found.rho[usize::from(rod / 10) - 1];
    [start, start + legs.rod(rod, &found.q, &found.rho)]
}

fn to_segment(point: &Vector3<f64>, [a, b]: &Segment) -> f64 {
    let along = b - a;
    let t = ((point - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    (point - a - along * t).norm()
}

/// The distance from a point running along one segment to the other segment is convex: its minimum
/// by golden section.
fn between(first: &Segment, second: &Segment) -> f64 {
    let at = |s: f64| to_segment(&(first[0] + (first[1] - first[0]) * s), second);
    let ratio = (5_f64.sqrt() - 1.0) / 2.0;
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..80 {
        let (c, d) = (high - ratio * (high - low), low + ratio * (high - low));
        if at(c) < at(d) { high = d } else { low = c }
    }
    at(low).min(at(0.0)).min(at(1.0))
}

/// The least distance between any two rods.
fn least(legs: &Legs, found: &Found) -> f64 {
    let segments = RODS.map(|rod| segment(legs, found, rod));
    let pairs = (0..6).flat_map(|i| (i + 1..6).map(move |j| (i, j)));
    pairs.map(|(i, j)| between(&segments[i], &segments[j])).fold(f64::INFINITY, f64::min)
}

fn check(machine: &Machine, found: &Found) {
    let legs = Legs::of(machine);
    let margins = Margins::of(machine, &found.posture(&legs), None);
    let expected = least(&legs, found) - 2.0 * legs.g.rod_radius;
    let tolerance = 1e-9 * scale(machine);
    let (got, pair) = (margins.rod_interference, margins.nearest_rods);
    assert!(
        (got - expected).abs() < tolerance,
        "{got} of {pair:?}, expected {expected}: {found:?} {:?}",
        legs.g
    );

    assert!(pair.iter().all(|rod| RODS.contains(rod)) && pair[0] != pair[1], "{pair:?}");
    let [first, second] = pair.map(|rod| segment(&legs, found, rod));
    let named = between(&first, &second) - 2.0 * legs.g.rod_radius;
    assert!((named - expected).abs() < tolerance, "{pair:?} are {named} apart, others {expected}: {found:?}");
}

#[test]
fn rod_distances_of_random_postures_are_minimal() {
    for (machine, found) in postures(121, 2000) {
        check(&machine, &found);
    }
}

/// Linear deltas, whose parallelograms have other directions than x.
#[test]
fn rod_distances_of_parallelograms_in_any_direction_are_minimal() {
    let (mut draw, mut count, mut between_legs) = (Random::new(122), 0, 0);
    while count < 2000 {
        let mut data = Machine::linear_delta().data().clone();
        let g = &mut data.geometry;
        g.parallelogram_direction = draw.between(-3.1, 3.1);
        g.parallelogram_half_width = draw.between(10.0, 150.0);
        (g.R2, g.D2) = (g.R2 * draw.between(0.2, 1.5), g.D2 * draw.between(-1.0, 1.0));
        let Ok(machine) = Machine::new(data) else { continue };
        let p = [draw.between(-250.0, 250.0), draw.between(-250.0, 250.0), 900.0];
        let Ok(posture) = platform_working(&machine, p) else { continue };
        let legs = Legs::of(&machine);
        let q = Vector4::new(p[0], p[1], p[2], posture.pose.alpha);
        check(&machine, &Found::new(&legs, q, posture.rho, 1.0));
        let margins = Margins::of(&machine, &posture, None);
        let mut rows = PostureColumns::new();
        rows.push(&posture, None);
        margin_rows(&machine, &rows, None, Registers::Widest, |_, block| assert_eq!(block.row(0), margins));
        let [first, second] = margins.nearest_rods;
        between_legs += u32::from(first / 10 != second / 10);
        count += 1;
    }
    assert!(between_legs > 100, "{between_legs}");
}

#[test]
fn distances_of_crossing_parallel_and_symmetric_rods_are_minimal() {
    use std::f64::consts::PI;
    let machine = Machine::verne();
    let legs = Legs::of(&machine);
    for (alpha, s1, sides) in
        [(0.0, 1.0, [1.0, 1.0]), (PI, 1.0, [1.0, 1.0]), (PI, -1.0, [1.0, -1.0]), (0.0, -1.0, [-1.0, 1.0])]
    {
        for x in [-300.0, -120.0, 0.0, 77.0, 300.0] {
            check(&machine, &hung(&legs, upright(&legs, alpha, x, 1200.0, s1).unwrap(), sides).unwrap());
        }
    }
}

#[test]
fn the_rods_of_leg_one_meet_between_alpha_0_and_180() {
    let machine = Machine::verne();
    let legs = Legs::of(&machine);
    let leg1 = upright(&legs, std::f64::consts::PI, 0.0, 1200.0, 1.0).unwrap();
    let posture = hung(&legs, leg1, [1.0, -1.0]).unwrap().posture(&legs);
    let margins = Margins::of(&machine, &posture, None);
    assert!((margins.rod_interference + 50.0).abs() < 1e-9, "{margins:?}");
    assert_eq!(margins.nearest_rods, [11, 12]);
}
