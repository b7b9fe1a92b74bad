//! The job of a tool path: loads the program, plans it, and stores rows and report.

use verne_solver::workspace::Observer;

use crate::operations::blocking_results::BlockingResults;
use crate::operations::programs::{load_program_in_job, program_lines_in_job};
use crate::operations::question::Question;
use crate::operations::toolpath::compute_toolpath;
use crate::operations::toolpath_question::ToolpathQuestion;
use crate::operations::toolpath_report::row_count;
use crate::operations::toolpath_rows::{chunk_count, chunk_name};
use crate::telemetry::metrics::computations::ComputationMetrics;
use crate::wire::error::OperationError;
use crate::wire::result_id::ResultId;

/// Plans a tool path, unless the store has its report and all its rows. The report is stored last: whoever finds it
/// expects the rows.
pub(crate) fn answer_toolpath(
    store: &BlockingResults,
    question: &ToolpathQuestion,
    computations: &ComputationMetrics,
    observer: &dyn Observer,
) -> Result<(), OperationError> {
    if is_stored(store, question.id) {
        return Ok(());
    }
    let id = question.request.program;
    let program = load_program_in_job(store, id)?;
    computations.count();
    let texts = |lines: &[u32]| program_lines_in_job(store, id, lines);
    let put = |chunk, rows| store.put_blob(question.id, &chunk_name(chunk), rows).map(drop);
    let report = compute_toolpath(question, &program, texts, put, observer)?;
    store.put_record(&Question::Toolpath(question.clone()), &report, None)
}

fn is_stored(store: &BlockingResults, id: ResultId) -> bool {
    let Some(record) = store.complete_record(id, &[]) else { return false };
    row_count(&record.summary.bytes)
        .is_some_and(|rows| (0..chunk_count(rows)).all(|chunk| store.has_blob(id, &chunk_name(chunk))))
}
