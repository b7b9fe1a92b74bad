//! The readers and small programs, one peculiarity each.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod arcs;
mod cycles;
mod faults;
mod frames;
mod gcode_arcs;
mod gcode_axes;
mod gcode_cycles;
mod gcode_events;
mod gcode_field;
mod gcode_lengths;
mod gcode_motion;
mod gcode_planes;
mod gcode_words;
mod motion;
mod packed;
mod rows;
mod sources;
mod tables;
mod texts;
mod tools;

use verne_program::{EventKind, Format, Program, ProgramError, ProgramErrors, ReadError, ReadOptions, read};

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

/// Reads G-code with options.
fn gcode(text: &str, options: &ReadOptions) -> Program {
    read(Format::Gcode, text.as_bytes(), options).unwrap()
}

/// Reads G-code in mm: the blocks after `G21`, which is line 1.
fn nc(text: &str) -> Program {
    gcode(&format!("G21\n{text}\nM30\n"), &ReadOptions::default())
}

/// Reads G-code in mm under control of the tool centre point: the blocks after `G21 G43.4 H1`, which is line 1.
fn tcp(text: &str) -> Program {
    gcode(&format!("G21 G43.4 H1\n{text}\nM30\n"), &ReadOptions::default())
}

/// The faults of G-code: of the blocks after `G21`, which is line 1.
fn nc_faults(text: &str) -> Vec<ProgramError> {
    faults_of(Format::Gcode, format!("G21\n{text}\nM30\n").as_bytes()).errors
}

/// The only fault of G-code: of the blocks after `G21`, which is line 1.
#[track_caller]
fn nc_fault(text: &str) -> ProgramError {
    let mut errors = nc_faults(text);
    assert_eq!(errors.len(), 1, "{errors:?}");
    errors.remove(0)
}

/// The kinds of the events, without comments and the end.
fn events(program: &Program) -> Vec<EventKind> {
    let kinds = program.events().iter().map(|event| event.kind);
    kinds.filter(|kind| !matches!(kind, EventKind::Comment | EventKind::End)).collect()
}

/// Numbers from 0 to 1 that fill the interval evenly.
fn evenly(n: u32, seed: f64) -> f64 {
    (f64::from(n) * 0.618_033_988_749_894_8 + seed).fract()
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
