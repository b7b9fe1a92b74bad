//! Paths along, through and to the pole.

use std::f64::consts::PI;

use verne_solver::axis::tool_axis;
use verne_solver::toolpath::{Deviation, Motion, PlanOptions, RowKind, Turning};
use verne_solver::{Constraint, Machine};

use super::random::Random;
use super::support::{arrive, feed, planned, rapid, worst_deviation};

const UP: [f64; 3] = [0.0, 0.0, 1.0];

fn tilted(tilt: f64, azimuth: f64) -> [f64; 3] {
    tool_axis(tilt.to_radians(), azimuth.to_radians())
}

fn check(program: &[Motion], options: &PlanOptions) -> (f64, usize) {
    let machine = Machine::verne();
    let (report, rows) = planned(&machine, program, options);
    assert!(report.is_feasible(), "{:?}", report.failures.first());
    let worst = worst_deviation(&machine, program, &rows, options);
    assert!(worst <= 1.0, "{worst} of the tolerance");
    let turns = rows.iter().filter(|row| row.kind == RowKind::Turn).count();
    (report.turning[1].to_degrees(), turns)
}

#[test]
fn a_path_over_the_pole_changes_the_sign_of_phi1() {
    for off in [0.0, 1e-9, 1e-7, 1e-6] {
        let program =
            [arrive([0.0, 0.0, 300.0], [off, -0.2, 1.0]), feed([20.0, 0.0, 300.0], [off, 0.2, 1.0])];
        let (turning, turns) = check(&program, &PlanOptions::default());
        assert!(turning < 1.0, "theta2 turns by {turning}° at {off}");
        assert_eq!(turns, 0);
    }
}

/// The axis is off the meridian by less than the cap.
#[test]
fn the_axis_deviates_by_its_part_off_the_meridian() {
    let off = [2e-5, -3e-5, 1.0];
    let program = [
        arrive([60.0, 0.0, 300.0], UP),
        feed([60.0, 0.0, 299.0], off),
        feed([60.0, 0.1, 299.0], off),
        feed([60.0, 0.2, 299.0], UP),
    ];
    let (machine, options) = (Machine::verne(), PlanOptions::default());
    let (report, rows) = planned(&machine, &program, &options);
    assert!(report.is_feasible() && report.turning[1] == 0.0);
    let tolerance = Deviation { tip: options.tolerance.tip, axis: report.deviation.axis };
    let within = PlanOptions { tolerance, ..options };
    assert!(worst_deviation(&machine, &program, &rows, &within) <= 1.0, "the figure is an upper bound");
    assert!((1.9e-5..2.5e-5).contains(&report.deviation.axis), "{:?}", report.deviation);
}

#[test]
fn noise_along_the_pole_does_not_turn_the_table() {
    let mut random = Random::new(3);
    let mut program = vec![arrive([0.0, 0.0, 300.0], UP)];
    for i in 1..200 {
        let axis = [random.between(-1e-7, 1e-7), random.between(-1e-7, 1e-7), 1.0];
        program.push(feed([f64::from(i) * 0.2, 0.0, 300.0], axis));
    }
    let (turning, turns) = check(&program, &PlanOptions::default());
    assert_eq!((turning, turns), (0.0, 0));
}

#[test]
fn a_vertical_approach_has_the_meridian_of_the_tilt_that_follows() {
    let program = [
        arrive([60.0, 0.0, 350.0], UP),
        feed([60.0, 0.0, 300.0], UP),
        feed([60.0, 10.0, 300.0], tilted(10.0, 75.0)),
        feed([60.0, 0.0, 300.0], UP),
    ];
    let (turning, turns) = check(&program, &PlanOptions::default());
    assert!(turning < 1e-9, "{turning}");
    assert_eq!(turns, 0);
}

#[test]
fn a_cut_that_leaves_the_pole_on_another_meridian_spreads_the_turn() {
    let program = [
        arrive([60.0, -10.0, 300.0], tilted(10.0, 0.0)),
        feed([60.0, 0.0, 300.0], UP),
        feed([50.0, 0.0, 300.0], UP),
        feed([50.0, 10.0, 300.0], tilted(10.0, 80.0)),
    ];
    let (turning, turns) = check(&program, &PlanOptions::default());
    assert!((turning - 80.0).abs() < 0.01, "{turning}");
    assert_eq!(turns, 0);
}

/// Every cap, however small, and none.
#[test]
fn a_very_small_cap_is_no_singularity() {
    let programs = [
        [arrive([60.0, 0.0, 300.0], tilted(10.0, 0.0)), feed([60.0, 0.0, 300.0], UP)],
        [arrive([60.0, -10.0, 300.0], tilted(10.0, 0.0)), feed([60.0, 0.0, 300.0], UP)],
    ];
    for start in programs {
        for off in [0.0, 1e-12, 1e-10, 1e-8] {
            let [first, second] = start;
            let near = feed([60.0, 0.0, 300.0], [off, 0.3 * off, 1.0]);
            let program = [first, second, near, feed([50.0, 10.0, 300.0], tilted(10.0, 80.0))];
            let over =
                [arrive([0.0, 0.0, 300.0], [off, -0.2, 1.0]), feed([20.0, 0.0, 300.0], [off, 0.2, 1.0])];
            for pole in (0..=60).map(|i| 10_f64.powf(-4.0 - 0.25 * f64::from(i))).chain([1e-30, 0.0]) {
                let options = PlanOptions { pole: f64::to_radians(pole), ..PlanOptions::default() };
                for program in [&program[..], &over[..]] {
                    let (report, _) = planned(&Machine::verne(), program, &options);
                    let failure = report.failures.first();
                    assert!(failure.is_none(), "{pole}°, {off}: {failure:?}");
                }
            }
        }
    }
}

/// A single segment would move the tool's end by 17.7 mm.
#[test]
fn the_table_turns_at_the_pole_while_the_tool_stands_still() {
    let program = [
        arrive([60.0, 0.0, 300.0], tilted(10.0, 0.0)),
        feed([60.0, 0.0, 300.0], UP),
        feed([60.0, 0.0, 300.0], tilted(10.0, 89.9)),
    ];
    let options = PlanOptions { pole: 0.0, ..PlanOptions::default() };
    let (turning, turns) = check(&program, &options);
    assert!((turning - 89.9).abs() < 0.01, "{turning}");
    assert!((40..=56).contains(&turns), "{turns} rows; the fewest are 43");
}

#[test]
fn rapids_at_the_pole_turn_the_table_for_the_next_cut() {
    let program = [
        arrive([60.0, 0.0, 300.0], tilted(10.0, 0.0)),
        feed([60.0, 10.0, 300.0], UP),
        rapid([60.0, 10.0, 350.0], UP),
        feed([60.0, 10.0, 300.0], UP),
        feed([60.0, 0.0, 300.0], tilted(10.0, 60.0)),
    ];
    let (turning, turns) = check(&program, &PlanOptions::default());
    assert!((turning - 60.0).abs() < 0.01, "{turning}");
    assert_eq!(turns, 0);
}

#[test]
fn a_pure_rotation_keeps_the_tool_s_end_in_place() {
    let program =
        [arrive([30.0, 20.0, 300.0], tilted(5.0, 30.0)), feed([30.0, 20.0, 300.0], tilted(20.0, 70.0))];
    check(&program, &PlanOptions::default());
}

/// A motion with linear phi1 and phi2, degrees, in a frame that is tilted about x, and the arrival at its start.
fn angles(tips: [[f64; 3]; 2], phi: [[f64; 2]; 2], tilt: f64) -> [Motion; 2] {
    let (sin, cos) = tilt.to_radians().sin_cos();
    let frame = [[1.0, 0.0, 0.0], [0.0, cos, -sin], [0.0, sin, cos]];
    let [start, end] = phi.map(|angles| angles.map(f64::to_radians));
    let axis = |[phi1, phi2]: [f64; 2]| {
        let axis = tool_axis(phi1, phi2);
        frame.map(|row| (0..3).map(|i| row[i] * axis[i]).sum())
    };
    let turning = Turning::Angles { start, end, frame };
    [arrive(tips[0], axis(start)), Motion { turning, ..feed(tips[1], axis(end)) }]
}

#[test]
fn the_azimuth_is_followed_through_half_a_turn_close_to_the_pole() {
    let tips = [[10.0, 10.0, 331.0], [17.0, 50.0, 331.0]];
    check(&angles(tips, [[-8.0, -8.0], [4.0, 11.0]], 1.0), &PlanOptions::default());
}

#[test]
fn linear_angles_in_a_tilted_frame_turn_the_table_steadily_close_to_the_pole() {
    let (machine, options, mut random) = (Machine::verne(), PlanOptions::default(), Random::new(41));
    for number in 0..60 {
        let tips = [0, 1].map(|_| [0, 1, 2].map(|i| [0.0, 0.0, 320.0][i] + random.between(-40.0, 40.0)));
        let phi = [0, 1].map(|_| [random.between(-8.0, 8.0), random.between(-60.0, 60.0)]);
        let program = angles(tips, phi, random.between(-3.0, 3.0));
        let (report, rows) = planned(&machine, &program, &options);
        let singular = |constraint| constraint == Constraint::ParallelSingularity;
        assert!(!report.failures.iter().any(|failure| singular(failure.margin.constraint)), "{number}");
        let turns = rows.windows(2).map(|pair| (pair[1].table.theta2 - pair[0].table.theta2).abs());
        let greatest = turns.fold(0.0, f64::max);
        assert!(greatest < 0.5 * PI, "{number}: theta2 jumps by {greatest}");
        assert!(worst_deviation(&machine, &program, &rows, &options) <= 1.0, "{number}");
    }
}

#[test]
fn a_cut_that_begins_out_of_reach_has_a_row_of_kind_feed_at_its_end_only() {
    let program = angles([[3000.0, 0.0, 330.0], [0.0, 0.0, 330.0]], [[10.0, 0.0], [12.0, 70.0]], 1.0);
    let (report, rows) = planned(&Machine::verne(), &program, &PlanOptions::default());
    assert!(!report.is_feasible());
    let last = rows.iter().rposition(|row| row.motion == 1).unwrap();
    let feeds = rows.iter().enumerate().filter(|(_, row)| row.kind == RowKind::Feed);
    assert!(feeds.map(|(place, _)| place).eq([last]) && rows.len() > 2, "{} rows", rows.len());
}
