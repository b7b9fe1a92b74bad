//! Programs on machines unlike the reference machine, arcs with rotary words, and rapids.

use std::f64::consts::{PI, TAU};

use verne_solver::axis::tool_axis;
use verne_solver::toolpath::{Curve, Motion, MotionKind, PlanOptions, ToolPosition, Turning};
use verne_solver::{Machine, PartPose, part_working};

use super::choices::tilted;
use super::random::Random;
use super::support::{any_machine, arrive, feed, planned, rapid, worst_deviation};

#[test]
fn rows_stay_within_the_tolerance_on_any_machine() {
    let mut random = Random::new(23);
    let mut feasible = 0;
    for _ in 0..20 {
        let machine = any_machine(&mut random);
        let mut tip =
            [random.between(-60.0, 60.0), random.between(-60.0, 60.0), random.between(250.0, 350.0)];
        let mut axis = [random.between(2.0, 20.0), random.between(-180.0, 180.0)];
        let mut program = vec![arrive(tip, tilted(axis[0], axis[1]))];
        for _ in 0..3 {
            tip = tip.map(|c| c + random.between(-25.0, 25.0));
            axis = [
                (axis[0] + random.between(-8.0, 8.0)).clamp(2.0, 22.0),
                axis[1] + random.between(-30.0, 30.0),
            ];
            program.push(feed(tip, tilted(axis[0], axis[1])));
        }
        let options = PlanOptions::default();
        let (report, rows) = planned(&machine, &program, &options);
        if report.is_feasible() {
            feasible += 1;
            let worst = worst_deviation(&machine, &program, &rows, &options);
            assert!(worst <= 1.0, "{worst} of the tolerance");
        }
    }
    assert!(feasible >= 5, "{feasible}");
}

/// The axis and the circle keep together: each point of the arc has the azimuth of its own direction.
#[test]
fn an_arc_with_rotary_words_stays_within_the_tolerance() {
    let machine = Machine::verne();
    let on_circle = |angle: f64| [40.0 * angle.cos(), 40.0 * angle.sin(), 300.0];
    let words = |angle: f64| [0.2, angle + 0.5 * PI];
    let position = |angle: f64| {
        let [phi1, phi2] = words(angle);
        ToolPosition { tip: on_circle(angle), axis: tool_axis(phi1, phi2) }
    };
    let arc = |from: f64, to: f64| Motion {
        kind: MotionKind::Feed,
        end: position(to),
        curve: Curve::Arc { centre: [0.0, 0.0, 300.0], normal: [0.0, 0.0, 1.0], sweep: to - from },
        turning: Turning::Angles {
            start: words(from),
            end: words(to),
            frame: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        },
        tool_length: 100.0,
    };
    let program = [arrive(on_circle(0.0), position(0.0).axis), arc(0.0, 1.0), arc(1.0, TAU - 0.1)];
    let options = PlanOptions::default();
    let (report, rows) = planned(&machine, &program, &options);
    assert!(report.is_feasible(), "{:?}", report.failures.first());
    let worst = worst_deviation(&machine, &program, &rows, &options);
    assert!(worst <= 1.0, "{worst} of the tolerance");
    assert!((report.turning[1] - (TAU - 0.1)).abs() < 1e-6, "{}", report.turning[1]);
}

#[test]
fn a_dome_finished_in_a_raster_stays_within_the_tolerance() {
    let mut program = Vec::new();
    for line in 0..7 {
        for point in 0..9 {
            let along = if line % 2 == 0 { point } else { 8 - point };
            let [x, y] = [f64::from(along) * 15.0 - 60.0, f64::from(line) * 20.0 - 60.0];
            let z = (200.0_f64.powi(2) - x * x - y * y).sqrt();
            let motion = if line + point == 0 { arrive } else { feed };
            program.push(motion([x, y, z + 120.0], [x / 200.0, y / 200.0, z / 200.0]));
        }
    }
    let (machine, options) = (Machine::verne(), PlanOptions::default());
    let (report, rows) = planned(&machine, &program, &options);
    assert!(report.is_feasible(), "{:?}", report.failures.first());
    let worst = worst_deviation(&machine, &program, &rows, &options);
    assert!(worst <= 1.0, "{worst} of the tolerance");
}

/// With straight joints the tool's end would dip from 300 to 282.7 mm.
#[test]
fn a_level_rapid_does_not_dip_into_the_part() {
    let up = [0.0, 0.0, 1.0];
    let program = [arrive([-150.0, 0.0, 300.0], up), rapid([150.0, 0.0, 300.0], up)];
    let machine = Machine::verne();
    let (report, rows) = planned(&machine, &program, &PlanOptions::default());
    assert_eq!(report.departure_count, 0);
    assert!((4..=7).contains(&rows.len()), "{} rows for a tolerance of 1 mm", rows.len());
    let straight = PlanOptions { joint_rapids: true, ..PlanOptions::default() };
    let (report, _) = planned(&machine, &program, &straight);
    let departure = report.departures[0];
    assert!((300.0 - departure.distance.unwrap() - 282.7).abs() < 0.1, "{departure:?}");
    assert!(departure.direction[2] < -0.99, "{departure:?}");
}

/// The ends of motions are rows whose joints solve the inverse problem for the programmed pose.
#[test]
fn ends_of_motions_are_exact() {
    let machine = Machine::verne();
    let program = [
        arrive([-40.0, 10.0, 300.0], tilted(12.0, 20.0)),
        feed([30.0, 10.0, 310.0], tilted(15.0, 60.0)),
        feed([30.0, -20.0, 305.0], tilted(8.0, 90.0)),
    ];
    let (_, rows) = planned(&machine, &program, &PlanOptions::default());
    for (index, motion) in program.iter().enumerate() {
        let row = rows.iter().rev().find(|row| row.motion == index).unwrap();
        let phi2 = -row.table.theta2;
        let [i, j, k] = motion.end.axis;
        let [x, y, z] = motion.end.tip;
        let phi1 = (i * phi2.sin() - j * phi2.cos()).atan2(k);
        let exact = part_working(&machine, &PartPose { x, y, z, phi1, phi2 }, 100.0).unwrap();
        for i in 0..3 {
            assert!((row.rho[i] - exact.rho[i]).abs() < 1e-6, "slider {i} of motion {index}");
        }
    }
}
