//! Preimages and windings of whole programs.

use std::f64::consts::PI;

use verne_solver::axis::tool_axis;
use verne_solver::toolpath::{Motion, MotionKind, PlanOptions, RowKind};
use verne_solver::{Constraint, Machine, Margins, PartPose, TableAngles, part_working};

use super::origins::is_feasible;
use super::placement::contour;
use super::random::Random;
use super::support::{arrive, feed, planned, rapid, worst_deviation};

pub(crate) fn tilted(tilt: f64, azimuth: f64) -> [f64; 3] {
    tool_axis(tilt.to_radians(), azimuth.to_radians())
}

/// A helix: the axis turns about the vertical.
pub(crate) fn helix(from: f64, to: f64) -> Vec<Motion> {
    let count = ((to - from).abs() / 6.0).ceil() as i32;
    let at = |i: i32| {
        let azimuth = from + (to - from) * f64::from(i) / f64::from(count);
        let (sin, cos) = azimuth.to_radians().sin_cos();
        ([40.0 * cos, 40.0 * sin, 300.0 + f64::from(i) * 0.2], tilted(10.0, azimuth))
    };
    let (tip, axis) = at(0);
    let mut program = vec![arrive(tip, axis)];
    program.extend((1..=count).map(|i| feed(at(i).0, at(i).1)));
    program
}

#[test]
fn a_cut_starts_on_the_winding_that_serves_all_of_it() {
    let (report, rows) = planned(&Machine::verne(), &helix(-270.0, 342.0), &PlanOptions::default());
    assert!(report.is_feasible(), "{:?}", report.failures.first());
    let theta2 = [rows.first(), rows.last()].map(|row| row.unwrap().table.theta2.to_degrees());
    assert!((theta2[0] - 270.0).abs() < 1e-6 && (theta2[1] + 342.0).abs() < 1e-6, "{theta2:?}");
    let steps = rows.windows(2).map(|pair| (pair[1].table.theta2 - pair[0].table.theta2).abs());
    assert!(steps.fold(0.0, f64::max) < 0.2, "theta2 jumps");
}

#[test]
fn a_cut_of_too_many_turns_fails_at_the_rotary_limit() {
    let (report, _) = planned(&Machine::verne(), &helix(0.0, 900.0), &PlanOptions::default());
    assert!(!report.is_feasible());
    assert!(report.failures.iter().all(|failure| failure.margin.constraint == Constraint::Rotary));
    let worst = report.failures[0].margin.value.to_degrees();
    assert!((worst + 180.0).abs() < 1e-6 || (worst + 90.0).abs() < 1e-6, "{worst}: 900° in a range of 720°");
}

/// A machine controller would turn by 359° between rows that are 1° apart.
#[test]
fn theta2_passes_half_a_turn_without_a_jump() {
    let program: Vec<_> = (0..20)
        .map(|i| {
            let axis = tilted(12.0, 171.0 + f64::from(i));
            let tip = [f64::from(i), 0.0, 300.0];
            if i == 0 { arrive(tip, axis) } else { feed(tip, axis) }
        })
        .collect();
    let (report, rows) = planned(&Machine::verne(), &program, &PlanOptions::default());
    assert!(report.is_feasible());
    let turning = report.turning[1].to_degrees();
    assert!((turning - 19.0).abs() < 1e-6, "{turning}");
    assert!(rows.iter().all(|row| row.kind != RowKind::Turn));
}

#[test]
fn minus_zero_and_tiny_numbers_choose_the_same_joints() {
    let rows = |i: f64, j: f64| {
        let program = [arrive([10.0, 0.0, 300.0], [i, j, 1.0]), feed([20.0, 0.0, 300.0], [i, j + 0.01, 1.0])];
        planned(&Machine::verne(), &program, &PlanOptions::default()).1
    };
    let expected = rows(0.0, 0.2);
    for (i, j) in [(-0.0, 0.2), (1e-17, 0.2), (-1e-17, 0.2)] {
        let found = rows(i, j);
        assert_eq!(found.len(), expected.len());
        for (a, b) in found.iter().zip(&expected) {
            assert!((a.table.theta2 - b.table.theta2).abs() < 1e-9, "{i}, {j}");
        }
    }
}

/// All choices of half turns for each run of motions between rapids, with their turning; infeasible ones count first.
fn brute_force(machine: &Machine, program: &[Motion]) -> (f64, f64) {
    let mut best = (f64::INFINITY, f64::INFINITY);
    let runs = 1 + program.iter().filter(|motion| motion.kind == MotionKind::Rapid).count();
    for number in 0..5_usize.pow(runs as u32) {
        let digit = |run: usize| (number / 5_usize.pow(run as u32) % 5) as i32 - 2;
        let mut run = 0;
        let mut phi2: Option<f64> = None;
        let mut cost = (0.0, 0.0);
        let mut before: Option<TableAngles> = None;
        for (index, motion) in program.iter().enumerate() {
            run += usize::from(index > 0 && motion.kind == MotionKind::Rapid);
            let [i, j, k] = motion.end.axis;
            let azimuth = i.atan2(-j);
            let continued = phi2.map_or(azimuth, |before| azimuth + PI * ((before - azimuth) / PI).round());
            phi2 = Some(continued);
            let phi2 = continued + PI * f64::from(digit(run));
            let phi1 = (i * phi2.sin() - j * phi2.cos()).atan2(k);
            let [x, y, z] = motion.end.tip;
            let target = PartPose { x, y, z, phi1, phi2 };
            let Ok(posture) = part_working(machine, &target, motion.tool_length) else {
                cost.0 += 1.0;
                continue;
            };
            let table = TableAngles { theta1: posture.pose.alpha - phi1, theta2: -phi2 };
            if !Margins::of(machine, &posture, Some(table)).feasible() {
                cost.0 += 1.0;
            }
            if let Some(before) = before {
                cost.1 += (table.theta1 - before.theta1).abs() + (table.theta2 - before.theta2).abs();
            }
            before = Some(table);
        }
        if cost < best {
            best = cost;
        }
    }
    best
}

#[test]
fn the_choice_equals_brute_force_over_all_combinations() {
    let machine = Machine::verne();
    let mut random = Random::new(7);
    let mut feasible = 0;
    for _ in 0..60 {
        let mut axis = [random.between(10.0, 30.0), random.between(-180.0, 180.0)];
        let mut tip =
            [random.between(-60.0, 60.0), random.between(-60.0, 60.0), random.between(250.0, 350.0)];
        let mut program = vec![arrive(tip, tilted(axis[0], axis[1]))];
        for i in 0..9 {
            let is_rapid = i % 3 == 2;
            let reach = if is_rapid { 170.0 } else { 5.0 };
            axis[1] += random.between(-reach, reach);
            axis[0] = (axis[0] + random.between(-2.0, 2.0)).clamp(10.0, 30.0);
            tip = tip.map(|c| c + random.between(-5.0, 5.0));
            let motion = if is_rapid { rapid } else { feed };
            program.push(motion(tip, tilted(axis[0], axis[1])));
        }
        let (report, rows) = planned(&machine, &program, &PlanOptions::default());
        let (failing, turning) = brute_force(&machine, &program);
        assert_eq!(report.is_feasible(), failing == 0.0);
        if failing > 0.0 {
            continue;
        }
        feasible += 1;
        let ends: Vec<_> = (0..program.len())
            .map(|index| rows.iter().rev().find(|row| row.motion == index).unwrap().table)
            .collect();
        let found: f64 = ends
            .windows(2)
            .map(|pair| (pair[1].theta1 - pair[0].theta1).abs() + (pair[1].theta2 - pair[0].theta2).abs())
            .sum();
        assert!((found - turning).abs() < 1e-6, "{found} instead of {turning}");
    }
    assert!(feasible > 30, "{feasible}");
}

#[test]
fn rows_of_random_programs_stay_within_the_tolerance() {
    let machine = Machine::verne();
    let mut random = Random::new(11);
    for _ in 0..6 {
        let mut axis = [random.between(-25.0, 25.0), random.between(-180.0, 180.0)];
        let mut tip =
            [random.between(-60.0, 60.0), random.between(-60.0, 60.0), random.between(250.0, 350.0)];
        let mut program = vec![arrive(tip, tilted(axis[0], axis[1]))];
        for _ in 0..6 {
            axis = [
                (axis[0] + random.between(-15.0, 15.0)).clamp(-25.0, 25.0),
                axis[1] + random.between(-40.0, 40.0),
            ];
            tip = tip.map(|c| c + random.between(-30.0, 30.0));
            program.push(feed(tip, tilted(axis[0], axis[1])));
        }
        let options = PlanOptions::default();
        let (report, rows) = planned(&machine, &program, &options);
        if !report.is_feasible() {
            continue;
        }
        let worst = worst_deviation(&machine, &program, &rows, &options);
        assert!(worst <= 1.0, "{worst} of the tolerance");
    }
}

#[test]
fn a_limit_that_is_broken_between_distant_places_decides_the_choice() {
    // At each of these origins a preimage keeps the limits at the ends of all motions, and breaks a stroke by some
    // millimetres between: on a feed motion in the first, on the line of the rapid in the second. Another choice
    // serves the whole program.
    for origin in [[103.896, 278.710, 322.158], [131.874_477, -256.344_062, 522.433_402]] {
        assert!(is_feasible(&Machine::verne(), &contour(), origin), "{origin:?}");
    }
}
