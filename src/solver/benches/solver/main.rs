//! The solver's speed, as ratios to a Newton-Raphson forward kinematics in the same run.
//!
//! `cargo bench -p verne-solver --bench solver` prints the table as Markdown. Arguments after `--` are parts of the
//! names of the wanted rows, and `rounds=N`. Run as a test (`cargo test --benches`) it checks the baselines and
//! times one round.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a bench that cannot be prepared must stop"
)]
#![allow(clippy::cast_precision_loss, reason = "counts of calls and rows are far below 2^53")]

mod batches;
mod candidates;
mod eliminated_newton;
mod harness;
mod inputs;
mod newton;
mod polynomial;
#[path = "../../tests/support/random.rs"]
mod random;
mod report;
mod root_finders;
mod rows;

use std::hint::black_box;

use verne_solver::Machine;

/// Rounds of a full run: odd, so that the median is one of them.
const ROUNDS: usize = 201;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let timed = arguments.iter().any(|argument| argument == "--bench");
    let wanted = arguments.iter().find_map(|argument| argument.strip_prefix("rounds=")?.parse().ok());
    let rounds = wanted.unwrap_or(if timed { ROUNDS } else { 1 });
    let filters: Vec<&String> =
        arguments.iter().filter(|a| !a.starts_with('-') && !a.starts_with("rounds=")).collect();
    let chosen =
        |name: &str| filters.is_empty() || filters.iter().any(|filter| name.contains(filter.as_str()));

    // Behind the black box nothing of the reference machine is a constant to the compiler.
    let machine = black_box(Machine::verne());
    let inputs = inputs::Inputs::random(&machine);
    inputs.check(|rho, start| newton::forward(&machine, rho, start));
    inputs.check(|rho, start| eliminated_newton::forward(&machine, rho, start));
    let found = root_finders::check(&machine, &inputs);

    let mut candidates = candidates::all(&machine, &inputs);
    candidates.retain(|candidate| candidate.name == newton::NAME || chosen(candidate.name));
    harness::measure(&mut candidates, rounds);
    println!(
        "Medians of {rounds} interleaved rounds over {} random reachable poses, one thread.\n",
        inputs.len()
    );
    report::print(&candidates, &found);
    if chosen("rows") {
        rows::print(&machine, &inputs, rounds);
    }
    if chosen("batch") {
        batches::print(&machine, &inputs, rounds.div_ceil(8));
    }
}
