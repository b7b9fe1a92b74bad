//! Measurements that have no answer.

use verne_solver::Machine;
use verne_solver::calibration::{
    CalibrationError, CalibrationOptions, Measurements, Observed, TipDistance, calibrated,
};
use verne_solver::workspace::Observer;

use crate::bench::{Kind, calibration, deviating, measured, with_sigma};
use crate::random::Random;

fn error(measurements: &Measurements) -> CalibrationError {
    calibration(&Machine::verne(), measurements, &with_sigma(0.002)).unwrap_err()
}

#[test]
fn lists_that_do_not_fit_are_refused() {
    let rho = vec![[600.0, 500.0, 500.0], [650.0, 480.0, 520.0]];
    let distance = |poses| Observed::Distances(vec![TipDistance { poses, length: 1.0 }]);
    for observed in [
        Observed::Tips(vec![]),
        Observed::Tips(vec![[0.0; 3]]),
        Observed::BallBar { centre: None, lengths: vec![1.0; 3] },
        distance([0, 2]),
        distance([1, 1]),
    ] {
        let refused = error(&Measurements { rho: rho.clone(), observed });
        assert!(matches!(refused, CalibrationError::Inconsistent(_)), "{refused}");
    }
}

#[test]
fn a_pose_that_the_machine_does_not_reach_is_named() {
    let rho = vec![[600.0, 500.0, 500.0], [600.0, 5000.0, 500.0]];
    let refused = error(&Measurements { rho, observed: Observed::Tips(vec![[0.0, 0.0, 1400.0]; 2]) });
    assert!(matches!(refused, CalibrationError::NoPosture { pose: 1, .. }), "{refused}");
    assert!(refused.to_string().contains("pose 1"));
}

#[test]
fn measurements_of_another_machine_end_with_an_error_or_a_machine() {
    // Points without any relation to the poses.
    let random = &mut Random::new(50);
    for _ in 0..30 {
        let machine = Machine::verne();
        let actual = deviating(random, &machine, 0.1);
        let mut measurements = measured(random, (&machine, &actual), Kind::Tips, 20);
        if let Observed::Tips(tips) = &mut measurements.observed {
            tips.iter_mut().flatten().for_each(|number| *number += random.between(-400.0, 400.0));
        }
        match calibration(&machine, &measurements, &with_sigma(0.002)) {
            Ok(found) => assert!(found.rms > 10.0, "{}", found.rms),
            Err(CalibrationError::NotConverged { weakest, .. }) => assert!(!weakest.is_empty()),
            Err(CalibrationError::OutOfMode { .. }) => {}
            Err(other) => panic!("{other}"),
        }
    }
}

struct Impatient;

impl Observer for Impatient {
    fn progress(&self, _: f64) {}

    fn cancelled(&self) -> bool {
        true
    }
}

#[test]
fn the_observer_stops_the_computation() {
    let (machine, random) = (Machine::verne(), &mut Random::new(51));
    let actual = deviating(random, &machine, 0.1);
    let measurements = measured(random, (&machine, &actual), Kind::Tips, 20);
    let found = calibrated(&machine, 105.0, &measurements, &CalibrationOptions::default(), &Impatient);
    assert_eq!(found.unwrap_err(), CalibrationError::Cancelled);
}
