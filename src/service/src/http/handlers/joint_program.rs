//! `/toolpath/{id}/program` and `/toolpath/{id}/path`: the joint motion for a controller, and for viewers.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;

use crate::http::conditional_response::{Conditions, IMMUTABLE, Representation};
use crate::http::error::{HttpError, LookupError};
use crate::http::extractors::{PathParameter, QueryString};
use crate::http::job_document::{JobObject, accepted};
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::{Binary, Text};
use crate::http::openapi::problem_responses::{JointProgramProblems, RowsProblems};
use crate::http::result_or_job::ResultOrJob;
use crate::http::state::{AppState, SharedState};
use crate::http::toolpath_rows::{RowsResponse, chunk, rows_or_job, toolpath_record};
use crate::http::wait_policy::WaitPolicy;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::joint_program::{JointProgramText, check_durations};
use crate::operations::programs::load_program;
use crate::operations::question::Question;
use crate::operations::results::hashed;
use crate::operations::toolpath_glb::ToolpathLines;
use crate::operations::toolpath_report::is_feasible;
use crate::operations::toolpath_row_text::RowText;
use crate::operations::toolpath_rows::chunk_count;
use crate::wire::error::OperationError;
use crate::wire::joint_program::JointProgramQuery;
use crate::wire::result_id::ResultId;
use crate::wire::toolpath_path::PathQuery;

/// The media type of G-code.
const GCODE: &str = "text/plain";

/// The media type of a GLB.
const GLB: &str = "model/gltf-binary";

/// The joint program of a tool path
///
/// Returns the tool path as G-code for a controller that moves five axes linearly and knows neither tool nor part: one
/// word for each joint, F, and the events of the program in their places. A program that the machine cannot run has
/// none. The head names the machine by its hash. The service sends the program while it reads the rows.
#[utoipa::path(
    get, path = "/toolpath/{id}/program", operation_id = "get_toolpath_program", tag = "toolpath",
    params(("id" = String, Path, description = "The id from an answer of /toolpath."), JointProgramQuery),
    responses(
        (status = 200, description = "The joint program.", content((Text = "text/plain"))),
        (status = 202, description = "The service evicted the rows. This job computes them again.",
            body = JobObject),
        JointProgramProblems
    )
)]
pub(crate) async fn get_joint_program(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    QueryString(query): QueryString<JointProgramQuery>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    accept.choose([(GCODE, ())])?;
    let options = query.into_options()?;
    let (record, count) = toolpath_record(&state, id).await?;
    if !is_feasible(&record.summary.bytes) {
        let reason = "the machine cannot run the program; the report says why";
        return Err(OperationError::NoJointProgram(reason.to_owned()).into());
    }
    let mut response = match rows_or_job(&state, &record, 0..count, &wait_policy).await? {
        ResultOrJob::Result(question) => {
            let Question::Toolpath(question) = &*question else {
                return Err(OperationError::Internal.into());
            };
            let tag = format!("program {options:?}");
            let rows = RowsResponse { id: record.id, range: 0..count, tag, media: GCODE, extension: "ngc" };
            let writer = async {
                let program = load_program(&state.results, question.request.program).await?;
                all_durations(&state, record.id, count).await?;
                let text: Box<dyn RowText> = Box::new(JointProgramText::new(options, question, &program)?);
                Ok(text)
            };
            rows.respond(&state, &conditions, writer).await?
        }
        ResultOrJob::Job(job) => accepted(&job, &state.base)?,
    };
    wait_policy.state_preference(&mut response);
    Ok(response)
}

/// The path of the tool
///
/// Returns the path of the tool's end in the part frame as lines in a GLB (metres, Y up): feed moves in the colours of
/// their worst margin, rapids grey. The colours are those of Cividis, which people with colour vision deficiency can
/// tell apart. A path of more than 250,000 rows is thinned; `extras` says so.
#[utoipa::path(
    get, path = "/toolpath/{id}/path", operation_id = "get_toolpath_path", tag = "toolpath",
    params(("id" = String, Path, description = "The id from an answer of /toolpath."), PathQuery),
    responses(
        (status = 200, description = "The path.", content((Binary = "model/gltf-binary"))),
        (status = 202, description = "The service evicted the rows. This job computes them again.",
            body = JobObject),
        RowsProblems
    )
)]
pub(crate) async fn get_path(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    QueryString(query): QueryString<PathQuery>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    accept.choose([(GLB, ())])?;
    let query = query.check()?;
    let (record, count) = toolpath_record(&state, id).await?;
    let mut response = match rows_or_job(&state, &record, 0..count, &wait_policy).await? {
        ResultOrJob::Result(question) => {
            let client = wait_policy.client.quota();
            let file = write_path(&state, question, count, query, client).await?;
            let PathQuery { least, greatest } = query;
            let location = format!("{}/path?least={least}&greatest={greatest}", record.id.toolpath());
            let representation = Representation {
                content: run_on_pool(move |_| Ok::<_, OperationError>(hashed(file))).await?.into(),
                is_unshared: true,
                media: GLB,
                cache_control: Some(IMMUTABLE),
                location: Some(location),
                file_name: Some(format!("toolpath-{:.8}.glb", record.id)),
            };
            representation.respond(&conditions)?
        }
        ResultOrJob::Job(job) => accepted(&job, &state.base)?,
    };
    wait_policy.state_preference(&mut response);
    Ok(response)
}

/// Checks that every row that is not a rapid has a duration, before the answer begins.
async fn all_durations(state: &AppState, id: ResultId, rows: u64) -> Result<(), OperationError> {
    for number in 0..chunk_count(rows) {
        let chunk = chunk(state, id, number).await?;
        run_on_pool(move |_| check_durations(&chunk)).await?;
    }
    Ok(())
}

/// Encodes the path, chunk by chunk.
async fn write_path(
    state: &AppState,
    question: Arc<Question>,
    rows: u64,
    colours: PathQuery,
    client: Option<&str>,
) -> Result<Vec<u8>, HttpError> {
    let _permit = state.admission.mesh(client).await?;
    let id = question.id();
    let mut lines = ToolpathLines::new(rows);
    for number in 0..chunk_count(rows) {
        let chunk = chunk(state, id, number).await.map_err(|_| LookupError::Toolpath(id.to_string()))?;
        let question = Arc::clone(&question);
        lines = run_on_pool(move |_| {
            let Question::Toolpath(question) = &*question else { return Err(OperationError::Internal) };
            lines.add(question, &chunk).map(|()| lines)
        })
        .await?;
    }
    let file = run_on_pool(move |_| {
        let Question::Toolpath(question) = &*question else { return Err(OperationError::Internal) };
        lines.write(question, colours)
    });
    Ok(file.await?)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;
