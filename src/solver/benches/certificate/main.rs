//! The cost of proofs, as the ratio of certified answers to plain ones in the same run, and how much is proved.
//!
//! `cargo bench -p verne-solver --bench certificate` prints the table as Markdown: for reachable poses of the built-in
//! machine, and for 10,000 random machines with a question each. With the argument `lines` it prints these questions and
//! their boxes instead, one JSON object a line, for `tests/reference/check_certificates.py`.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a bench that cannot run must stop")]
#![allow(clippy::cast_precision_loss, reason = "counts are far below 2^53")]

mod figures;
#[path = "../../tests/support/lengths.rs"]
mod lengths;
mod lines;
#[path = "../../tests/support/machines.rs"]
mod machines;
#[path = "../../tests/support/questions.rs"]
mod questions;
#[path = "../../tests/support/random.rs"]
mod random;

use verne_solver::certificate::{Certification, Scope};
use verne_solver::{
    KinematicsError, Machine, Margins, Postures, TableAngles, part_pose, platform_working, tool_point,
};

use questions::Question;
use random::Random;

/// Random machines of a full run.
const MACHINES: usize = 10_000;
/// Reachable poses of the built-in machine.
const POSES: usize = 1_000;
/// Tool length of these, mm.
const TOOL: f64 = 120.0;

/// A machine with a question to it.
type Asked = (Machine, Question);
/// The plain answer of the solver.
type Answer = Result<Postures, KinematicsError>;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let timed = arguments.iter().any(|argument| argument == "--bench");
    let part = if timed { 1 } else { 100 };
    let random = random_questions(MACHINES / part);
    if arguments.iter().any(|argument| argument == "lines") {
        lines::print(&random);
    } else {
        figures::print(&reachable(POSES / part), &random, timed);
    }
}

fn random_questions(count: usize) -> Vec<Asked> {
    let mut draw = Random::new(0xCE27);
    let asked = std::iter::repeat_with(|| {
        let machine = draw.machine_of_any_kind();
        let question = draw.question(&machine);
        (machine, question)
    });
    asked.take(count).collect()
}

/// Questions whose answer is a pose of the built-in machine within all limits.
fn reachable(count: usize) -> Vec<Asked> {
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

/// The plain answer, and its proof unless the question is refused.
fn certified((machine, question): &Asked, scope: Scope) -> (Answer, Option<Certification>) {
    let answer = question.answer(machine, scope);
    let proof = match &answer {
        Ok(postures) => Some(question.certify(machine, postures, scope)),
        Err(KinematicsError::Unreachable(_)) => Some(question.certify(machine, &[], scope)),
        Err(_) => None,
    };
    (answer, proof)
}
