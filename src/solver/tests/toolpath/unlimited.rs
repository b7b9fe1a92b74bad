//! Programs on a machine whose table turns without a limit.

use std::f64::consts::{PI, TAU};

use verne_solver::Machine;
use verne_solver::toolpath::{OnLimit, PlanOptions};

use super::choices::{helix, tilted};
use super::random::Random;
use super::support::{arrive, feed, planned, rapid};

fn unlimited() -> Machine {
    let mut data = Machine::verne().data().clone();
    data.limits.rotary = None;
    Machine::new(data).unwrap()
}

#[test]
fn a_cut_of_many_turns_runs_without_a_retract() {
    let retract = OnLimit::Retract { clearance: 50.0, height: None };
    for on_limit in [OnLimit::Fail, retract] {
        let options = PlanOptions { on_limit, ..PlanOptions::default() };
        let (report, rows) = planned(&unlimited(), &helix(0.0, 1800.0), &options);
        assert!(report.is_feasible() && report.retracts == 0, "{:?}", report.failures);
        let [first, last] = [rows.first(), rows.last()].map(|row| row.unwrap().table.theta2);
        assert!((first - last - 5.0 * TAU).abs() < 1e-9 && first.abs() < 1e-9, "{first} {last}");
        assert!(report.least.iter().all(|least| least.margin.constraint != verne_solver::Constraint::Rotary));
    }
}

/// Between cuts theta2 turns by at most half a turn, on whatever winding the cut before has ended.
#[test]
fn rapids_take_the_nearest_winding() {
    let mut random = Random::new(77);
    let tip = [20.0, 10.0, 320.0];
    for _ in 0..3 {
        let mut azimuth = random.between(-180.0, 180.0);
        let mut program = vec![arrive(tip, tilted(10.0, azimuth))];
        for _ in 0..20 {
            for _ in 0..5 {
                azimuth += random.between(20.0, 60.0);
                program.push(feed(tip, tilted(10.0, azimuth)));
            }
            azimuth = random.between(-180.0, 180.0);
            program.push(rapid(tip, tilted(10.0, azimuth)));
        }
        let (report, rows) = planned(&unlimited(), &program, &PlanOptions::default());
        assert!(report.is_feasible(), "{:?}", report.failures);
        let end = |index: usize| rows.iter().rfind(|row| row.motion == index).unwrap().table.theta2;
        for index in (6..program.len()).step_by(6) {
            let turn = (end(index) - end(index - 1)).abs();
            assert!(turn <= PI + 1e-9, "{turn}");
        }
    }
}
