//! The least margin of a plan against a dense sample of the exact path.

use std::f64::consts::PI;

use verne_solver::axis::tool_axis;
use verne_solver::toolpath::{Deviation, PlanOptions};
use verne_solver::{Constraint, Machine, Margin, PartPose, part_working};

use super::random::Random;
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
