//! `/toolpath`: the joint motion of programs.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;

use crate::http::conditional_response::{Conditions, IMMUTABLE};
use crate::http::error::HttpError;
use crate::http::extractors::PathParameter;
use crate::http::handlers::results::stored_of_toolpath;
use crate::http::job_document::JobObject;
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::{Binary, Text, ToolpathResult};
use crate::http::openapi::problem_responses::{ReportProblems, ToolpathFileProblems, ToolpathProblems};
use crate::http::program_body::ProgramInMemory;
use crate::http::result_representation::{summary, summary_or_job};
use crate::http::state::{AppState, SharedState};
use crate::http::toolpath_body::{FileRequest, ToolpathBody};
use crate::http::wait_policy::WaitPolicy;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::programs::{load_program, store_program};
use crate::operations::question::Question;
use crate::operations::question_text::QuestionKind;
use crate::operations::toolpath_question::{CheckedToolpath, ToolpathQuestion};
use crate::operations::toolpath_request::{ProgramSource, read_request};
use crate::wire::error::OperationError;
use crate::wire::program_query::ProgramQuery;
use crate::wire::result_id::ResultId;
use crate::wire::toolpath::ToolpathRequest;
use crate::wire::toolpath_query::{ToolpathQuery, point_into_toolpath_query};
use crate::wire::toolpath_report::ToolpathReport;

/// The joint motion of a program
///
/// Plans the motion of the five joints along a program: it chooses the orientation and the winding of the table for
/// each cut, divides the moves into rows between which a controller may move the joints linearly, and checks every
/// limit. The report says whether the machine can run the program; if not, it names the lines, the limits, and how much
/// is missing.
///
/// The body is JSON with all fields. It may also be the file of a program, as for /toolpath/file. If the computation
/// takes longer than the wait, the answer is 202 with the job. The header `Prefer: wait=N` sets the wait; `Prefer:
/// respond-async` skips it (RFC 7240).
#[utoipa::path(
    post, path = "/toolpath", operation_id = "post_toolpath", tag = "toolpath", params(ProgramQuery, ToolpathQuery),
    request_body(content(
        (ToolpathRequest = "application/json"), (Text = "text/plain"), (Text = "text/csv"),
        (Text = "application/x-ndjson"), (Binary = "application/vnd.apache.arrow.stream"),
        (Binary = "application/octet-stream"),
    ), description = "The program, its set-up and the tolerances as JSON; or the file of a program."),
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
    body: ToolpathBody,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let question = match body {
        ToolpathBody::Json(body) => {
            let shared = Arc::clone(&state);
            let read = move |body: &[u8]| read_request(body, &shared.machines);
            let (checked, source) = body.read(read).await?;
            question(&state, checked, source).await?
        }
        ToolpathBody::File(file) => question_of_file(&state, *file).await?,
    };
    report(&state, question, wait_policy, &conditions).await
}

/// The joint motion of the program in a file
///
/// Answers as POST /toolpath. The body is the file of a program; `format` and the other fields are parameters.
#[utoipa::path(
    post, path = "/toolpath/file", operation_id = "post_toolpath_file", tag = "toolpath",
    params(ProgramQuery, ToolpathQuery),
    request_body(content(
        (Text = "text/plain"), (Text = "text/csv"), (Text = "application/x-ndjson"),
        (Binary = "application/octet-stream"),
    ), description = "The file of a program."),
    responses(
        (status = 200, description = "The report.", body = ToolpathReport),
        (status = 202, description = "The job that computes the result. The header Location has its path.", body =
            JobObject),
        ToolpathFileProblems
    )
)]
pub(crate) async fn post_toolpath_file(
    State(state): State<SharedState>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
    file: FileRequest,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let question = question_of_file(&state, file).await?;
    report(&state, question, wait_policy, &conditions).await
}

async fn report(
    state: &AppState,
    question: ToolpathQuestion,
    wait_policy: WaitPolicy,
    conditions: &Conditions,
) -> Result<Response, HttpError> {
    let question = Arc::new(Question::Toolpath(Box::new(question)));
    summary_or_job(state, &question, &wait_policy).await?.respond(state, wait_policy, conditions)
}

/// The report on a tool path, or another answer about a program
///
/// Returns the answer that POST /toolpath, POST /toolpath/placement or POST /toolpath/origins gave with this id. If the
/// service has evicted it, repeat the request.
#[utoipa::path(
    get, path = "/toolpath/{id}", operation_id = "get_toolpath", tag = "toolpath",
    params(("id" = String, Path, description = "The id from an answer of /toolpath.")),
    responses(
        (status = 200, description = "The report on a tool path, or another answer about a program.", body =
            ToolpathResult),
        ReportProblems
    )
)]
pub(crate) async fn get_report(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    accept: Accept,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let record = stored_of_toolpath(&state, id, QuestionKind::is_of_toolpath).await?;
    summary(&state, record).cached(IMMUTABLE).respond(&conditions)
}

/// The question about the program in a file.
async fn question_of_file(state: &AppState, file: FileRequest) -> Result<ToolpathQuestion, HttpError> {
    let FileRequest { reading, query, body } = file;
    let format = reading.format(body.media_type()).map_err(with_json)?;
    let options = reading.options(format)?;
    let checked = CheckedToolpath::new(&query.into_request(), &state.machines);
    let checked = checked.map_err(point_into_toolpath_query)?;
    let ProgramInMemory { program, memory } = body.receive(format, options).await?;
    let question = question(state, checked, ProgramSource::Received(Box::new(program))).await?;
    drop(memory);
    Ok(question)
}

/// A body without a known type may be meant as JSON.
fn with_json(error: OperationError) -> OperationError {
    let OperationError::Fields(mut faults) = error else { return error };
    for fault in &mut faults {
        fault.detail.push_str("; a request in JSON needs Content-Type: application/json");
    }
    OperationError::Fields(faults)
}

async fn question(
    state: &AppState,
    checked: CheckedToolpath,
    source: ProgramSource,
) -> Result<ToolpathQuestion, HttpError> {
    about_program(state, checked, source, |toolpath| toolpath, |question| question.id).await
}

/// The question that `of` makes of a tool path. The program is checked and stored unless the answer is known.
pub(crate) async fn about_program<Q>(
    state: &AppState,
    checked: CheckedToolpath,
    source: ProgramSource,
    of: impl Fn(ToolpathQuestion) -> Q,
    id: impl Fn(&Q) -> ResultId,
) -> Result<Q, HttpError> {
    let toolpath = checked.question(source.id());
    let question = of(toolpath.clone());
    if state.results.record(id(&question)).await.is_some() {
        return Ok(question);
    }
    Ok(of(with_program(state, toolpath, source).await?))
}

/// The question with its estimated work. Its program is checked, and stored for the job.
async fn with_program(
    state: &AppState,
    question: ToolpathQuestion,
    source: ProgramSource,
) -> Result<ToolpathQuestion, HttpError> {
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
    Ok(question)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;
