//! What each kind of measurement identifies.

use verne_solver::Machine;
use verne_solver::calibration::{Calibration, Measurements, Observed, Plan, Unknown, simulated};
use verne_solver::parameter::ActualMachine;

use crate::bench::{Kind, TOOL, calibration, measured, with_sigma};
use crate::random::Random;

fn exact(machine: &Machine) -> ActualMachine {
    ActualMachine::new(machine, TOOL * machine.longest())
}

/// The calibration of a machine with measurements of its own.
fn planned(random: &mut Random, machine: &Machine, kind: Kind, count: usize) -> (Measurements, Calibration) {
    let measurements = measured(random, (machine, &exact(machine)), kind, count);
    let found = calibration(machine, &measurements, &with_sigma(1e-6 * machine.longest())).unwrap();
    (measurements, found)
}

fn names(found: &Calibration) -> Vec<Vec<(&'static str, f64)>> {
    let round = |amount: f64| (1e6 * amount).round() / 1e6;
    let named = |(unknown, amount): &(Unknown, f64)| (unknown.name(), round(*amount));
    found.unidentifiable.iter().map(|combination| combination.iter().map(named).collect()).collect()
}

#[test]
fn the_ranks_of_the_built_in_machine() {
    let random = &mut Random::new(1);
    let (e, o) = ([("e1", 1.0), ("e2", 1.0)], [("o1", 1.0), ("o2", 1.0), ("o3", 1.0)]);
    let shifts = |x: Option<(&'static str, f64)>, z: Option<(&'static str, f64)>| {
        vec![e.into_iter().chain(x).collect::<Vec<_>>(), o.into_iter().chain(z).collect()]
    };
    let table = [
        (Kind::Tips, 13, 13, vec![]),
        (Kind::Tracker, 17, 19, shifts(Some(("frame.x", -1.0)), Some(("frame.z", 1.0)))),
        (Kind::Part, 21, 23, shifts(Some(("rotary_axis_x", -1.0)), Some(("da", 1.0)))),
        (Kind::Distances, 11, 13, shifts(None, None)),
        (Kind::BallBar, 13, 13, vec![]),
        (Kind::BallBarAnywhere, 14, 16, shifts(Some(("centre.x", -1.0)), Some(("centre.z", 1.0)))),
    ];
    for (kind, rank, unknowns, unidentifiable) in table {
        let (_, found) = planned(random, &Machine::verne(), kind, 400);
        assert_eq!((found.rank, found.singular_values.len()), (rank, unknowns), "{kind:?}");
        assert_eq!(names(&found), unidentifiable, "{kind:?}");
        for estimate in &found.estimates {
            let occurs = unidentifiable.iter().flatten().any(|(name, _)| *name == estimate.parameter.name());
            assert_eq!(estimate.identifiable, !occurs, "{kind:?}: {:?}", estimate.parameter);
            assert_eq!(estimate.sigma.is_some(), !occurs, "{kind:?}: {:?}", estimate.parameter);
            assert!((estimate.value - estimate.start).abs() < 1e-9, "{kind:?}: {estimate:?}");
        }
    }
}

#[test]
fn tips_determine_the_weakest_combination_a_thousand_times_less_than_the_strongest() {
    let (_, found) = planned(&mut Random::new(2), &Machine::verne(), Kind::Tips, 400);
    let ratio = found.singular_values[0] / found.singular_values[12];
    assert!((500.0..2000.0).contains(&ratio), "{ratio}");
}

#[test]
fn what_cannot_be_identified_changes_no_measurement() {
    let random = &mut Random::new(3);
    for run in 0..40 {
        let machine = random.machine();
        let [tool, of_exact] = [TOOL * machine.longest(), 1e-3 * machine.longest()];
        let kind = Kind::ALL[run % Kind::ALL.len()];
        let rho = crate::bench::poses(random, &machine, 12);
        // Far from home such a machine may have no feasible pose.
        if rho.len() < 12 {
            continue;
        }
        let plan = crate::bench::plan(random, &machine, kind, &rho);
        let measurements = simulated(&exact(&machine), rho.clone(), &plan).unwrap();
        let found = calibration(&machine, &measurements, &with_sigma(of_exact)).unwrap();
        for combination in &found.unidentifiable {
            let is_of_device =
                combination.iter().any(|(unknown, _)| !matches!(unknown, Unknown::Parameter(_)));
            if is_of_device {
                continue;
            }
            let step = 1e-4 * machine.longest();
            let changes = combination.iter().filter_map(|(unknown, amount)| match unknown {
                Unknown::Parameter(parameter) => Some((*parameter, step * amount)),
                _ => None,
            });
            let changed = ActualMachine::new(&machine, tool).with(changes);
            let again = simulated(&changed, rho.clone(), &plan).unwrap();
            // To the first order: what is left is the square of the step.
            let most = 1e-6 * machine.longest();
            for (a, b) in numbers(&measurements).zip(numbers(&again)) {
                assert!((a - b).abs() < most, "{kind:?}: {} of {most}, {:?}", (a - b).abs(), names(&found));
            }
        }
    }
}

fn numbers(measurements: &Measurements) -> Box<dyn Iterator<Item = f64> + '_> {
    match &measurements.observed {
        Observed::Tips(tips) | Observed::TrackerTips(tips) => Box::new(tips.iter().flatten().copied()),
        Observed::PartTips(tips) => Box::new(tips.iter().flat_map(|at| at.tip)),
        Observed::Distances(distances) => Box::new(distances.iter().map(|at| at.length)),
        Observed::BallBar { lengths, .. } => Box::new(lengths.iter().copied()),
    }
}

#[test]
fn the_rank_does_not_depend_on_the_accuracy() {
    let machine = Machine::verne();
    let random = &mut Random::new(4);
    let measurements = measured(random, (&machine, &exact(&machine)), Kind::Distances, 60);
    for sigma in [1e-9, 1e-3, 1e3] {
        assert_eq!(calibration(&machine, &measurements, &with_sigma(sigma)).unwrap().rank, 11, "{sigma}");
    }
}

#[test]
fn poses_in_the_plane_of_symmetry_identify_less() {
    let machine = Machine::verne();
    let rho: Vec<_> = (0..60)
        .map(|i| {
            let side = 400.0 + 150.0 * (1.3 * f64::from(i)).sin();
            [450.0 + 150.0 * f64::from(i).sin(), side, side]
        })
        .collect();
    let measurements = simulated(&exact(&machine), rho, &Plan::Tips).unwrap();
    let found = calibration(&machine, &measurements, &with_sigma(0.002)).unwrap();
    // There R1 and r1, R2 and r4 matter by their differences alone, for the platform does not incline.
    assert!(found.rank < 13, "{}", found.rank);
    assert!(found.estimates.iter().any(|estimate| estimate.identifiable));
    assert_eq!(found.rank + found.unidentifiable.len(), 13);
}

#[test]
fn fewer_measurements_than_unknowns_leave_some_open() {
    let machine = Machine::verne();
    let (_, found) = planned(&mut Random::new(6), &machine, Kind::Tips, 3);
    assert_eq!((found.rank, found.unidentifiable.len()), (9, 4));
    assert!(found.outliers.is_empty());
}
