//! Numbers of rows and deviations of single motions.

use verne_solver::Machine;
use verne_solver::toolpath::{Deviation, Motion, PlanOptions};

use super::support::{arrive, feed, planned, worst_deviation};

fn options(tip: f64) -> PlanOptions {
    let axis = 0.05_f64.to_radians();
    PlanOptions { tolerance: Deviation { tip, axis }, ..PlanOptions::default() }
}

fn programs() -> [[Motion; 2]; 3] {
    let up = [0.0, 0.0, 1.0];
    [
        [arrive([-150.0, 0.0, 300.0], up), feed([150.0, 0.0, 300.0], up)],
        [arrive([0.0, -150.0, 300.0], up), feed([0.0, 150.0, 300.0], up)],
        [arrive([-100.0, 0.0, 300.0], [0.3, 0.1, 1.0]), feed([100.0, 50.0, 320.0], [0.3, -0.2, 1.0])],
    ]
}

/// The fewest rows were computed by the longest steps that keep the tolerance.
#[test]
fn lines_need_few_rows_and_stay_within_the_tolerance() {
    let fewest = [[15, 43, 135], [8, 23, 70], [23, 70, 220]];
    let machine = Machine::verne();
    for (program, fewest) in programs().iter().zip(fewest) {
        for (tip, fewest) in [0.1, 0.01, 0.001].into_iter().zip(fewest) {
            let options = options(tip);
            let (report, rows) = planned(&machine, program, &options);
            println!("{} rows, fewest {fewest}", rows.len());
            assert!(report.is_feasible());
            assert!(rows.len() * 10 <= fewest * 13, "{} rows, fewest {fewest}", rows.len());
            let worst = worst_deviation(&machine, program, &rows, &options);
            println!("{worst}");
            assert!(worst <= 1.0, "{worst} of the tolerance");
            assert!(report.deviation.tip <= tip);
        }
    }
}
