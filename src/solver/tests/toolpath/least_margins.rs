//! The least margin of a plan against a dense sample of the exact path.

use std::f64::consts::PI;

use verne_solver::axis::tool_axis;
use verne_solver::toolpath::{Deviation, PlanOptions};
use verne_solver::{Constraint, Machine, Margin, Margins, PartPose, forward_working, part_working};

use super::random::Random;
use super::random_programs;
use super::support::{arrive, feed, planned};

const PLACES: usize = 4_000;

/// The sliders at places of a straight cut with a fixed axis.
fn sliders(tips: [[f64; 3]; 2], [phi1, phi2]: [f64; 2]) -> Vec<[f64; 3]> {
    let at = |place: usize| {
        let s = place as f64 / PLACES as f64;
        let [x, y, z] = [0, 1, 2].map(|i| tips[0][i] + (tips[1][i] - tips[0][i]) * s);
        part_working(&Machine::verne(), &PartPose { x, y, z, phi1, phi2 }, 100.0).unwrap().rho
    };
    (0..=PLACES).map(at).collect()
}

/// A machine whose table can only turn to phi2, so that there is one preimage, and with this end of one stroke.
fn machine(phi2: f64, slider: usize, highest: f64) -> Machine {
    let mut data = Machine::verne().data().clone();
    data.limits.rotary = Some([-phi2 - 0.1, -phi2 + 0.1]);
    data.limits.stroke = [[-1000.0, 2000.0]; 3];
    data.limits.stroke[slider] = [highest - 750.0, highest];
    Machine::new(data).unwrap()
}

#[test]
fn a_stroke_that_is_exceeded_between_rows_is_found() {
    let mut random = Random::new(29);
    let tolerance = Deviation { tip: 0.3, axis: 0.01 };
    let options = PlanOptions { tolerance, ..PlanOptions::default() };
    let mut count = 0;
    for number in 0..100 {
        let tips = [-1.0, 1.0].map(|side| {
            let along = side * random.between(90.0, 130.0);
            [random.between(-5.0, 5.0), along, 300.0 + random.between(-0.2, 0.2)]
        });
        let phi = [random.between(0.0, 0.2), random.between(-PI, PI)];
        let rho = sliders(tips, phi);
        for slider in [0, 1, 2] {
            let of = |place: usize| rho[place][slider];
            let highest = (0..=PLACES).max_by(|a, b| of(*a).total_cmp(&of(*b))).unwrap();
            if highest == 0 || highest == PLACES {
                continue;
            }
            count += 1;
            // Half a micrometre beside the limit.
            let exact = if number % 2 == 0 { 5e-4 } else { -5e-4 };
            let machine = machine(phi[1], slider, of(highest) + exact);
            let axis = tool_axis(phi[0], phi[1]);
            let program = [arrive(tips[0], axis), feed(tips[1], axis)];
            let (report, _) = planned(&machine, &program, &options);
            let is_stroke = |margin: &Margin| margin.constraint == Constraint::Stroke;
            let least = report.least.iter().map(|least| least.margin).find(is_stroke);
            let found = least.unwrap().value;
            assert!((found - exact).abs() < 1e-6, "{number}, slider {slider}: {found} instead of {exact}");
            assert_eq!(report.is_feasible(), exact > 0.0, "{number}, slider {slider}");
        }
    }
    assert!(count > 5, "{count} sliders are lowest within a cut");
}

/// The least margin of a constraint at a posture of the working mode.
fn least_of(margins: &Margins, constraint: Constraint) -> f64 {
    let least = |margins: &[f64]| margins.iter().copied().fold(f64::INFINITY, f64::min);
    match constraint {
        Constraint::Stroke => least(margins.stroke.as_flattened()),
        Constraint::LegLength => least(&margins.leg_length),
        Constraint::SerialSingularity => least(&margins.serial_singularity),
        Constraint::ParallelSingularity => margins.parallel_singularity,
        Constraint::SliderJoint => least(&margins.slider_joint),
        Constraint::PlatformJoint => least(&margins.platform_joint),
        Constraint::RodCrossing => margins.rod_crossing.unwrap(),
        Constraint::RodInterference => margins.rod_interference,
        Constraint::Tilt => least(&margins.tilt.unwrap()),
        Constraint::Rotary => least(&margins.rotary.unwrap()),
        Constraint::TableClearance => f64::INFINITY,
    }
}

#[test]
fn rows_have_their_worst_margin_and_reports_the_least_of_each_constraint() {
    let (mut random, options) = (Random::new(57), PlanOptions::default());
    for number in 0..60 {
        let machine = random_programs::machine(&mut random);
        let program = random_programs::program(&machine, &mut random);
        let (report, rows) = planned(&machine, &program, &options);
        let mut least = [f64::INFINITY; Constraint::ALL.len()];
        for row in &rows {
            let posture = forward_working(&machine, row.rho).unwrap();
            let margins = Margins::of(&machine, &posture, Some(row.table));
            let worst = margins.worst(&machine);
            let difference = row.margin.fraction(&machine) - worst.fraction(&machine);
            assert!(difference.abs() < 1e-9, "{number}: {:?} instead of {worst:?}", row.margin);
            for (least, constraint) in least.iter_mut().zip(Constraint::ALL) {
                *least = least.min(least_of(&margins, constraint));
            }
        }
        for (least, constraint) in least.into_iter().zip(Constraint::ALL) {
            let found = report.least.iter().map(|least| least.margin).find(|m| m.constraint == constraint);
            let excess = found.map_or(f64::INFINITY, |found| found.value) - least;
            // Margins near a limit are examined between rows, too.
            assert!(least.is_infinite() || excess < 1e-7, "{number}: {found:?} instead of {least}");
            let near = report.failure_count > 0 || found.is_none_or(|m| m.fraction(&machine) < 0.01);
            assert!(near || excess > -1e-7, "{number}: {found:?} is less than {least}");
        }
    }
}
