//! Computes a tool path: the rows, chunk by chunk, and the report.

use std::cell::Cell;
use std::sync::Arc;

use verne_program::Program;
use verne_solver::toolpath::{TimedRow, Timer, healing_change, plan};
use verne_solver::workspace::Observer;

use crate::operations::dwell_marks::DwellMarks;
use crate::operations::program_pace::ProgramPace;
use crate::operations::solver_errors::plan_error;
use crate::operations::toolpath_question::ToolpathQuestion;
use crate::operations::toolpath_report::report;
use crate::operations::toolpath_rows::RowWriter;
use crate::operations::toolpath_rows::row_bytes::StoredRow;
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::toolpath_time::TimeObject;

/// About the bytes of a report.
const REPORT_BYTES: usize = 4096;

/// How many motions are planned between two calls of the observer.
const MOTIONS_PER_CALL: u32 = 16;

/// The number of failures for which a change is looked for that lets the machine follow their moves.
const HEALED_FAILURES: usize = 3;

/// Plans a program. Hands the chunks of rows to `put`, with their numbers, and returns the report as it is sent.
/// `texts` returns the texts of lines, of which it knows any or none.
///
/// # Errors
///
/// Those of `texts` and `put`; program faults, or more rows than a plan may have.
pub(crate) fn compute_toolpath(
    question: &ToolpathQuestion,
    program: &Arc<Program>,
    texts: impl FnOnce(&[u32]) -> Result<Vec<(u32, String)>, OperationError>,
    put: impl FnMut(u64, Vec<u8>) -> Result<(), OperationError>,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let motions = question.motions(program).map_err(OperationError::ProgramFaults)?;
    let mut writer = RowWriter::new(put);
    let mut written = Ok(());
    let has_failed = Cell::new(false);
    let mut calls = 0_u32;
    let progress = |fraction| {
        calls = calls.wrapping_add(1);
        if calls % MOTIONS_PER_CALL != 1 {
            return !has_failed.get();
        }
        observer.progress(fraction);
        !observer.cancelled() && !has_failed.get()
    };
    let mut marks = DwellMarks::default();
    let write = |timed: &TimedRow| {
        if written.is_ok() {
            let row = StoredRow::new(&timed.row, program, timed.duration);
            marks.push(timed, row.line);
            written = writer.push(&row);
            has_failed.set(written.is_err());
        }
    };
    let mut pace = ProgramPace::new(program);
    let mut timer =
        Timer::new(question.machine.data().drives, question.cycle(), |index| pace.of(index), write);
    let planned =
        plan(&question.machine, &motions, &question.plan_options(), progress, |row| timer.push(row));
    let planned = planned.map_err(plan_error);
    let times = planned.is_ok().then(|| timer.finish());
    written?;
    let planned = planned?;
    writer.finish()?;
    let failing = planned.failures.iter().take(HEALED_FAILURES);
    let heal = |failure| {
        let options = question.plan_options();
        healing_change(&question.machine, &motions, &options, failure, || !observer.cancelled())
    };
    let changes: Vec<_> = failing.map(heal).collect();
    if observer.cancelled() {
        return Err(OperationError::Cancelled);
    }
    let time = TimeObject::new(&times.unwrap_or_default(), pace.waits());
    let mut report = report(question, &motions, &planned, &changes, marks, time);
    let mut failing: Vec<u32> = report.failures.iter().map(|failure| failure.lines[0]).collect();
    failing.sort_unstable();
    failing.dedup();
    if !failing.is_empty() {
        report.add_texts(&texts(&failing)?);
    }
    write_json(&report, REPORT_BYTES)
}
