//! Programs whose phi2 is kept at the pole.

use std::f64::consts::TAU;

use verne_solver::axis::tool_axis;
use verne_solver::toolpath::{Motion, MotionKind, PlanOptions, Row, RowKind, Turning};
use verne_solver::{Constraint, Machine};

use super::random::Random;
use super::support::{motion, planned, worst_deviation};

/// A program of tips and words, degrees.
fn program(points: &[(MotionKind, [f64; 3], [f64; 2])]) -> Vec<Motion> {
    let mut before: Option<[f64; 2]> = None;
    points
        .iter()
        .map(|(kind, tip, words)| {
            let end = words.map(f64::to_radians);
            let start = before.replace(end).unwrap_or(end);
            Motion { turning: Turning::Held { start, end }, ..motion(*kind, *tip, tool_axis(end[0], end[1])) }
        })
        .collect()
}

/// Asserts that the rows at the ends of motions have theta2 = -phi2 but for whole turns, and theta1 = alpha - phi1.
fn assert_words(points: &[(MotionKind, [f64; 3], [f64; 2])], rows: &[Row]) {
    for (index, (_, _, [_, phi2])) in points.iter().enumerate() {
        let row = rows.iter().rfind(|row| row.motion == index).unwrap();
        let turns = (row.table.theta2 + phi2.to_radians()) / TAU;
        assert!((turns - turns.round()).abs() < 1e-9, "motion {index}: {turns}");
    }
}

const FEED: MotionKind = MotionKind::Feed;
const ARRIVE: MotionKind = MotionKind::Arrive;
const RAPID: MotionKind = MotionKind::Rapid;

/// The tool stands at (60, 0, 300) while the table turns by a quarter: a single segment would bend by 17.7 mm.
#[test]
fn a_turn_of_c_at_the_pole_turns_the_table() {
    let (machine, options) = (Machine::verne(), PlanOptions::default());
    let points = [(ARRIVE, [60.0, 0.0, 300.0], [0.0, 0.0]), (FEED, [60.0, 0.0, 300.0], [0.0, 90.0])];
    let held = program(&points);
    let (report, rows) = planned(&machine, &held, &options);
    assert!(report.is_feasible());
    assert!((report.turning[1].to_degrees() - 90.0).abs() < 1e-9, "{}", report.turning[1].to_degrees());
    assert!((44..=57).contains(&rows.len()), "{} rows", rows.len());
    assert!(worst_deviation(&machine, &held, &rows, &options) <= 1.0);
    assert_words(&points, &rows);
    let start_end = |turning: Turning| match turning {
        Turning::Held { start, end } => (start, end),
        _ => panic!(),
    };
    let frame = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let free: Vec<Motion> = held
        .iter()
        .map(|motion| {
            let (start, end) = start_end(motion.turning);
            Motion { turning: Turning::Angles { start, end, frame }, ..*motion }
        })
        .collect();
    assert_eq!(planned(&machine, &free, &options).0.turning, [0.0, 0.0], "without the words theta2 is free");
}

#[test]
fn words_are_kept_through_the_pole_and_over_many_turns() {
    let (machine, options) = (Machine::verne(), PlanOptions::default());
    let tip = |x: f64| [x, 10.0, 320.0];
    let points = [
        (ARRIVE, tip(0.0), [10.0, 200.0]),
        (FEED, tip(10.0), [-10.0, 200.0]),
        (FEED, tip(20.0), [0.0, 120.0]),
        (FEED, tip(30.0), [0.0, -250.0]),
        (RAPID, tip(20.0), [5.0, -250.0]),
        (FEED, tip(10.0), [5.0, 300.0]),
        (FEED, tip(0.0), [0.0, 300.0]),
    ];
    let held = program(&points);
    let (report, rows) = planned(&machine, &held, &options);
    assert!(report.is_feasible(), "{:?}", report.failures);
    assert_words(&points, &rows);
    assert!(worst_deviation(&machine, &held, &rows, &options) <= 1.0);
    assert!(rows.iter().all(|row| row.kind != RowKind::Turn) && report.preimage_changes == 0);
    let turned: f64 = rows.windows(2).map(|pair| (pair[1].table.theta2 - pair[0].table.theta2).abs()).sum();
    assert!((report.turning[1] - turned).abs() < 1e-9);
}

#[test]
fn random_words_are_kept() {
    let (machine, options, mut random) = (Machine::verne(), PlanOptions::default(), Random::new(61));
    for _ in 0..30 {
        let mut points = Vec::new();
        for i in 0..8 {
            let kind = if i == 0 {
                ARRIVE
            } else if i == 4 {
                RAPID
            } else {
                FEED
            };
            let tip = [random.between(-30.0, 30.0), random.between(-30.0, 30.0), 320.0];
            let phi1 = if i % 3 == 0 { 0.0 } else { random.between(-12.0, 12.0) };
            points.push((kind, tip, [phi1, random.between(-150.0, 150.0)]));
        }
        let held = program(&points);
        let (report, rows) = planned(&machine, &held, &options);
        assert!(report.is_feasible(), "{:?}", report.failures);
        assert_words(&points, &rows);
        assert!(worst_deviation(&machine, &held, &rows, &options) <= 1.0);
    }
}

/// 900° of C do not fit into ±360°, although the tool's axis does not move.
#[test]
fn words_beyond_the_rotary_range_fail() {
    let points = [(ARRIVE, [0.0, 0.0, 300.0], [0.0, 0.0]), (FEED, [0.0, 0.0, 300.0], [0.0, 900.0])];
    let (report, _) = planned(&Machine::verne(), &program(&points), &PlanOptions::default());
    assert!(report.failures.iter().all(|failure| failure.margin.constraint == Constraint::Rotary));
    let worst = report.failures[0].margin.value.to_degrees();
    assert!((worst + 180.0).abs() < 1e-6, "{worst}");
}
