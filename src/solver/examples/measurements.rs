//! Prints `examples/measurements.csv`: what a laser tracker in the machine's frame would measure on a machine that is
//! not quite the built-in one, at forty poses. The errors are normal, 2 µm in x, y and z. One row has an error of 0.25 mm.
//!
//!     cargo run -p verne-solver --example measurements > examples/measurements.csv

use verne_solver::calibration::{CalibrationError, Observed, Plan, simulated};
use verne_solver::parameter::{ActualMachine, Parameter};
use verne_solver::{Machine, Margins, forward_working};

/// What the machine differs by from the built-in one, mm.
const CHANGES: [(Parameter, f64); 8] = [
    (Parameter::L1, 0.35),
    (Parameter::L2, -0.2),
    (Parameter::R1, 0.6),
    (Parameter::r4, -0.15),
    (Parameter::e1, 0.12),
    (Parameter::o1, 0.08),
    (Parameter::o3, -0.05),
    (Parameter::ToolLength, 0.4),
];

/// Standard deviation of the errors, mm.
const SIGMA: f64 = 0.002;
/// The row with the gross error, and the error in z, mm.
const WRONG: (usize, f64) = (17, 0.25);

/// The number of poses.
const POSES: usize = 40;

/// The i-th of numbers that fill the interval from 0 to 1 evenly.
fn spread(i: u32, step: f64) -> f64 {
    (f64::from(i) * step).fract()
}

/// The i-th normal number.
fn normal(i: u32) -> f64 {
    let uniform = |k: u32| (f64::from(i * 12 + k) * 0.754_877_666_246_692_8).fract() * 9301.0;
    (0..12).map(|k| uniform(k).fract()).sum::<f64>() - 6.0
}

fn main() -> Result<(), CalibrationError> {
    let nominal = Machine::verne();
    let places = (1_u32..).map(|i| [0.819_173, 0.671_044, 0.549_701].map(|step| spread(i, step)));
    let readings = places.map(|place| place.map(|fraction| (700_000.0 * fraction).round() / 1000.0));
    let is_feasible = |rho: &[f64; 3]| {
        let posture = forward_working(&nominal, *rho);
        posture.is_ok_and(|posture| Margins::of(&nominal, &posture, None).feasible())
    };
    let rho: Vec<[f64; 3]> = readings.filter(is_feasible).take(POSES).collect();
    let actual = ActualMachine::new(&nominal, 100.0).with(CHANGES);
    let Observed::Tips(tips) = simulated(&actual, rho.clone(), &Plan::Tips)?.observed else { return Ok(()) };
    println!("rho1,rho2,rho3,x,y,z");
    for (row, (rho, tip)) in (0_u32..).zip(rho.iter().zip(tips)) {
        let [mut x, mut y, mut z] = tip;
        [&mut x, &mut y, &mut z]
            .into_iter()
            .zip(3 * row..)
            .for_each(|(number, i)| *number += SIGMA * normal(i));
        z += if row as usize == WRONG.0 { WRONG.1 } else { 0.0 };
        println!("{:.3},{:.3},{:.3},{x:.4},{y:.4},{z:.4}", rho[0], rho[1], rho[2]);
    }
    Ok(())
}
