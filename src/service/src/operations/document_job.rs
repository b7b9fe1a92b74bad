//! Jobs whose answer is one document about a program: windows and placements.

use std::sync::Arc;

use verne_program::Program;
use verne_solver::workspace::Observer;

use crate::operations::blocking_results::BlockingResults;
use crate::operations::placement::compute_placement;
use crate::operations::programs::load_program_in_job;
use crate::operations::question::Question;
use crate::operations::toolpath_question::ToolpathQuestion;
use crate::operations::window::compute_window;
use crate::telemetry::metrics::computations::ComputationMetrics;
use crate::wire::error::OperationError;

/// Answers a window or a placement, unless the store has the answer.
pub(crate) fn answer_document(
    store: &BlockingResults,
    question: &Question,
    computations: &ComputationMetrics,
    observer: &dyn Observer,
) -> Result<(), OperationError> {
    let program = |toolpath: &ToolpathQuestion| -> Result<Arc<Program>, OperationError> {
        let program = load_program_in_job(store, toolpath.request.program)?;
        computations.count();
        Ok(program)
    };
    if store.complete_record(question.id(), &[]).is_some() {
        return Ok(());
    }
    let document = match question {
        Question::Window(asked) => compute_window(asked, &program(&asked.toolpath)?, observer)?,
        Question::Placement(asked) => compute_placement(asked, &program(&asked.toolpath)?, observer)?,
        _ => return Err(OperationError::Internal),
    };
    store.put_record(question, &document, None)
}
