//! Unreachable poses are refused with the constraint that prevents them; numbers outside the domain are refused.

use verne_solver::{
    Constraint, Element, KinematicsError, MAX_INPUT, Machine, PartPose, Posture, Postures, forward,
    forward_working, part, part_working, platform, platform_working, tool, tool_working,
};

use crate::random::Random;

fn blocked<T: std::fmt::Debug>(answer: Result<T, KinematicsError>) -> (Constraint, Element) {
    match answer {
        Err(KinematicsError::Unreachable(margin)) => {
            assert!(margin.value < 0.0 && margin.value.is_finite(), "{margin:?}");
            (margin.constraint, margin.element)
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_position_beyond_leg_one_is_unreachable() {
    // Leg I's guideway is 500 mm to the right of the platform's joint, legs II and III's to the left.
    let machine = Machine::verne();
    let p = [-600.0, 0.0, 1000.0];
    assert_eq!(blocked(platform(&machine, p)), (Constraint::LegLength, Element::Leg(1)));
    assert_eq!(blocked(platform_working(&machine, p)), (Constraint::LegLength, Element::Leg(1)));
    assert_eq!(blocked(tool(&machine, p, 50.0)), (Constraint::LegLength, Element::Leg(1)));
    assert_eq!(blocked(tool_working(&machine, p, 50.0)), (Constraint::LegLength, Element::Leg(1)));
    let target = PartPose { x: -600.0, z: 650.0, ..PartPose::default() };
    assert_eq!(blocked(part(&machine, &target, 50.0)), (Constraint::LegLength, Element::Leg(1)));
    assert_eq!(blocked(part_working(&machine, &target, 50.0)), (Constraint::LegLength, Element::Leg(1)));
}

#[test]
fn a_position_beyond_legs_two_and_three_is_unreachable() {
    let machine = Machine::verne();
    let p = [600.0, 0.0, 1000.0];
    let (constraint, element) = blocked(platform(&machine, p));
    assert_eq!(constraint, Constraint::LegLength);
    assert!(matches!(element, Element::Leg(2 | 3)), "{element:?}");
    let (constraint, element) = blocked(platform_working(&machine, p));
    assert_eq!(constraint, Constraint::LegLength);
    assert!(matches!(element, Element::Leg(2 | 3)), "{element:?}");
    // To the side, towards slider 2's guideway, it is leg III that is too short.
    let (constraint, element) = blocked(platform_working(&machine, [200.0, -600.0, 1000.0]));
    assert_eq!((constraint, element), (Constraint::LegLength, Element::Leg(3)));
}

#[test]
fn sliders_too_far_apart_for_the_legs_are_unreachable() {
    let machine = Machine::verne();
    for rho in [[0.0, 4000.0, 0.0], [0.0, 0.0, -4000.0], [5000.0, 0.0, 0.0], [-1e6, 1e6, 0.0]] {
        assert_eq!(blocked(forward(&machine, rho)).0, Constraint::LegLength, "{rho:?}");
        blocked(forward_working(&machine, rho));
    }
}

#[test]
fn sliders_without_a_working_mode_are_refused() {
    let (machine, mut draw, mut seen) = (Machine::verne(), Random::new(141), 0);
    for _ in 0..2000 {
        let rho = draw.rho(&machine);
        let modes = forward(&machine, rho).unwrap_or_default();
        if !modes.is_empty() && modes.iter().all(|posture| !posture.working) {
            blocked(forward_working(&machine, rho));
            seen += 1;
        }
    }
    assert!(seen > 100, "{seen}");
}

#[test]
fn an_infeasible_pose_is_not_unreachable() {
    // A working posture that breaks the stroke is still an answer.
    let posture = platform_working(&Machine::verne(), [0.0, 0.0, 400.0]).unwrap();
    assert!(posture.working && posture.rho.iter().all(|&rho| rho < 0.0), "{posture:?}");
}

/// Every entry point with one number of its question replaced.
fn with_each_number(
    machine: &Machine,
    number: f64,
) -> Vec<(&'static str, usize, Result<(), KinematicsError>)> {
    let all = |answer: Result<Postures, KinematicsError>| answer.map(|_| ());
    let one = |answer: Result<Posture, KinematicsError>| answer.map(|_| ());
    let mut answers = Vec::new();
    for i in 0..6 {
        let mut n = [100.0, 50.0, 300.0, 0.1, 0.2, 40.0];
        n[i] = number;
        let point = [n[0], n[1], n[2]];
        let target = PartPose { x: n[0], y: n[1], z: n[2], phi1: n[3], phi2: n[4] };
        if i < 3 {
            answers.push(("forward", i, all(forward(machine, point))));
            answers.push(("forward_working", i, one(forward_working(machine, point))));
            answers.push(("platform", i, all(platform(machine, point))));
            answers.push(("platform_working", i, one(platform_working(machine, point))));
        }
        if i < 3 || i == 5 {
            answers.push(("tool", i, all(tool(machine, point, n[5]))));
            answers.push(("tool_working", i, one(tool_working(machine, point, n[5]))));
        }
        answers.push(("part", i, all(part(machine, &target, n[5]))));
        answers.push(("part_working", i, one(part_working(machine, &target, n[5]))));
    }
    answers
}

#[test]
fn numbers_beyond_the_domain_are_refused() {
    let beyond = MAX_INPUT.next_up();
    let numbers = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, f64::MAX, beyond, -beyond];
    for number in numbers {
        for (name, place, answer) in with_each_number(&Machine::verne(), number) {
            assert_eq!(answer, Err(KinematicsError::OutOfDomain), "{name} with {number} in place {place}");
        }
    }
}

#[test]
fn numbers_at_the_edge_of_the_domain_are_accepted() {
    for number in [MAX_INPUT, -MAX_INPUT, 0.0, -0.0, f64::MIN_POSITIVE, 5e-324] {
        for (name, place, answer) in with_each_number(&Machine::verne(), number) {
            assert_ne!(answer, Err(KinematicsError::OutOfDomain), "{name} with {number} in place {place}");
        }
    }
}
