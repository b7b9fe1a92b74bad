//! What the readers make of small programs, one peculiarity each.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod arcs;
mod cycles;
mod faults;
mod frames;
mod motion;
mod packed;
mod rows;
mod sources;
mod texts;
mod tools;

use verne_program::{Format, Program, ProgramError, ProgramErrors, ReadError, ReadOptions, read};

/// Reads CL text that states its unit.
fn apt(text: &str) -> Program {
    read(Format::Apt, text.as_bytes(), &ReadOptions::default()).unwrap()
}

/// Reads CL text in mm: the statements after `UNITS/MM`, which is line 1.
fn mm(text: &str) -> Program {
    apt(&format!("UNITS/MM\n{text}\nFINI\n"))
}

/// The faults of a program.
fn faults_of(format: Format, bytes: &[u8]) -> ProgramErrors {
    match read(format, bytes, &ReadOptions::default()) {
        Err(ReadError::Program(refused)) => refused,
        other => panic!("{other:?}"),
    }
}

/// The only fault of the statements after `UNITS/MM`, which is line 1.
fn fault(text: &str) -> ProgramError {
    let mut refused = faults_of(Format::Apt, format!("UNITS/MM\n{text}\nFINI\n").as_bytes());
    assert_eq!(refused.errors.len(), 1, "{refused}");
    refused.errors.remove(0)
}

/// Line, column and word of a fault.
fn place(error: &ProgramError) -> (u32, u32, &str) {
    (error.line, error.column, &error.word)
}

/// The tips of a program.
fn tips(program: &Program) -> Vec<[f64; 3]> {
    program.moves().iter().map(verne_program::Move::tip).collect()
}

/// The details of the warnings.
fn warnings(program: &Program) -> Vec<&str> {
    program.warnings().list.iter().map(|warning| warning.detail.as_str()).collect()
}

#[track_caller]
fn assert_near(actual: [f64; 3], expected: [f64; 3]) {
    assert!(actual.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{actual:?}, not {expected:?}");
}
