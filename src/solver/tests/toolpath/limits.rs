//! What happens at limits: the tool leaves the part and the rotary axis turns back; changes that heal a stretch.

use std::f64::consts::TAU;

use verne_solver::toolpath::{
    Failure, Motion, OnLimit, Parameter, PlanOptions, Row, RowKind, healing_change,
};
use verne_solver::{Constraint, Machine};

use super::choices::{helix, tilted};
use super::support::{arrive, feed, planned, worst_deviation};

fn retracting(clearance: f64, height: Option<f64>) -> PlanOptions {
    PlanOptions { on_limit: OnLimit::Retract { clearance, height }, ..PlanOptions::default() }
}

fn joints(row: &Row) -> [f64; 5] {
    let [a, b, c] = row.rho;
    [a, b, c, row.table.theta1, row.table.theta2]
}

#[test]
fn five_turns_need_two_retracts_on_a_rotary_axis_of_two_turns() {
    let machine = Machine::verne();
    let program = helix(0.0, 1800.0);
    let options = retracting(50.0, None);
    let (report, rows) = planned(&machine, &program, &options);
    assert!(report.is_feasible(), "{:?}", report.failures.first());
    assert_eq!(report.retracts, 2);
    let highest = program.iter().map(|motion| motion.end.tip[2]).fold(0.0, f64::max);
    let mut turns = 0;
    for pair in rows.windows(2) {
        let (a, b) = (joints(&pair[0]), joints(&pair[1]));
        let turned = (b[4] - a[4]).abs();
        if pair[1].kind == RowKind::Rewind {
            turns += 1;
            assert!((0..4).all(|i| a[i] == b[i]), "only theta2 turns");
            assert!((turned / TAU - (turned / TAU).round()).abs() < 1e-9 && turned > 6.0, "{turned}");
            assert!(pair[1].position.tip[2] >= highest + 50.0 - 1e-6, "{:?}", pair[1].position);
        } else {
            assert!(turned < 0.2, "theta2 jumps by {turned} at a row of kind {:?}", pair[1].kind);
        }
    }
    assert_eq!(turns, 2);
    assert!(worst_deviation(&machine, &program, &rows, &options) <= 1.0);
}

#[test]
fn the_tool_leaves_along_its_axis_and_returns_to_the_same_place() {
    let (_, rows) = planned(&Machine::verne(), &helix(0.0, 1000.0), &retracting(20.0, Some(380.0)));
    let first = rows.iter().position(|row| row.kind == RowKind::Retract).unwrap();
    let last = rows.iter().rposition(|row| row.kind == RowKind::Approach).unwrap();
    let (start, end) = (&rows[first - 1], &rows[last]);
    let gap = (0..3).map(|i| (start.position.tip[i] - end.position.tip[i]).abs()).fold(0.0, f64::max);
    assert!(gap < 1e-6, "{gap}");
    let along = rows[first..].iter().take_while(|row| row.kind == RowKind::Retract);
    let off: Vec<f64> = along
        .map(|row| {
            let way: [f64; 3] = std::array::from_fn(|i| row.position.tip[i] - start.position.tip[i]);
            let axis = start.position.axis;
            let ahead: f64 = (0..3).map(|i| way[i] * axis[i]).sum();
            (0..3).map(|i| (way[i] - ahead * axis[i]).powi(2)).sum::<f64>().sqrt()
        })
        .collect();
    assert!(off[..off.len() - 1].iter().all(|off| *off < 1e-6), "{off:?}");
    let rewind = rows.iter().find(|row| row.kind == RowKind::Rewind).unwrap();
    assert!((rewind.position.tip[2] - 380.0).abs() < 1e-6, "{:?}", rewind.position);
}

#[test]
fn the_table_does_not_turn_below_the_highest_point() {
    let program = helix(0.0, 1000.0);
    let (_, rows) = planned(&Machine::verne(), &program, &retracting(1.0, Some(100.0)));
    let highest = program.iter().map(|motion| motion.end.tip[2]).fold(0.0, f64::max);
    let rewinds: Vec<_> = rows.iter().filter(|row| row.kind == RowKind::Rewind).collect();
    assert!(!rewinds.is_empty());
    assert!(rewinds.iter().all(|row| row.position.tip[2] >= highest - 1e-6), "{highest}: {rewinds:?}");
}

#[test]
fn a_retract_beyond_the_strokes_fails() {
    let (report, _) = planned(&Machine::verne(), &helix(0.0, 1000.0), &retracting(50.0, Some(2000.0)));
    let constraints: Vec<_> = report.failures.iter().map(|failure| failure.margin.constraint).collect();
    assert!(constraints.contains(&Constraint::Stroke), "{constraints:?}");
}

#[test]
fn a_cut_that_one_winding_serves_is_not_interrupted() {
    let program = helix(-270.0, 342.0);
    let machine = Machine::verne();
    let (report, rows) = planned(&machine, &program, &retracting(50.0, None));
    assert_eq!(report.retracts, 0);
    assert_eq!(rows, planned(&machine, &program, &PlanOptions::default()).1);
}

fn healed(program: &[Motion], change: Parameter, delta: f64) -> Vec<Motion> {
    let shift = |motion: &Motion| {
        let mut motion = *motion;
        match change {
            Parameter::X => motion.end.tip[0] += delta,
            Parameter::Y => motion.end.tip[1] += delta,
            Parameter::Z => motion.end.tip[2] += delta,
            Parameter::ToolLength => motion.tool_length += delta,
        }
        motion
    };
    program.iter().map(shift).collect()
}

#[test]
fn the_change_heals_the_stretch_and_a_little_less_does_not() {
    let machine = Machine::verne();
    let options = PlanOptions::default();
    let up = [0.0, 0.0, 1.0];
    let programs = [
        vec![arrive([-20.0, 0.0, 800.0], up), feed([20.0, 0.0, 800.0], up)],
        vec![arrive([0.0, 0.0, 300.0], up), feed([900.0, 0.0, 300.0], up), feed([0.0, 10.0, 300.0], up)],
        vec![arrive([0.0, 0.0, 300.0], tilted(20.0, 0.0)), feed([0.0, 700.0, 300.0], tilted(20.0, 0.0))],
    ];
    let mut found = 0;
    for program in &programs {
        let (report, _) = planned(&machine, program, &options);
        assert!(!report.is_feasible());
        let all = Failure { motions: [0, program.len() - 1], ..report.failures[0] };
        let Some(change) = healing_change(&machine, &program[..], &options, &all, || true) else { continue };
        found += 1;
        let with = |delta: f64| planned(&machine, &healed(program, change.parameter, delta), &options).0;
        assert!(with(change.delta).is_feasible(), "{change:?}");
        let less = change.delta - 0.02 * change.delta.signum();
        assert!(!with(less).is_feasible(), "{change:?}");
    }
    assert!(found >= 2, "{found}");
}

#[test]
fn a_rotary_limit_is_healed_by_no_change() {
    let program = helix(0.0, 900.0);
    let (machine, options) = (Machine::verne(), PlanOptions::default());
    let (report, _) = planned(&machine, &program, &options);
    assert_eq!(healing_change(&machine, &program[..], &options, &report.failures[0], || true), None);
}
