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

/// Plans a tool path, unless the store has its report and all its rows. The report is stored last: a process that
/// finds it expects the rows.
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
    let put = |chunk, rows| store.put_uncached_blob(question.id, &chunk_name(chunk), rows).map(drop);
    let report = compute_toolpath(question, &program, texts, put, observer)?;
    store.put_record(&Question::Toolpath(Box::new(question.clone())), &report, None)
}

fn is_stored(store: &BlockingResults, id: ResultId) -> bool {
    let Some(record) = store.complete_record(id, &[]) else { return false };
    row_count(&record.summary.bytes)
        .is_some_and(|rows| (0..chunk_count(rows)).all(|chunk| store.has_blob(id, &chunk_name(chunk))))
}

#[cfg(test)]
#[allow(clippy::panic, clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::sync::atomic::{AtomicU32, Ordering};

    use serde_json::json;
    use tokio::runtime::Handle;
    use tokio::task::spawn_blocking;
    use verne_jobs::Submission;
    use verne_solver::workspace::{Observer, Unobserved};
    use verne_store::Store;

    use super::answer_toolpath;
    use crate::operations::blocking_results::BlockingResults;
    use crate::operations::machine_registry::MachineRegistry;
    use crate::operations::programs::store_program;
    use crate::operations::question::Question;
    use crate::operations::question_text::JobParameters;
    use crate::operations::results::Results;
    use crate::operations::toolpath_request::{ProgramSource, read_request};
    use crate::telemetry::metrics::computations::ComputationMetrics;
    use crate::wire::error::OperationError;

    /// A question with some thousand rows, its program in a store, and its job.
    async fn prepared() -> (Store, Question, Submission) {
        let points: Vec<_> = (0..3000).map(|i| json!([i % 90, i % 70, 300 + i % 50])).collect();
        let body =
            json!({"program": {"points": points}, "tool_length": 50, "tolerance": {"tip": 1}}).to_string();
        let (checked, source) = read_request(body.as_bytes(), &MachineRegistry::default()).unwrap();
        let question = checked.question(source.id());
        let ProgramSource::Received(program) = source else { panic!() };
        let question = Question::Toolpath(Box::new(question.with_program(&program.program).unwrap()));
        let store = Store::in_memory(1 << 26);
        store_program(&Results::new(store.clone()), &program).await.unwrap();
        let parameters = JobParameters { max_triangles: 0, cost: 1.0, mesh_format: None };
        let submission = question.submission(parameters, String::new(), None).unwrap();
        (store, question, submission)
    }

    fn answer(store: Store, question: &Question, observer: &dyn Observer) -> Result<Results, OperationError> {
        let results = Results::new(store);
        let blocking = BlockingResults { results: results.clone(), runtime: Handle::current() };
        let Question::Toolpath(path) = question else { panic!() };
        answer_toolpath(&blocking, path, &ComputationMetrics::default(), observer).map(|()| results)
    }

    #[tokio::test]
    async fn a_worker_that_knows_only_the_text_of_the_question_stores_the_same_bytes() {
        let (store, question, submission) = prepared().await;
        let (other_store, ..) = prepared().await;
        let id = question.id();
        let read = Question::from_text(&submission.payload, id).unwrap();
        let work = move || [answer(store, &question, &Unobserved), answer(other_store, &read, &Unobserved)];
        let [here, there] = spawn_blocking(work).await.unwrap().map(Result::unwrap);
        for blob in ["record", "rows-0"] {
            let [here, there] = [here.blob(id, blob).await.unwrap(), there.blob(id, blob).await.unwrap()];
            assert!(here.bytes.len() > 1000 && here.bytes == there.bytes, "{blob}");
        }
    }

    /// Cancels the work at its second call.
    #[derive(Default)]
    struct Cancelling(AtomicU32);

    impl Observer for Cancelling {
        fn progress(&self, _: f64) {}

        fn cancelled(&self) -> bool {
            self.0.fetch_add(1, Ordering::Relaxed) > 0
        }
    }

    #[tokio::test]
    async fn a_cancelled_plan_leaves_no_report() {
        let (store, question, _) = prepared().await;
        let id = question.id();
        let results = Results::new(store.clone());
        let work = move || answer(store, &question, &Cancelling::default()).err();
        assert_eq!(spawn_blocking(work).await.unwrap(), Some(OperationError::Cancelled));
        assert!(results.record(id).await.is_none());
    }
}
