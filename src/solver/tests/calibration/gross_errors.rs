//! Gross errors in measurements.

use verne_solver::Machine;
use verne_solver::calibration::{Calibration, CalibrationOptions, Loss, Measurements, Observed};
use verne_solver::parameter::ActualMachine;

use crate::bench::{Kind, calibration, deviating, measured, normal, with_noise, with_sigma};
use crate::random::Random;

const SIGMA: f64 = 0.002;
const POSES: usize = 60;

/// Adds an error to some measurements: their indices in ascending order.
fn spoiled(random: &mut Random, measurements: &mut Measurements, size: f64) -> Vec<usize> {
    let mut wrong: Vec<usize> = (0..5).map(|i| 11 * i + (random.bits() % 11) as usize).collect();
    wrong.dedup();
    for &i in &wrong {
        let mut error = || size * (1.0 + random.fraction()) * normal(random).signum();
        match &mut measurements.observed {
            Observed::Tips(tips) | Observed::TrackerTips(tips) => tips[i][i % 3] += error(),
            Observed::PartTips(tips) => tips[i].tip[i % 3] += error(),
            Observed::Distances(distances) => distances[i].length += error(),
            Observed::BallBar { lengths, .. } => lengths[i] += error(),
        }
    }
    wrong
}

fn robust(sigma: Option<f64>) -> CalibrationOptions {
    CalibrationOptions { loss: Loss::Huber, sigma, ..CalibrationOptions::default() }
}

fn reported(found: &Calibration) -> Vec<usize> {
    let mut found: Vec<_> = found.outliers.iter().map(|outlier| outlier.measurement).collect();
    found.sort_unstable();
    found
}

/// The worst ratio of an error to its standard deviation.
fn worst(found: &Calibration, actual: &ActualMachine) -> f64 {
    let identifiable = found.estimates.iter().filter(|estimate| estimate.identifiable);
    let ratio = identifiable
        .map(|estimate| (estimate.value - actual.value(estimate.parameter)).abs() / estimate.sigma.unwrap());
    ratio.fold(0.0, f64::max)
}

#[test]
fn outliers_are_found_and_hardly_change_the_answer() {
    let (machine, random) = (Machine::verne(), &mut Random::new(30));
    for kind in [Kind::Tips, Kind::Tracker, Kind::Part, Kind::Distances] {
        for size in [0.04, 1.0, 100.0] {
            for sigma in [Some(SIGMA), None] {
                let actual = deviating(random, &machine, 1.0);
                let exact = measured(random, (&machine, &actual), kind, POSES);
                let mut noisy = with_noise(random, SIGMA, exact);
                let wrong = spoiled(random, &mut noisy, size);
                let found = calibration(&machine, &noisy, &robust(sigma)).unwrap();
                println!(
                    "{kind:?} {size} {sigma:?} {wrong:?}: sigma {:?} steps {} {:?}",
                    found.sigma,
                    found.steps,
                    found.outliers.iter().map(|o| (o.measurement, o.ratio)).collect::<Vec<_>>()
                );
                let reported = reported(&found);
                assert!(
                    wrong.iter().all(|i| reported.contains(i)),
                    "{kind:?} {size}: {wrong:?}, {reported:?}"
                );
                assert!(reported.len() <= wrong.len() + 1, "{kind:?} {size}: {wrong:?}, {reported:?}");
                let worst = worst(&found, &actual);
                assert!(worst < 5.0, "{kind:?} {size} {sigma:?}: {worst}");
                let first = found.outliers[0];
                assert!(wrong.contains(&first.measurement) && first.residual > 0.5 * size);
            }
        }
    }
}

#[test]
fn squares_are_spoiled_where_the_robust_loss_is_not() {
    let (machine, random) = (Machine::verne(), &mut Random::new(31));
    let actual = deviating(random, &machine, 1.0);
    let exact = measured(random, (&machine, &actual), Kind::Tips, POSES);
    let mut noisy = with_noise(random, SIGMA, exact);
    spoiled(random, &mut noisy, 1.0);
    let squares = calibration(&machine, &noisy, &with_sigma(SIGMA)).unwrap();
    let huber = calibration(&machine, &noisy, &robust(Some(SIGMA))).unwrap();
    assert!(worst(&squares, &actual) > 10.0 * worst(&huber, &actual));
}

#[test]
fn good_measurements_have_no_outliers() {
    let (machine, random) = (Machine::verne(), &mut Random::new(32));
    let mut reports = 0;
    for run in 0..100 {
        let actual = deviating(random, &machine, 0.5);
        let exact = measured(random, (&machine, &actual), Kind::ALL[run % 5], POSES);
        let noisy = with_noise(random, SIGMA, exact);
        reports +=
            usize::from(!calibration(&machine, &noisy, &with_sigma(SIGMA)).unwrap().outliers.is_empty());
    }
    assert!(reports <= 4, "{reports} of 100, of which 1 is expected");
}
