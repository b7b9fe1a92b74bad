//! Programs that begin where the machine stands.

use std::f64::consts::TAU;

use verne_solver::machine::{Drive, Drives};
use verne_solver::toolpath::{
    Feed, Motion, MotionKind, Pace, PlanOptions, RowKind, Start, Timer, Turning, plan,
};
use verne_solver::{Constraint, Machine, TableAngles, forward_working, part_pose};

use super::choices::tilted;
use super::random::Random;
use super::support::{arrive, feed, planned};

const UP: [f64; 3] = [0.0, 0.0, 1.0];

fn from(rho: [f64; 3], theta1: f64, theta2: f64) -> PlanOptions {
    let table = TableAngles { theta1, theta2 };
    let start = Start::new(&Machine::verne(), rho, table).unwrap();
    PlanOptions { start: Some(start), ..PlanOptions::default() }
}

#[test]
fn the_start_decides_between_equal_windings() {
    let program =
        [arrive([20.0, 0.0, 300.0], tilted(15.0, 80.0)), feed([30.0, 0.0, 300.0], tilted(15.0, 85.0))];
    let (_, rows) = planned(&Machine::verne(), &program, &from([500.0; 3], 0.0, TAU - 1.4));
    let theta2 = rows.iter().find(|row| row.kind == RowKind::Feed).unwrap().table.theta2.to_degrees();
    assert!((theta2 - 275.0).abs() < 1e-6, "{theta2}");
}

/// The way to the first point is a rapid: a straight line of the tool's end within the tolerance of rapids.
#[test]
fn the_first_point_is_reached_by_rows_from_the_start() {
    let (machine, mut random) = (Machine::verne(), Random::new(5));
    for _ in 0..20 {
        let rho = [500.0, 500.0, 500.0].map(|rho| rho + random.between(-60.0, 60.0));
        let [theta1, theta2] = [random.between(-0.2, 0.2), random.between(-1.0, 1.0)];
        let options = from(rho, theta1, theta2);
        let tip = [random.between(-60.0, 60.0), random.between(-60.0, 60.0), 300.0];
        let program = [arrive(tip, tilted(random.between(0.0, 10.0), random.between(-180.0, 180.0)))];
        let (report, rows) = planned(&machine, &program, &options);
        assert!(report.is_feasible(), "{:?}", report.failures);
        assert_eq!((rows[0].rho, rows[0].table), (rho, TableAngles { theta1, theta2 }));
        assert!(rows[0].way.is_none() && rows[1..].iter().all(|row| row.way.is_some()));
        assert!(rows.iter().all(|row| row.motion == 0 && row.kind == RowKind::Rapid));
        assert_eq!(rows.last().unwrap().position.tip, tip);
        if report.departure_count > 0 {
            continue;
        }
        let start = rows[0].position.tip;
        for pair in rows.windows(2) {
            let rho = std::array::from_fn(|i| 0.5 * (pair[0].rho[i] + pair[1].rho[i]));
            let theta = |of: fn(&TableAngles) -> f64| 0.5 * (of(&pair[0].table) + of(&pair[1].table));
            let table = TableAngles { theta1: theta(|t| t.theta1), theta2: theta(|t| t.theta2) };
            let pose = forward_working(&machine, rho).unwrap().pose;
            let at = part_pose(&machine, &pose, table, 100.0);
            let off = distance_from_line([at.x, at.y, at.z], start, tip);
            assert!(off < 1.0, "{off} mm off the line");
        }
    }
}

fn distance_from_line(p: [f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
    let [u, v] = [b, p].map(|q| -> [f64; 3] { std::array::from_fn(|i| q[i] - a[i]) });
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let t = dot(u, v) / dot(u, u);
    let off: [f64; 3] = std::array::from_fn(|i| v[i] - t * u[i]);
    dot(off, off).sqrt()
}

#[test]
fn a_start_outside_a_limit_fails_at_the_first_motion() {
    let program = [arrive([0.0, 0.0, 300.0], UP), feed([10.0, 0.0, 300.0], UP)];
    let (report, _) = planned(&Machine::verne(), &program, &from([500.0; 3], 0.0, 1.2 * TAU));
    let [failure] = &report.failures[..] else { panic!("{:?}", report.failures) };
    assert_eq!((failure.margin.constraint, failure.motions), (Constraint::Rotary, [0, 0]));
    assert!((failure.margin.value + 0.2 * TAU).abs() < 1e-9);
}

#[test]
fn the_way_from_the_start_takes_time() {
    let (machine, program) = (Machine::verne(), [arrive([0.0, 0.0, 300.0], UP)]);
    let drive = Drive { velocity: 10.0, acceleration: None };
    let drives = Drives { slider: drive, tilt: drive, rotary: drive };
    let options = from([450.0, 500.0, 500.0], 0.0, 0.0);
    let mut rows = Vec::new();
    let pace = |_| Pace { feed: Feed::Drives, from_rest: false };
    let mut timer = Timer::new(Some(drives), 0.004, pace, |row| rows.push(*row));
    plan(&machine, &program[..], &options, |_| true, |row| timer.push(row)).unwrap();
    let time = timer.finish().time;
    let ends = [rows.first(), rows.last()].map(|row| row.unwrap().row.rho);
    let longest = (0..3).map(|i| (ends[1][i] - ends[0][i]).abs()).fold(0.0, f64::max);
    assert!(longest > 10.0 && time >= longest / 10.0 - 1e-9, "{time} s for {longest} mm");
}

/// theta2 of a vertical tool stays, however far the first tilt is from it.
#[test]
fn a_start_at_the_pole_keeps_its_theta2_where_nothing_turns_it() {
    let program = [arrive([0.0, 0.0, 300.0], UP), feed([10.0, 0.0, 300.0], UP)];
    let (report, rows) = planned(&Machine::verne(), &program, &from([500.0; 3], 0.0, 0.7));
    assert!(report.is_feasible() && rows.iter().all(|row| (row.table.theta2 - 0.7).abs() < 1e-12));
}

#[test]
fn words_are_held_from_the_start_on() {
    let words = [0.0, 80_f64.to_radians()];
    let held = Turning::Held { start: words, end: words };
    let program = [Motion { turning: held, ..arrive([0.0, 0.0, 300.0], UP) }];
    for theta2 in [-1.5, 0.0, 4.8] {
        let (report, rows) = planned(&Machine::verne(), &program, &from([500.0; 3], 0.0, theta2));
        assert!(report.is_feasible());
        let turns = (rows.last().unwrap().table.theta2 + words[1]) / TAU;
        assert!((turns - turns.round()).abs() < 1e-12, "{theta2}: {turns}");
        let way = (rows.last().unwrap().table.theta2 - theta2).abs();
        assert!(way <= 0.5 * TAU, "{way}");
        assert_eq!(program[0].kind, MotionKind::Arrive);
    }
}
