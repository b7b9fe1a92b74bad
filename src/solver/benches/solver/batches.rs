//! Batches of rows on one thread and on two.

use std::time::Instant;

use rayon::ThreadPool;
use rayon::prelude::*;
use verne_solver::{KinematicsError, Machine, PartPose, Posture, part_working};

use crate::harness::median;
use crate::inputs::{Inputs, TOOL};
use crate::newton;
use crate::report::missed;

const ROWS: usize = 100_000;
/// Factor by which two threads should be faster.
const TWICE: f64 = 1.8;

/// Times batches in interleaved rounds and prints their table. The second row writes no answers and shows the best
/// that the two cores give. The target is met in the best rounds, because other work on the second core slows two
/// threads and not one.
pub(crate) fn print(machine: &Machine, inputs: &Inputs, rounds: usize) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("two threads");
    let rows: Vec<PartPose> = inputs.parts.iter().cycle().take(ROWS).copied().collect();
    let mut answers: Vec<Result<Posture, KinematicsError>> = Vec::with_capacity(ROWS);
    let mut times: [Vec<f64>; 4] = Default::default();
    for _ in 0..=rounds {
        times[0].push(timed(|| {
            answers.clear();
            answers.extend(rows.iter().map(|row| part_working(machine, row, TOOL)));
        }));
        times[1].push(timed(|| {
            pool.install(|| {
                rows.par_iter().map(|row| part_working(machine, row, TOOL)).collect_into_vec(&mut answers);
            });
        }));
        times[2].push(timed(|| {
            std::hint::black_box((0..ROWS).map(|row| steps(machine, inputs, row)).sum::<f64>());
        }));
        times[3].push(timed(|| {
            std::hint::black_box(on_two(&pool, machine, inputs));
        }));
    }
    // The first round touches the memory for the first time.
    let [one, two, bare_one, bare_two] = times.each_ref().map(|times| &times[1..]);
    println!(
        "\n| batch of {ROWS} rows | one thread, ms | two threads, ms | times as fast | in the best rounds | target |"
    );
    println!("|---|---:|---:|---:|---:|---:|");
    row("IK part, working mode", one, two, Some(TWICE));
    row("FK, Newton-Raphson, nothing written", bare_one, bare_two, None);
}

fn row(name: &str, one: &[f64], two: &[f64], target: Option<f64>) {
    let faster = median(one.iter().zip(two).map(|(one, two)| one / two));
    let least = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    let best = least(one) / least(two);
    let [one, two] = [one, two].map(|times| median(times.iter().copied()) * 1e3);
    let target = target.map_or(String::new(), |least| format!("≥ {least:.1}{}", missed(best < least)));
    println!("| {name} | {one:.1} | {two:.1} | {faster:.2} | {best:.2} | {target} |");
}

/// Work without memory: one Newton-Raphson solution.
fn steps(machine: &Machine, inputs: &Inputs, row: usize) -> f64 {
    let (rho, start) = inputs.starts[row % inputs.len()];
    newton::forward(machine, rho, start).map_or(0.0, |pose| pose.x)
}

fn on_two(pool: &ThreadPool, machine: &Machine, inputs: &Inputs) -> f64 {
    pool.install(|| (0..ROWS).into_par_iter().map(|row| steps(machine, inputs, row)).sum())
}

fn timed(mut run: impl FnMut()) -> f64 {
    let start = Instant::now();
    run();
    start.elapsed().as_secs_f64()
}
