//! Known parameters are found again.

use verne_solver::Machine;
use verne_solver::calibration::{CalibrationError, CalibrationOptions, Loss};
use verne_solver::parameter::{ActualMachine, Parameter};

use crate::bench::{Kind, POSES, Shares, calibration, deviating, measured, with_noise, with_sigma};
use crate::machines;
use crate::random::Random;

/// Standard deviation of a measured number, mm.
const SIGMA: f64 = 0.002;

#[test]
fn every_parameter_is_within_three_standard_deviations_in_99_of_100_runs() {
    let (machine, random) = (Machine::verne(), &mut Random::new(10));
    for kind in Kind::ALL {
        let runs = if kind == Kind::Tips { 1000 } else { 300 };
        let mut shares = Shares::default();
        for _ in 0..runs {
            let actual = deviating(random, &machine, 0.5);
            let exact = measured(random, (&machine, &actual), kind, POSES);
            let noisy = with_noise(random, SIGMA, exact);
            shares.add(&calibration(&machine, &noisy, &with_sigma(SIGMA)).unwrap(), &actual);
        }
        // Of 300 runs a single parameter may miss four by chance.
        let least = if runs == 1000 { 0.99 } else { 0.98 };
        assert!(shares.least() >= least, "{kind}: {}", shares.least());
        assert!(shares.of_all() >= 0.99, "{kind}: {}", shares.of_all());
    }
}

#[test]
fn a_start_of_five_millimetres_off_converges() {
    let (machine, random) = (Machine::verne(), &mut Random::new(11));
    for kind in Kind::ALL {
        for _ in 0..20 {
            let actual = deviating(random, &machine, 5.0);
            let exact = measured(random, (&machine, &actual), kind, POSES);
            let found = calibration(&machine, &exact, &CalibrationOptions::default()).unwrap();
            assert!(found.rms < 1e-9, "{kind:?}: {}", found.rms);
            for estimate in found.estimates.iter().filter(|estimate| estimate.identifiable) {
                let error = estimate.value - actual.value(estimate.parameter);
                assert!(error.abs() < 1e-5, "{kind:?}: {:?} is off by {error}", estimate.parameter);
            }
            assert!(found.steps < 30, "{kind:?}: {} steps", found.steps);
        }
    }
}

#[test]
fn the_answered_machine_measures_what_was_measured() {
    let (machine, random) = (Machine::verne(), &mut Random::new(12));
    let actual = deviating(random, &machine, 2.0);
    let exact = measured(random, (&machine, &actual), Kind::Tips, POSES);
    let found = calibration(&machine, &exact, &with_sigma(SIGMA)).unwrap();
    let offsets = [Parameter::o1, Parameter::o2, Parameter::o3].map(|offset| found.actual.value(offset));
    let tool_length = found.actual.value(Parameter::ToolLength);
    let verne_solver::calibration::Observed::Tips(tips) = &exact.observed else { panic!("tips") };
    for (rho, tip) in exact.rho.iter().zip(tips) {
        let rho = [0, 1, 2].map(|i| rho[i] + offsets[i]);
        let posture = verne_solver::forward_working(&found.machine, rho).unwrap();
        let point = verne_solver::tool_point(&posture.pose, tool_length);
        assert!((0..3).all(|i| (point[i] - tip[i]).abs() < 1e-6), "{point:?} and {tip:?}");
    }
    for (i, stroke) in found.machine.data().limits.stroke.iter().enumerate() {
        assert_eq!(*stroke, machine.data().limits.stroke[i].map(|end| end + offsets[i]));
    }
}

#[test]
fn machines_unlike_the_built_in_one_are_found_again() {
    let random = &mut Random::new(13);
    let (mut checked, mut open) = (0, 0);
    for run in 0..120 {
        let machine = if run % 2 == 0 { Some(random.machine()) } else { machines::random(random) };
        let Some(machine) = machine else { continue };
        let actual = deviating(random, &machine, 0.003 * machine.longest());
        let rho = crate::bench::poses(random, &machine, POSES);
        let is_reached = |rho: &[f64; 3]| {
            let pose = actual.platform(*rho).ok();
            pose.is_some_and(|pose| {
                let found = verne_solver::forward_working(&actual.machine().unwrap(), moved(&actual, *rho));
                found.is_ok_and(|posture| (posture.pose.z - pose.z).abs() < 1e-6 * machine.longest())
            })
        };
        let rho: Vec<_> = rho.into_iter().filter(is_reached).collect();
        if rho.len() < POSES / 2 {
            continue;
        }
        let kind = [Kind::Tips, Kind::Tracker, Kind::Part][run % 3];
        let plan = crate::bench::plan(random, &machine, kind, &rho);
        let exact = verne_solver::calibration::simulated(&actual, rho, &plan).unwrap();
        let sigma = 1e-6 * machine.longest();
        let noisy = with_noise(random, sigma, exact);
        let found = match calibration(&machine, &noisy, &with_sigma(sigma)) {
            Ok(found) => found,
            // Some machines hardly show a combination of their parameters.
            Err(CalibrationError::NotConverged { .. }) => {
                open += 1;
                continue;
            }
            Err(other) => panic!("{run} {kind:?}: {other}"),
        };
        assert!(found.rms < 1.3 * sigma, "{run} {kind:?}: {} of {sigma}", found.rms);
        let all: Vec<_> = found.estimates.iter().filter(|estimate| estimate.identifiable).collect();
        let is_near = |estimate: &&&verne_solver::calibration::Estimate| {
            let error = estimate.value - actual.value(estimate.parameter);
            error.abs() <= 4.0 * estimate.sigma.unwrap()
        };
        assert!(all.iter().filter(is_near).count() + 1 >= all.len(), "{run} {kind:?}");
        checked += 1;
    }
    assert!(checked > 50 && open < 4, "{checked} and {open}");
}

/// Where the sliders stand at what the control indicates.
fn moved(actual: &ActualMachine, rho: [f64; 3]) -> [f64; 3] {
    let offsets = [Parameter::o1, Parameter::o2, Parameter::o3].map(|offset| actual.value(offset));
    [0, 1, 2].map(|i| rho[i] + offsets[i])
}

#[test]
fn a_linear_delta_keeps_its_equal_distances() {
    let (machine, random) = (Machine::linear_delta(), &mut Random::new(14));
    let changes = Parameter::ALL.into_iter().filter(|p| !matches!(p, Parameter::R1 | Parameter::r1));
    let changes: Vec<_> = changes.map(|parameter| (parameter, random.between(-0.3, 0.3))).collect();
    let tool_length = crate::bench::TOOL * machine.longest();
    let actual = ActualMachine::new(&machine, tool_length).with(changes);
    let exact = measured(random, (&machine, &actual), Kind::Tips, POSES);
    let found = calibration(&machine, &exact, &with_sigma(SIGMA)).unwrap();
    let is_held = |parameter| !found.estimates.iter().any(|estimate| estimate.parameter == parameter);
    assert!(is_held(Parameter::R1) && is_held(Parameter::r1));
    assert!(found.rms < 1e-6, "{}", found.rms);
    let geometry = found.machine.data().geometry;
    assert_eq!(geometry.R1, geometry.r1);
    // The platform does not incline: R2 and r4 matter by their difference, the tool's length by that of its end.
    let names: Vec<Vec<_>> = found
        .unidentifiable
        .iter()
        .map(|combination| combination.iter().map(|(unknown, _)| unknown.name()).collect())
        .collect();
    assert_eq!(names, [vec!["R2", "r4"], vec!["o1", "o2", "o3", "tool_length"]]);
}

#[test]
fn the_accuracy_follows_from_the_residuals() {
    let (machine, random) = (Machine::verne(), &mut Random::new(15));
    for loss in [Loss::Squares, Loss::Huber] {
        let actual = deviating(random, &machine, 0.5);
        let exact = measured(random, (&machine, &actual), Kind::Tips, 300);
        let noisy = with_noise(random, SIGMA, exact);
        let options = CalibrationOptions { loss, ..CalibrationOptions::default() };
        let sigma = calibration(&machine, &noisy, &options).unwrap().sigma.unwrap();
        assert!((sigma / SIGMA - 1.0).abs() < 0.15, "{loss:?}: {sigma}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_answer() {
    let (machine, random) = (Machine::verne(), &mut Random::new(16));
    let actual = deviating(random, &machine, 0.5);
    let exact = measured(random, (&machine, &actual), Kind::Tracker, 500);
    let noisy = with_noise(random, SIGMA, exact);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let options = CalibrationOptions { next: 3, ..with_sigma(SIGMA) };
        pool.install(|| calibration(&machine, &noisy, &options)).unwrap()
    };
    assert_eq!(on(1), on(3));
}
