//! Fixed parameters, priors and bounds.

use verne_solver::Machine;
use verne_solver::calibration::{Calibration, CalibrationOptions, Estimate, Prior};
use verne_solver::parameter::Parameter;

use crate::bench::{Kind, POSES, calibration, deviating, measured, with_noise, with_sigma};
use crate::random::Random;

const SIGMA: f64 = 0.002;

fn estimate(found: &Calibration, parameter: Parameter) -> &Estimate {
    found.estimates.iter().find(|estimate| estimate.parameter == parameter).unwrap()
}

#[test]
fn a_fixed_parameter_keeps_its_value_and_the_others_gain() {
    let (machine, random) = (Machine::verne(), &mut Random::new(20));
    let actual = deviating(random, &machine, 0.5).with([(Parameter::R1, 0.0)]);
    let actual = actual.with([(Parameter::R1, -actual.change(Parameter::R1))]);
    let exact = measured(random, (&machine, &actual), Kind::Tips, POSES);
    let noisy = with_noise(random, SIGMA, exact);
    let free = calibration(&machine, &noisy, &with_sigma(SIGMA)).unwrap();
    let options = CalibrationOptions { fixed: vec![Parameter::R1], ..with_sigma(SIGMA) };
    let held = calibration(&machine, &noisy, &options).unwrap();
    assert!(held.estimates.iter().all(|estimate| estimate.parameter != Parameter::R1));
    assert_eq!(held.actual.value(Parameter::R1), 275.0);
    for parameter in [Parameter::r1, Parameter::L1, Parameter::o1] {
        let [with, without] = [&held, &free].map(|found| estimate(found, parameter).sigma.unwrap());
        assert!(with < 0.9 * without, "{parameter:?}: {with} and {without}");
    }
}

#[test]
fn a_prior_decides_what_the_measurements_leave_open() {
    let (machine, random) = (Machine::verne(), &mut Random::new(21));
    let actual = deviating(random, &machine, 0.5);
    let exact = measured(random, (&machine, &actual), Kind::Distances, POSES);
    let noisy = with_noise(random, SIGMA, exact);
    let priors = [(Parameter::e1, 0.05), (Parameter::o1, 0.01)].map(|(parameter, sigma)| Prior {
        parameter,
        value: actual.value(parameter),
        sigma,
    });
    let options = CalibrationOptions { priors: priors.to_vec(), ..with_sigma(SIGMA) };
    let found = calibration(&machine, &noisy, &options).unwrap();
    assert_eq!(found.rank, 11, "priors are no measurements");
    for prior in priors {
        let estimate = estimate(&found, prior.parameter);
        assert!(!estimate.identifiable);
        assert!((estimate.value - prior.value).abs() < 1e-6, "{estimate:?}");
        assert!((estimate.sigma.unwrap() / prior.sigma - 1.0).abs() < 1e-6, "{estimate:?}");
    }
    for parameter in [Parameter::e2, Parameter::o2, Parameter::o3] {
        let estimate = estimate(&found, parameter);
        let error = estimate.value - actual.value(parameter);
        assert!(error.abs() < 4.0 * estimate.sigma.unwrap(), "{estimate:?} is off by {error}");
    }
}

#[test]
fn a_prior_and_measurements_share_their_weights() {
    let (machine, random) = (Machine::verne(), &mut Random::new(22));
    let actual = deviating(random, &machine, 0.5);
    let exact = measured(random, (&machine, &actual), Kind::Tips, POSES);
    let noisy = with_noise(random, SIGMA, exact);
    let alone = calibration(&machine, &noisy, &with_sigma(SIGMA)).unwrap();
    let measured = estimate(&alone, Parameter::R1);
    let (by_measurement, deviation) = (measured.value, measured.sigma.unwrap());
    let prior = Prior { parameter: Parameter::R1, value: by_measurement + deviation, sigma: deviation };
    let options = CalibrationOptions { priors: vec![prior], ..with_sigma(SIGMA) };
    let both = calibration(&machine, &noisy, &options).unwrap();
    let shared = estimate(&both, Parameter::R1);
    assert!((shared.value - by_measurement - 0.5 * deviation).abs() < 0.01 * deviation, "{shared:?}");
    assert!((shared.sigma.unwrap() - deviation / 2.0_f64.sqrt()).abs() < 0.01 * deviation, "{shared:?}");
}

#[test]
fn a_bound_holds_and_says_so() {
    let (machine, random) = (Machine::verne(), &mut Random::new(23));
    let actual = deviating(random, &machine, 0.1).with([(Parameter::L2, 1.0)]);
    let exact = measured(random, (&machine, &actual), Kind::Tips, POSES);
    let bounds = vec![(Parameter::L2, [1049.5, 1050.25]), (Parameter::L3, [1040.0, 1060.0])];
    let options = CalibrationOptions { bounds, ..with_sigma(SIGMA) };
    let found = calibration(&machine, &exact, &options).unwrap();
    let [bound, free] = [Parameter::L2, Parameter::L3].map(|parameter| estimate(&found, parameter));
    assert!(bound.at_bound && bound.sigma.is_none() && (bound.value - 1050.25).abs() < 1e-9, "{bound:?}");
    assert!(!free.at_bound && free.sigma.is_some());
    assert!(found.rms > 0.01, "{}", found.rms);
    // The rest is the best for this length: the same as with the length fixed.
    let mut data = machine.data().clone();
    data.geometry.L2 = bound.value;
    let machine = Machine::new(data).unwrap();
    let options = CalibrationOptions { fixed: vec![Parameter::L2], ..with_sigma(SIGMA) };
    let fixed = calibration(&machine, &exact, &options).unwrap();
    for of_fixed in &fixed.estimates {
        let of_bound = estimate(&found, of_fixed.parameter);
        let difference = of_fixed.value - of_bound.value;
        assert!(difference.abs() < 0.05 * of_bound.sigma.unwrap(), "{of_bound:?} and {of_fixed:?}");
    }
}

#[test]
fn what_nothing_decides_stays_nearest_to_the_start() {
    let (machine, random) = (Machine::verne(), &mut Random::new(24));
    for kind in [Kind::Distances, Kind::Tracker, Kind::BallBarAnywhere] {
        let actual = deviating(random, &machine, 0.5);
        let exact = measured(random, (&machine, &actual), kind, 60);
        let found = calibration(&machine, &exact, &with_sigma(SIGMA)).unwrap();
        for group in [&[Parameter::e1, Parameter::e2][..], &[Parameter::o1, Parameter::o2, Parameter::o3]] {
            let shift: f64 = group.iter().map(|parameter| found.actual.change(*parameter)).sum();
            assert!(shift.abs() < 1e-6, "{kind:?}: {group:?} together {shift}");
        }
    }
}
