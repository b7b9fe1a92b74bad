//! The poses to measure next.

use verne_solver::calibration::{Calibration, CalibrationOptions, Plan, simulated};
use verne_solver::parameter::{ActualMachine, Parameter};
use verne_solver::{Machine, Margins, forward_working, part_working};

use crate::bench::{Kind, TOOL, calibration, deviating, measured, plan, poses, with_sigma};
use crate::random::Random;

const SIGMA: f64 = 0.002;

fn with_next(next: usize) -> CalibrationOptions {
    CalibrationOptions { next, ..with_sigma(SIGMA) }
}

/// The logarithm of the determinant of the covariance, as far as it is determined.
fn uncertainty(found: &Calibration) -> f64 {
    -2.0 * found.singular_values.iter().filter(|value| **value > 0.0).map(|value| value.ln()).sum::<f64>()
}

#[test]
fn the_proposed_poses_are_feasible_at_what_the_control_indicates() {
    let (machine, random) = (Machine::verne(), &mut Random::new(40));
    for kind in Kind::ALL {
        let actual = deviating(random, &machine, 2.0);
        let exact = measured(random, (&machine, &actual), kind, 30);
        let found = calibration(&machine, &exact, &with_next(4)).unwrap();
        assert_eq!(found.next.len(), 4, "{kind:?}");
        for joints in &found.next {
            let offsets =
                [Parameter::o1, Parameter::o2, Parameter::o3].map(|offset| found.actual.value(offset));
            let rho = [0, 1, 2].map(|i| joints.rho[i] + offsets[i]);
            let posture = forward_working(&found.machine, rho).unwrap();
            assert!(Margins::of(&found.machine, &posture, joints.table).feasible(), "{kind:?}: {joints:?}");
            assert_eq!(joints.table.is_some(), kind == Kind::Part);
        }
    }
    let _ = part_working;
}

#[test]
fn they_tell_more_than_other_poses() {
    let (machine, random) = (Machine::verne(), &mut Random::new(41));
    let exact = ActualMachine::new(&machine, TOOL * machine.longest());
    for kind in [Kind::Tips, Kind::Tracker] {
        let first = poses(random, &machine, 15);
        let with = |more: &[[f64; 3]]| {
            let rho: Vec<_> = first.iter().chain(more).copied().collect();
            let plan = if kind == Kind::Tips { Plan::Tips } else { Plan::TrackerTips };
            calibration(&machine, &simulated(&exact, rho, &plan).unwrap(), &with_next(5)).unwrap()
        };
        let next: Vec<_> = with(&[]).next.iter().map(|joints| joints.rho).collect();
        let proposed = uncertainty(&with(&next));
        for _ in 0..20 {
            let others = poses(random, &machine, next.len());
            println!("{proposed} {}", uncertainty(&with(&others)));
            assert!(proposed < uncertainty(&with(&others)), "{kind:?}");
        }
    }
}

#[test]
fn they_determine_what_the_first_poses_leave_open() {
    let (machine, random) = (Machine::verne(), &mut Random::new(42));
    let exact = ActualMachine::new(&machine, TOOL * machine.longest());
    let first = poses(random, &machine, 2);
    let measurements = simulated(&exact, first.clone(), &Plan::Tips).unwrap();
    let few = calibration(&machine, &measurements, &with_next(3)).unwrap();
    assert_eq!(few.rank, 6);
    let rho = first.into_iter().chain(few.next.iter().map(|joints| joints.rho)).collect();
    let more = calibration(&machine, &simulated(&exact, rho, &Plan::Tips).unwrap(), &with_next(0)).unwrap();
    assert_eq!((more.rank, more.next.len()), (13, 0));
}

#[test]
fn a_ball_bar_is_proposed_at_its_length() {
    let (machine, random) = (Machine::verne(), &mut Random::new(43));
    let exact = ActualMachine::new(&machine, TOOL * machine.longest());
    let rho = poses(random, &machine, 30);
    let of_bar = plan(random, &machine, Kind::BallBar, &rho);
    let found = calibration(&machine, &simulated(&exact, rho, &of_bar).unwrap(), &with_next(6)).unwrap();
    let next = found.next.iter().map(|joints| joints.rho).collect();
    let verne_solver::calibration::Observed::BallBar { lengths, .. } =
        simulated(&exact, next, &of_bar).unwrap().observed
    else {
        panic!("a ball bar")
    };
    assert!(lengths.iter().all(|length| (length - lengths[0]).abs() < 1e-6), "{lengths:?}");
}
