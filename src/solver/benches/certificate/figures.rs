//! The table of ratios.

use std::hint::black_box;
use std::time::Instant;

use verne_solver::certificate::{Certification, Scope};

use crate::questions::Question;
use crate::{Asked, certified};

/// Interleaved rounds of a full run: odd, so that the median is one of them.
const ROUNDS: usize = 21;
/// Greatest ratio that the project aims at.
const TARGET: f64 = 20.0;

/// Prints the table.
pub(crate) fn print(reachable: &[Asked], random: &[Asked], timed: bool) {
    let rounds = if timed { ROUNDS } else { 1 };
    println!("| answers | questions | solutions | proved | complete | plain, ns | certified, ns | ratio |");
    println!("|---|---:|---:|---:|---:|---:|---:|---:|");
    group("built-in machine", reachable, rounds);
    group("random machines", random, rounds);
}

/// Prints a row for each kind of question, and one for all of them.
fn group(name: &str, all: &[Asked], rounds: usize) {
    let mut totals = [0.0; 2];
    for (scope, wanted) in [(Scope::All, "all"), (Scope::Working, "working mode")] {
        for (kind, problem) in ["FK", "IK platform", "IK tool", "IK part"].into_iter().enumerate() {
            let asked: Vec<&Asked> = all.iter().filter(|(_, question)| kind_of(question) == kind).collect();
            let times = times(&asked, scope, rounds);
            println!("| {name}: {problem}, {wanted} | {} |", row(&asked, scope, times));
            totals = [totals[0] + times[0], totals[1] + times[1]];
        }
    }
    let ratio = totals[1] / totals[0];
    let missed = if ratio > TARGET { " (missed)" } else { "" };
    println!("| {name}: all of these | | | | | | | {ratio:.1}, target ≤ {TARGET}{missed} |");
}

fn kind_of(question: &Question) -> usize {
    match question {
        Question::Forward(_) => 0,
        Question::Platform(_) => 1,
        Question::Tool(..) => 2,
        Question::Part(..) => 3,
    }
}

/// Median times of passes over all questions, ns: plain and certified.
fn times(asked: &[&Asked], scope: Scope, rounds: usize) -> [f64; 2] {
    let [mut plain, mut proved] = [Vec::new(), Vec::new()];
    for _ in 0..rounds {
        plain.push(time(|| {
            for (machine, question) in asked {
                let _ = black_box(&question.answer(machine, scope));
            }
        }));
        proved.push(time(|| {
            for asked in asked {
                let _ = black_box(&certified(asked, scope));
            }
        }));
    }
    [plain, proved].map(median)
}

fn row(asked: &[&Asked], scope: Scope, times: [f64; 2]) -> String {
    let proofs: Vec<Certification> = asked.iter().filter_map(|asked| certified(asked, scope).1).collect();
    let solutions: usize = proofs.iter().map(|proof| proof.boxes.len()).sum();
    let is_proved = |proof: &Certification| proof.boxes.iter().filter(|found| found.is_ok()).count();
    let proved: usize = proofs.iter().map(is_proved).sum();
    let complete = proofs.iter().filter(|proof| proof.complete.is_ok()).count();
    let share = |part: usize, of: usize| 100.0 * part as f64 / of as f64;
    let [plain, certified] = times.map(|time| time / asked.len() as f64);
    format!(
        "{} | {solutions} | {:.2} % | {:.2} % | {plain:.0} | {certified:.0} | {:.1}",
        asked.len(),
        share(proved, solutions),
        share(complete, asked.len()),
        certified / plain
    )
}

fn time(run: impl FnOnce()) -> f64 {
    let start = Instant::now();
    run();
    start.elapsed().as_secs_f64() * 1e9
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
