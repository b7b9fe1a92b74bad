//! How well and how fast a calibration finds known parameters: `cargo bench -p verne-solver --bench calibration` prints
//! three tables as Markdown.
//!
//! The machines differ from the built-in one in every parameter by uniform random amounts, angles by as much at the
//! machine's longest dimension. Poses are feasible random ones, and errors are normal.
#![allow(clippy::unwrap_used, reason = "a bench that cannot run must stop")]
#![allow(clippy::cast_precision_loss, reason = "counts are far below 2^53")]

#[path = "../tests/calibration/bench.rs"]
mod bench;
#[path = "../tests/support/random.rs"]
mod random;

use std::hint::black_box;
use std::time::Instant;

use verne_solver::Machine;
use verne_solver::calibration::{CalibrationOptions, Loss};

use bench::{Kind, POSES, Shares, calibration, deviating, measured, with_noise, with_sigma};
use random::Random;

/// Standard deviation of a measured number, mm.
const SIGMA: f64 = 0.002;
/// Runs for each kind of measurement, with noise and without.
const RUNS: [usize; 2] = [1000, 200];
/// Measurements of a timed calibration.
const MANY: usize = 10_000;
/// Calibrations of which the median is printed.
const ROUNDS: usize = 11;

fn main() {
    let timed = std::env::args().any(|argument| argument == "--bench");
    let part = if timed { 1 } else { 100 };
    recovery(RUNS[0] / part);
    convergence(RUNS[1] / part);
    time(MANY / part, if timed { ROUNDS } else { 1 });
}

/// How often a parameter that the measurements determine is within three of its standard deviations.
fn recovery(runs: usize) {
    println!(
        "| {POSES} poses, errors of 2 µm | runs | rank | parameters within 3 sigma | the least of one parameter |"
    );
    println!("|---|---:|---:|---:|---:|");
    let (machine, random) = (Machine::verne(), &mut Random::new(1));
    for kind in Kind::ALL {
        let (mut shares, mut ranks) = (Shares::default(), Vec::new());
        for _ in 0..runs {
            let actual = deviating(random, &machine, 0.5);
            let exact = measured(random, (&machine, &actual), kind, POSES);
            let noisy = with_noise(random, SIGMA, exact);
            let found = calibration(&machine, &noisy, &with_sigma(SIGMA)).unwrap();
            shares.add(&found, &actual);
            ranks.push(format!("{} of {}", found.rank, found.singular_values.len()));
        }
        ranks.sort_unstable();
        ranks.dedup();
        let [all, least] = [shares.of_all(), shares.least()].map(|share| 100.0 * share);
        println!("| {kind} | {runs} | {} | {all:.2} % | {least:.1} % |", ranks.join(", "));
    }
}

/// Starts that are 5 mm off in every parameter, without errors of measurement.
fn convergence(runs: usize) {
    println!(
        "\n| start up to 5 mm off, {POSES} poses | runs | converged | most steps | largest residual, mm |"
    );
    println!("|---|---:|---:|---:|---:|");
    let (machine, random) = (Machine::verne(), &mut Random::new(2));
    for kind in Kind::ALL {
        let (mut converged, mut steps, mut residual) = (0, 0, 0.0_f64);
        for _ in 0..runs {
            let actual = deviating(random, &machine, 5.0);
            let exact = measured(random, (&machine, &actual), kind, POSES);
            let Ok(found) = calibration(&machine, &exact, &CalibrationOptions::default()) else { continue };
            converged += usize::from(found.rms < 1e-9);
            steps = steps.max(found.steps);
            residual = found.residuals.iter().flatten().fold(residual, |most, number| most.max(number.abs()));
        }
        println!("| {kind} | {runs} | {converged} | {steps} | {residual:.0e} |");
    }
}

/// The time of a calibration with outliers, standard deviations and five poses to measure next.
fn time(count: usize, rounds: usize) {
    println!(
        "\n| {count} measurements, {} threads | least squares, s | steps | Huber's loss, s | steps | target |",
        rayon::current_num_threads()
    );
    println!("|---|---:|---:|---:|---:|---:|");
    let (machine, random) = (Machine::verne(), &mut Random::new(3));
    for kind in Kind::ALL {
        let actual = deviating(random, &machine, 0.5);
        let poses = if kind == Kind::Distances { count.div_ceil(3) } else { count };
        let exact = measured(random, (&machine, &actual), kind, poses);
        let noisy = with_noise(random, SIGMA, exact);
        let timed = |loss| {
            let options = CalibrationOptions { loss, next: 5, ..with_sigma(SIGMA) };
            let mut seconds: Vec<f64> = Vec::new();
            let mut steps = 0;
            for _ in 0..rounds {
                let begin = Instant::now();
                steps = black_box(calibration(&machine, &noisy, &options).unwrap()).steps;
                seconds.push(begin.elapsed().as_secs_f64());
            }
            seconds.sort_by(f64::total_cmp);
            (seconds[rounds / 2], steps)
        };
        let [(squares, steps), (huber, of_huber)] = [Loss::Squares, Loss::Huber].map(timed);
        println!("| {kind} | {squares:.3} | {steps} | {huber:.3} | {of_huber} | ≤ 2 |");
    }
}
