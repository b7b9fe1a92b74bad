//! Every solution of the reference sets, and no other.

use verne_solver::{
    KinematicsError, Machine, PartPose, Posture, Postures, forward, forward_working, part, part_pose,
    part_working, platform, platform_working, table_angles,
};

use crate::reference_cases::{self, InverseCase, Solution};

/// Accuracy of a coordinate, mm.
const LENGTH: f64 = 1e-9;
/// Accuracy of an angle: 1e-9 degrees.
const ANGLE: f64 = 1.745_329e-11;

fn turned(a: f64, b: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    ((a - b) - turn * ((a - b) / turn).round()).abs()
}

fn is(posture: &Posture, truth: &Solution) -> bool {
    let p = &posture.pose;
    let near = |a: &[f64; 3], b: &[f64; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < LENGTH);
    near(&[p.x, p.y, p.z], &truth.platform)
        && near(&posture.rho, &truth.rho)
        && turned(p.alpha, truth.alpha) < ANGLE
}

/// One to one, flags included.
fn check(tag: &str, postures: Result<Postures, KinematicsError>, solutions: &[Solution]) {
    if solutions.is_empty() {
        assert!(matches!(postures, Err(KinematicsError::Unreachable(_))), "{tag}: {postures:?}");
        return;
    }
    let postures = postures.unwrap_or_else(|refusal| panic!("{tag}: {refusal:?}"));
    assert_eq!(postures.len(), solutions.len(), "{tag}: {postures:#?}");
    for truth in solutions {
        let at = (truth.platform, truth.alpha, truth.rho);
        let hits: Vec<_> = postures.iter().filter(|posture| is(posture, truth)).collect();
        assert_eq!(hits.len(), 1, "{tag}: {at:?} in {postures:#?}");
        assert_eq!(hits[0].working, truth.working, "{tag}: {at:?}");
        assert!(!hits[0].merged, "{tag}: {at:?}");
        assert!(hits[0].residual < LENGTH, "{tag}: {at:?}");
        assert!(hits[0].pose.alpha > -std::f64::consts::PI && hits[0].pose.alpha <= std::f64::consts::PI);
    }
}

/// The working mode alone is the one among all, and refused where there is none.
fn check_working(tag: &str, posture: Result<Posture, KinematicsError>, solutions: &[Solution]) {
    if let Some(truth) = solutions.iter().find(|truth| truth.working) {
        let posture = posture.unwrap_or_else(|refusal| panic!("{tag}: {refusal:?}"));
        assert!(
            is(&posture, truth),
            "{tag}: {posture:?} is not {:?}",
            (truth.platform, truth.alpha, truth.rho)
        );
        assert!(posture.working && posture.residual < LENGTH, "{tag}: {posture:?}");
    } else {
        assert!(matches!(posture, Err(KinematicsError::Unreachable(_))), "{tag}: {posture:?}");
    }
}

fn target(case: &InverseCase) -> PartPose {
    let [x, y, z, phi1, phi2] = case.pose[..] else { panic!("{}: {:?}", case.tag, case.pose) };
    PartPose { x, y, z, phi1, phi2 }
}

#[test]
fn forward_solutions_equal_the_reference() {
    for case in reference_cases::forward() {
        check(&case.tag, forward(&case.machine, case.rho), &case.solutions);
        check_working(&case.tag, forward_working(&case.machine, case.rho), &case.solutions);
    }
}

#[test]
fn inverse_solutions_equal_the_reference() {
    for case in reference_cases::inverse() {
        let (all, working) = if let Some(tool_length) = case.tool_length {
            let target = target(&case);
            (part(&case.machine, &target, tool_length), part_working(&case.machine, &target, tool_length))
        } else {
            let p = case.pose[..].try_into().unwrap();
            (platform(&case.machine, p), platform_working(&case.machine, p))
        };
        check(&case.tag, all, &case.solutions);
        check_working(&case.tag, working, &case.solutions);
    }
}

#[test]
fn forward_of_a_reference_posture_returns_it() {
    for case in reference_cases::inverse() {
        for truth in &case.solutions {
            let modes = forward(&case.machine, truth.rho).expect("the reference posture is an assembly mode");
            assert_eq!(
                modes.iter().filter(|posture| is(posture, truth)).count(),
                1,
                "{}: {modes:#?}",
                case.tag
            );
        }
    }
}

#[test]
fn the_table_moves_the_reference_platform_to_the_target() {
    for case in reference_cases::inverse().iter().filter(|case| case.tool_length.is_some()) {
        let (target, tool_length) = (target(case), case.tool_length.unwrap());
        for posture in part(&case.machine, &target, tool_length).unwrap() {
            let truth =
                case.solutions.iter().find(|truth| is(&posture, truth)).expect("a reference solution");
            let [theta1, theta2] = truth.table.unwrap();
            let table = table_angles(&case.machine, posture.pose.alpha, target.phi1, target.phi2);
            assert!(
                turned(table.theta1, theta1) < ANGLE && turned(table.theta2, theta2) < ANGLE,
                "{table:?}"
            );
            let back = part_pose(&case.machine, &posture.pose, table, tool_length);
            for (got, wanted) in [(back.x, target.x), (back.y, target.y), (back.z, target.z)] {
                assert!((got - wanted).abs() < LENGTH, "{}: {back:?}", case.tag);
            }
            assert!(turned(back.phi1, target.phi1) < ANGLE && turned(back.phi2, target.phi2) < ANGLE);
        }
    }
}

#[test]
fn the_built_in_machine_equals_the_published_one() {
    assert_eq!(Machine::verne().data(), reference_cases::verne().data());
    assert_eq!(Machine::verne(), Machine::new(Machine::verne().data().clone()).unwrap());
}
