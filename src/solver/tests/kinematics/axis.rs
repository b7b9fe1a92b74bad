//! The tool's axis in the part frame, and the orientations that give it.

use std::f64::consts::{FRAC_PI_2, PI};

use verne_solver::axis::{Preimages, preimages, tool_axis};
use verne_solver::{Machine, PartPose, part};

use crate::random::Random;

fn assert_same(a: [f64; 3], b: [f64; 3]) {
    assert!((0..3).all(|i| (a[i] - b[i]).abs() < 1e-14), "{a:?} is not {b:?}");
}

fn both(axis: [f64; 3]) -> [[f64; 2]; 2] {
    match preimages(axis) {
        Some(Preimages::Two(both)) => both,
        other => panic!("{axis:?}: {other:?}"),
    }
}

#[test]
fn the_axis_follows_the_formula_of_the_part_frame() {
    assert_same(tool_axis(0.0, 1.0), [0.0, 0.0, 1.0]);
    assert_same(tool_axis(FRAC_PI_2, 0.0), [0.0, -1.0, 0.0]);
    assert_same(tool_axis(FRAC_PI_2, FRAC_PI_2), [1.0, 0.0, 0.0]);
}

#[test]
fn both_preimages_give_the_axis() {
    let mut draw = Random::new(161);
    for _ in 0..5000 {
        let (phi1, phi2) = (draw.between(-PI, PI), draw.between(-PI, PI));
        let (axis, length) = (tool_axis(phi1, phi2), draw.magnitude(1e-3, 1e3));
        let [first, twin] = both(axis.map(|c| c * length));
        assert_same(tool_axis(first[0], first[1]), axis);
        assert_same(tool_axis(twin[0], twin[1]), axis);
        assert!(first[0] > 0.0 && first[0] < PI && twin[0] == -first[0], "{first:?} {twin:?}");
        assert!((first[1] - twin[1]).abs() > 3.0, "{first:?} {twin:?}");
    }
}

#[test]
fn the_preimages_of_an_orientation_contain_it() {
    let mut draw = Random::new(162);
    for _ in 0..1000 {
        let (phi1, phi2) = (draw.between(1e-6, PI - 1e-6), draw.between(-PI, PI));
        let [first, _] = both(tool_axis(phi1, phi2));
        assert!((first[0] - phi1).abs() < 1e-9 && (first[1] - phi2).abs() < 1e-9, "{first:?} {phi1} {phi2}");
    }
}

#[test]
fn a_small_inclination_keeps_its_azimuth() {
    for inclined in [1e-3, 1e-4, 1e-5, 1.1e-6] {
        let [first, _] = both([inclined * 0.6, -inclined * 0.8, 1.0]);
        assert!((first[0] / inclined - 1.0).abs() < 1e-6, "{first:?}");
        assert!((first[1] - 0.6_f64.atan2(0.8)).abs() < 1e-12, "{first:?}");
    }
}

#[test]
fn the_azimuth_is_free_at_the_pole() {
    assert_eq!(preimages([0.0, 0.0, 1.0]), Some(Preimages::Free { phi1: 0.0 }));
    assert_eq!(preimages([0.0, -0.0, 250.0]), Some(Preimages::Free { phi1: 0.0 }));
    assert_eq!(preimages([0.0, 0.0, -1.0]), Some(Preimages::Free { phi1: PI }));
    for noise in [1e-17, 1e-9, 1e-7, 0.7e-6] {
        assert_eq!(preimages([noise, -noise, 1.0]), Some(Preimages::Free { phi1: 0.0 }));
        assert_eq!(preimages([-30.0 * noise, 30.0 * noise, -30.0]), Some(Preimages::Free { phi1: PI }));
    }
    let printed = tool_axis(0.0, 2.0);
    assert_eq!(preimages(printed), Some(Preimages::Free { phi1: 0.0 }));
}

/// A zero's sign and rounding choose no other branch: they would turn the table by a whole turn.
#[test]
fn the_sign_of_zero_makes_no_difference() {
    for [i, j, k] in [[0.0, 1.0, 3.0], [0.0, -1.0, 3.0], [0.4, 0.0, 1.0], [-0.4, 0.0, 0.0], [0.0, 0.7, 0.0]] {
        let plain = both([i, j, k]);
        for noise in [-0.0, 1e-17, -1e-17, 1e-12, -1e-12] {
            let noisy = both([i, j, k].map(|c| if c == 0.0 { noise } else { c }));
            for (a, b) in plain.as_flattened().iter().zip(noisy.as_flattened()) {
                assert!((a - b).abs() < 1e-11, "{plain:?} {noisy:?}");
            }
        }
    }
}

#[test]
fn a_zero_vector_has_no_preimage() {
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    assert_eq!(preimages([0.0; 3]), None);
    for (place, value) in (0..3).flat_map(|place| bad.map(|value| (place, value))) {
        let mut axis = [0.1, 0.2, 0.9];
        axis[place] = value;
        assert_eq!(preimages(axis), None, "{axis:?}");
    }
}

#[test]
fn an_axis_can_have_any_magnitude() {
    for size in [1e-300, 1e-100, 1e100, 1e300] {
        assert_same(
            tool_axis(both([0.3 * size, 0.4 * size, size])[0][0], 0.0),
            tool_axis(0.5_f64.atan(), 0.0),
        );
    }
}

#[test]
fn both_preimages_reach_the_same_point_with_the_same_axis() {
    let machine = Machine::verne();
    let [first, twin] = both([0.2, -0.1, 1.0]);
    for [phi1, phi2] in [first, twin] {
        let target = PartPose { x: 30.0, y: -40.0, z: 300.0, phi1, phi2 };
        for posture in part(&machine, &target, 50.0).expect("within reach") {
            let table = verne_solver::table_angles(&machine, posture.pose.alpha, phi1, phi2);
            let held = verne_solver::part_pose(&machine, &posture.pose, table, 50.0);
            assert_same(tool_axis(held.phi1, held.phi2), tool_axis(first[0], first[1]));
        }
    }
}
