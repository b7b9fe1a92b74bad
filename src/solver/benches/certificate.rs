//! The cost of proofs, as the ratio of certified answers to plain ones in the same run, and how much is proved.
//!
//! `cargo bench -p verne-solver --bench certificate` prints the table as Markdown, for 10,000 random machines with a
//! question each. With the argument `lines` it prints the questions and their boxes instead, one JSON object a line, for
//! `tests/reference/check_certificates.py`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a bench that cannot run must stop"
)]
#![allow(clippy::cast_precision_loss, reason = "counts are far below 2^53")]

#[path = "../tests/support/lengths.rs"]
mod lengths;
#[path = "../tests/support/machines.rs"]
mod machines;
#[path = "../tests/support/questions.rs"]
mod questions;
#[path = "../tests/support/random.rs"]
mod random;

use std::hint::black_box;
use std::time::Instant;

use questions::Question;
use random::Random;
use serde_json::{Value, json};
use verne_solver::certificate::{Certification, Scope};
use verne_solver::{
    KinematicsError, Machine, Margins, Postures, TableAngles, part_pose, platform_working, tool_point,
};

const MACHINES: usize = 10_000;
const ROUNDS: usize = 61;
/// Tool length of questions to the built-in machine, mm.
const TOOL: f64 = 120.0;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let timed = arguments.iter().any(|argument| argument == "--bench");
    let count = arguments.iter().find_map(|argument| argument.strip_prefix("machines=")?.parse().ok());
    let count = count.unwrap_or(if timed { MACHINES } else { 50 });
    let mut draw = Random::new(0xCE27);
    let random: Vec<(Machine, Question)> = std::iter::repeat_with(|| {
        let machine = draw.machine_of_any_kind();
        let question = draw.question(&machine);
        (machine, question)
    })
    .take(count)
    .collect();
    if arguments.iter().any(|argument| argument == "lines") {
        for (machine, question) in &random {
            for scope in [Scope::All, Scope::Working] {
                println!("{}", line(machine, question, scope));
            }
        }
        return;
    }
    println!("| answer | questions | solutions | proved | complete | plain, ns | certified, ns | ratio |");
    println!("|---|---:|---:|---:|---:|---:|---:|---:|");
    report_all("built-in machine", &reachable(count / 10));
    if timed && count > 5000 {
        report_all("random machines", &random);
    }
}

fn report_all(name: &str, all: &[(Machine, Question)]) {
    let mut totals = [0.0; 2];
    for (scope, suffix) in [(Scope::All, "all"), (Scope::Working, "working mode")] {
        for (kind, problem) in ["FK", "IK platform", "IK tool", "IK part"].into_iter().enumerate() {
            let wanted: Vec<_> = all.iter().filter(|(_, question)| kind_of(question) == kind).collect();
            let times = report(&format!("{name}: {problem}, {suffix}"), &wanted, scope);
            totals = [totals[0] + times[0], totals[1] + times[1]];
        }
    }
    println!("| {name}: all of these | | | | | | | {:.1} |", totals[1] / totals[0]);
}

/// Questions whose answer is a pose of the built-in machine within all limits.
fn reachable(count: usize) -> Vec<(Machine, Question)> {
    let (machine, mut draw) = (Machine::verne(), Random::new(0x5EED));
    let mut found = Vec::new();
    while found.len() < count {
        let p = [draw.between(-800.0, 800.0), draw.between(-800.0, 800.0), draw.between(400.0, 1800.0)];
        let table = TableAngles { theta1: draw.between(-1.0, 1.0), theta2: draw.between(-3.0, 3.0) };
        let Ok(posture) = platform_working(&machine, p) else { continue };
        if !Margins::of(&machine, &posture, Some(table)).feasible() {
            continue;
        }
        let question = match found.len() % 4 {
            0 => Question::Forward(posture.rho),
            1 => Question::Platform(p),
            2 => Question::Tool(tool_point(&posture.pose, TOOL), TOOL),
            _ => Question::Part(part_pose(&machine, &posture.pose, table, TOOL), TOOL),
        };
        found.push((machine.clone(), question));
    }
    found
}

fn kind_of(question: &Question) -> usize {
    match question {
        Question::Forward(_) => 0,
        Question::Platform(_) => 1,
        Question::Tool(..) => 2,
        Question::Part(..) => 3,
    }
}

type Answer = Result<Postures, KinematicsError>;

fn certified(machine: &Machine, question: &Question, scope: Scope) -> (Answer, Option<Certification>) {
    let answer = question.answer(machine, scope);
    let proof = match &answer {
        Ok(postures) => Some(question.certify(machine, postures, scope)),
        Err(KinematicsError::Unreachable(_)) => Some(question.certify(machine, &[], scope)),
        Err(_) => None,
    };
    (answer, proof)
}

/// Prints a row; the times of a pass.
fn report(name: &str, wanted: &[&(Machine, Question)], scope: Scope) -> [f64; 2] {
    let [mut plain, mut proved] = [Vec::new(), Vec::new()];
    for _ in 0..ROUNDS {
        plain.push(timed(|| {
            for (machine, question) in wanted {
                black_box(question.answer(machine, scope)).ok();
            }
        }));
        proved.push(timed(|| {
            for (machine, question) in wanted {
                let _ = black_box(certified(machine, question, scope));
            }
        }));
    }
    let times = [median(plain), median(proved)];
    let proofs: Vec<Certification> = wanted.iter().filter_map(|(m, q)| certified(m, q, scope).1).collect();
    let solutions: usize = proofs.iter().map(|proof| proof.boxes.len()).sum();
    let boxes: usize =
        proofs.iter().map(|proof| proof.boxes.iter().filter(|found| found.is_ok()).count()).sum();
    let complete = proofs.iter().filter(|proof| proof.complete.is_ok()).count();
    let share = |part: usize, of: usize| 100.0 * part as f64 / of as f64;
    let each = times.map(|time| time / wanted.len() as f64);
    println!(
        "| {name} | {} | {solutions} | {:.2} % | {:.2} % | {:.0} | {:.0} | {:.1} |",
        wanted.len(),
        share(boxes, solutions),
        share(complete, wanted.len()),
        each[0],
        each[1],
        times[1] / times[0]
    );
    times
}

/// Time of a run, ns.
fn timed(run: impl FnOnce()) -> f64 {
    let start = Instant::now();
    run();
    start.elapsed().as_secs_f64() * 1e9
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn line(machine: &Machine, question: &Question, scope: Scope) -> Value {
    let (answer, proof) = certified(machine, question, scope);
    let g = &machine.data().geometry;
    let table = &machine.data().table;
    let (kind, numbers) = match *question {
        Question::Forward(rho) => ("forward", rho.to_vec()),
        Question::Platform(p) => ("platform", p.to_vec()),
        Question::Tool([x, y, z], length) => ("tool", vec![x, y, z, length]),
        Question::Part(p, length) => ("part", vec![p.x, p.y, p.z, p.phi1, p.phi2, length]),
    };
    let boxes = proof.as_ref().map(|proof| {
        let of = |found: &Result<verne_solver::certificate::PostureBox, _>| {
            found.as_ref().map_or(
                Value::Null,
                |found| json!({"pose": [found.x, found.y, found.z, found.alpha], "rho": found.rho}),
            )
        };
        proof.boxes.iter().map(of).collect::<Vec<_>>()
    });
    json!({
        "geometry": {"D1": g.D1, "d1": g.d1, "D2": g.D2, "d2": g.d2, "R1": g.R1, "r1": g.r1, "R2": g.R2, "r4": g.r4,
            "L1": g.L1, "L2": g.L2, "L3": g.L3, "da": table.da, "dt": table.dt},
        "kind": kind,
        "numbers": numbers,
        "scope": if scope == Scope::All { "all" } else { "working" },
        "postures": answer.ok().map(|found| found.iter().map(|p| {
            json!({"pose": [p.pose.x, p.pose.y, p.pose.z, p.pose.alpha], "rho": p.rho, "merged": p.merged})
        }).collect::<Vec<_>>()),
        "boxes": boxes,
        "complete": proof.map(|proof| match proof.complete { Ok(()) => "complete".to_owned(), Err(e) => format!("{e:?}") }),
    })
}
