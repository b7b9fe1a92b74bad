//! Motions that begin with another tool in the same joints.

use verne_solver::toolpath::{Motion, PlanOptions, Row, RowKind};
use verne_solver::{Constraint, Machine};

use super::choices::tilted;
use super::random::Random;
use super::support::{arrive, feed, planned, rapid, unit, worst_deviation};

const UP: [f64; 3] = [0.0, 0.0, 1.0];

fn with_tool(tool_length: f64, motion: Motion) -> Motion {
    Motion { tool_length, ..motion }
}

/// The end of a tool that is longer by `change`, in the same joints.
fn lengthened(tip: [f64; 3], axis: [f64; 3], change: f64) -> [f64; 3] {
    let axis = unit(axis);
    std::array::from_fn(|i| tip[i] - change * axis[i])
}

fn rows_of(rows: &[Row], motion: usize) -> impl Iterator<Item = &Row> {
    rows.iter().filter(move |row| row.motion == motion)
}

/// The rows must be those of a program that states the new tool's position before the feed.
#[test]
fn a_feed_after_a_change_of_length_begins_at_the_new_tool_s_end() {
    let (machine, options, mut random) = (Machine::verne(), PlanOptions::default(), Random::new(23));
    for _ in 0..10 {
        let axis = tilted(random.between(5.0, 15.0), random.between(-90.0, 90.0));
        let (tip, end) = ([10.0, 20.0, 340.0], [random.between(-60.0, 60.0), 0.0, 330.0]);
        let change = random.between(-40.0, 40.0);
        let changing = [arrive(tip, axis), with_tool(100.0 + change, feed(end, axis))];
        let stated = [
            with_tool(100.0 + change, arrive(lengthened(tip, axis, change), axis)),
            with_tool(100.0 + change, feed(end, axis)),
        ];
        let [(report, rows), (expected, stated_rows)] =
            [changing, stated].map(|program| planned(&machine, &program, &options));
        assert!(report.is_feasible() && expected.is_feasible());
        assert_eq!(rows.len(), stated_rows.len());
        assert!((report.length[0] - expected.length[0]).abs() < 1e-9);
        for (a, b) in rows.iter().zip(&stated_rows) {
            assert!((0..3).all(|i| (a.rho[i] - b.rho[i]).abs() < 1e-6), "{a:?} {b:?}");
        }
        assert!(worst_deviation(&machine, &stated, &stated_rows, &options) <= 1.0);
    }
}

#[test]
fn the_joints_stay_when_the_length_changes() {
    let axis = tilted(10.0, 30.0);
    let program = [
        arrive([0.0, 0.0, 300.0], axis),
        feed([30.0, 0.0, 300.0], axis),
        with_tool(130.0, feed(lengthened([30.0, 0.0, 300.0], axis, 30.0), axis)),
        with_tool(130.0, feed([0.0, 0.0, 300.0], axis)),
    ];
    let (report, rows) = planned(&Machine::verne(), &program, &PlanOptions::default());
    assert!(report.is_feasible());
    let [before, after] = [1, 2].map(|motion| rows_of(&rows, motion).last().unwrap());
    assert!((0..3).all(|i| (before.rho[i] - after.rho[i]).abs() < 1e-9), "{before:?} {after:?}");
    assert!(rows_of(&rows, 3).count() > 2, "the way is linearised");
}

/// In a cap the axis of the joints is not exactly the path's: the way begins where the joints have the new tool.
#[test]
fn a_change_of_length_inside_a_cap_keeps_the_tool_within_the_tolerance() {
    let options = PlanOptions::default();
    let lean = [0.9 * options.pole, 0.0, 1.0];
    let program = [
        arrive([0.0, -20.0, 330.0], tilted(10.0, 0.0)),
        feed([0.0, 0.0, 330.0], lean),
        with_tool(180.0, feed([50.0, 0.0, 270.0], lean)),
    ];
    let (report, rows) = planned(&Machine::verne(), &program, &options);
    assert!(report.is_feasible());
    assert!(report.deviation.tip <= options.tolerance.tip);
    let first = rows_of(&rows, 2).next().unwrap();
    assert!(first.kind == RowKind::Inserted && first.way.unwrap().fraction < 0.5, "{first:?}");
}

#[test]
fn limits_are_examined_on_the_way_of_the_new_tool() {
    let options = PlanOptions { table_clearance: Some(0.0), ..PlanOptions::default() };
    // The longer tool begins below the table.
    let program = [arrive([0.0, 0.0, 40.0], UP), with_tool(150.0, feed([0.0, 0.0, 60.0], UP))];
    let (report, _) = planned(&Machine::verne(), &program, &options);
    let clearance = |failure: &&verne_solver::toolpath::Failure| {
        failure.margin.constraint == Constraint::TableClearance && failure.motions == [1, 1]
    };
    let failure = report.failures.iter().find(clearance).unwrap();
    assert!((failure.margin.value + 10.0).abs() < 1e-9, "{failure:?}");
}

#[test]
fn a_rapid_after_a_change_of_length_has_rows_from_the_present_joints() {
    let program = [
        arrive([-100.0, 0.0, 300.0], UP),
        with_tool(80.0, rapid([100.0, 0.0, 300.0], UP)),
        with_tool(80.0, feed([90.0, 0.0, 300.0], UP)),
    ];
    let (report, rows) = planned(&Machine::verne(), &program, &PlanOptions::default());
    assert!(report.is_feasible());
    assert!(rows_of(&rows, 1).count() > 2 && rows_of(&rows, 1).all(|row| row.way.is_some()));
    assert!((report.length[1] - 200_f64.hypot(20.0)).abs() < 1e-9, "{:?}", report.length);
}
