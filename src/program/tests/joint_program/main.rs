//! Joint programs, read back by a strict reader of G-code.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod events;
mod options;
mod reader;
mod rows;

use verne_program::joint_program::{
    JointProgramError, JointProgramOptions, JointProgramSummary, JointProgramWriter, JointRow,
};
use verne_program::{Event, EventKind};

/// Writes a program; its text and what was written.
fn write(
    options: &JointProgramOptions,
    events: &[Event],
    rows: &[JointRow],
) -> Result<(String, JointProgramSummary), JointProgramError> {
    let mut writer = JointProgramWriter::new(Vec::new(), options.clone(), events.to_vec())?;
    rows.iter().try_for_each(|row| writer.row(row))?;
    let (out, summary) = writer.finish()?;
    Ok((String::from_utf8(out).unwrap(), summary))
}

/// A row of move `step`: a rapid for the first one. The tip goes with the first slider.
fn row(step: usize, joints: [f64; 5], duration: Option<f64>) -> JointRow {
    let line = u32::try_from(step).unwrap() + 2;
    JointRow { step, line, rapid: step == 0, joints, tip: [joints[0], 0.0, 0.0], duration }
}

fn event(before: u32, kind: EventKind, text: &str) -> Event {
    Event { line: before + 1, before, kind, text: text.into() }
}

/// The lines between the line of modal codes and the foot.
fn body(text: &str) -> Vec<&str> {
    let lines: Vec<_> = text.lines().skip_while(|line| !line.contains("G21 ")).skip(1).collect();
    lines[..lines.len() - 1].to_vec()
}
