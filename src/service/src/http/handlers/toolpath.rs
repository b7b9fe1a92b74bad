//! `/toolpath`: the joint motion of programs.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;

use crate::http::conditional_response::{Conditions, IMMUTABLE, Representation};
use crate::http::error::{HttpError, LookupError};
use crate::http::extractors::{BatchBody, PathParameter};
use crate::http::handlers::results::record;
use crate::http::job_document::JobObject;
use crate::http::negotiation::Accept;
use crate::http::openapi::problem_responses::{ReportProblems, ToolpathProblems};
use crate::http::result_or_job::ResultOrJob;
use crate::http::result_representation::{summary, summary_or_job};
use crate::http::state::{AppState, SharedState};
use crate::http::wait_policy::WaitPolicy;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::programs::{load_program, store_program};
use crate::operations::question::Question;
use crate::operations::question_text::QuestionKind;
use crate::operations::toolpath_question::CheckedToolpath;
use crate::operations::toolpath_request::{ProgramSource, read_request};
use crate::wire::toolpath::ToolpathRequest;
use crate::wire::toolpath_report::ToolpathReport;

/// The joint motion of a program
///
/// Plans the motion of the five joints along a program: it chooses the orientation and the winding of the table for each
/// cut, divides the moves into rows between which a controller may move the joints linearly, and checks every limit. The
/// report says whether the machine can run the program; if not, it names the lines, the limits, and how much is missing.
/// If the computation takes longer than the wait, the answer is 202 with the job.
#[utoipa::path(
    post, path = "/toolpath", operation_id = "toolpath", tag = "toolpath",
    request_body(content = ToolpathRequest, description = "The program, its set-up, and the tolerances."),
    responses(
        (status = 200, description = "The report.", body = ToolpathReport),
        (status = 202, description = "The job that computes the result. The header Location has its path.", body =
            JobObject),
        ToolpathProblems
    )
)]
pub(crate) async fn post_toolpath(
    State(state): State<SharedState>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
    body: BatchBody,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let machines = Arc::clone(&state);
    let (checked, source) = body.read(move |body| read_request(body, &machines.machines)).await?;
    let report = report_or_job(&state, checked, source, &wait_policy).await?;
    report.respond(&state, wait_policy, &conditions)
}

/// The report on a tool path
///
/// Returns the answer that POST /toolpath gave with this id. If the service has evicted it, repeat the request.
#[utoipa::path(
    get, path = "/toolpath/{id}", operation_id = "toolpath_report", tag = "toolpath",
    params(("id" = String, Path, description = "The id from an answer of /toolpath.")),
    responses((status = 200, description = "The report.", body = ToolpathReport), ReportProblems)
)]
pub(crate) async fn get_report(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    accept: Accept,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let record = record(&state, id).await?;
    if record.kind != QuestionKind::Toolpath {
        return Err(LookupError::Result(record.id.to_string()).into());
    }
    summary(&state, record).cached(IMMUTABLE).respond(&conditions)
}

/// The report, or the job that computes it.
async fn report_or_job(
    state: &AppState,
    checked: CheckedToolpath,
    source: ProgramSource,
    wait_policy: &WaitPolicy,
) -> Result<ResultOrJob<Representation>, HttpError> {
    let question = checked.question(source.id());
    if let Some(record) = state.results.record(question.id).await {
        return Ok(ResultOrJob::Result(summary(state, record)));
    }
    let program = match &source {
        ProgramSource::Received(received) => Arc::clone(&received.program),
        ProgramSource::Stored(id) => load_program(&state.results, *id).await?,
    };
    // Before a job is made: a fault of the program is the client's to correct.
    let question = run_on_pool(move |_| question.with_program(&program)).await?;
    if let ProgramSource::Received(received) = source {
        // The job loads the program from the store.
        store_program(&state.results, &received).await?;
    }
    summary_or_job(state, &Arc::new(Question::Toolpath(question)), wait_policy).await
}
