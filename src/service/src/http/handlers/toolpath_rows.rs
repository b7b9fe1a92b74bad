//! `/toolpath/{id}/rows`: the joint motion.

use axum::extract::State;
use axum::response::Response;

use crate::http::conditional_response::Conditions;
use crate::http::error::{HttpError, LookupError};
use crate::http::extractors::{PathParameter, QueryString};
use crate::http::handlers::results::record;
use crate::http::job_document::{JobObject, accepted};
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::Text;
use crate::http::openapi::problem_responses::RowsProblems;
use crate::http::result_or_job::ResultOrJob;
use crate::http::state::SharedState;
use crate::http::toolpath_rows::RowsOf;
use crate::http::wait_policy::WaitPolicy;
use crate::operations::question_text::QuestionKind;
use crate::operations::toolpath_report::row_count;
use crate::operations::toolpath_rows::{ROWS_PER_CHUNK, chunk_name};
use crate::wire::error::OperationError;
use crate::wire::toolpath_row::{RowFormat, RowsQuery, ToolpathRows};

/// The joint motion of a program
///
/// Returns the rows of a tool path: the joints to which the machine moves, all of them linearly from the row before,
/// with the tool's end and axis in the part frame, and the worst margin. `format` or Accept selects the format; the
/// default is JSON. `from` and `to` select rows by their number. The service sends the rows while it reads them, and
/// supports strong ETags.
#[utoipa::path(
    get, path = "/toolpath/{id}/rows", operation_id = "toolpath_rows", tag = "toolpath",
    params(("id" = String, Path, description = "The id from an answer of /toolpath."), RowsQuery),
    responses(
        (status = 200, description = "The rows.", content(
            (ToolpathRows = "application/json"), (Text = "application/x-ndjson"), (Text = "text/csv"),
        )),
        (status = 202, description = "The service evicted the rows. This job computes them again.",
            body = JobObject),
        RowsProblems
    )
)]
pub(crate) async fn get_rows(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    QueryString(query): QueryString<RowsQuery>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let format = match query.format {
        Some(format) => format,
        None => accept.choose(RowFormat::ALL.map(|format| (format.media(), format)))?,
    };
    let record = record(&state, id).await?;
    let id = record.id;
    if record.kind != QuestionKind::Toolpath {
        return Err(LookupError::Result(id.to_string()).into());
    }
    let count = row_count(&record.summary.bytes).ok_or(OperationError::Internal)?;
    let range = query.from..query.to.unwrap_or(count);
    check(query.from, query.to, count)?;
    let question = state.results.questions.get_or_read(id, &record.question)?;
    // The store evicts the least recently used first: if the ends are there, so is what is between them.
    let ends = [range.start, range.end.saturating_sub(1).max(range.start)].map(|row| row / ROWS_PER_CHUNK);
    let find = || async {
        if !range.is_empty() {
            for chunk in ends {
                state.results.find_blob(id, &chunk_name(chunk)).await?;
            }
        }
        Some(RowsOf { id, range: range.clone(), format })
    };
    let mut response = match state.blob_or_job(&question, &wait_policy, None, find).await? {
        ResultOrJob::Result(rows) => rows.respond(&state, &conditions)?,
        ResultOrJob::Job(job) => accepted(&job, &state.base)?,
    };
    wait_policy.state_preference(&mut response);
    Ok(response)
}

/// Checks the range of rows.
fn check(from: u64, to: Option<u64>, count: u64) -> Result<(), HttpError> {
    let to_or_end = to.unwrap_or(count);
    if to_or_end > count {
        return Err(HttpError::field("/query/to", format!("must be at most {count}, the number of rows")));
    }
    if from > to_or_end {
        let last = if to.is_some() { "to" } else { "the number of rows" };
        return Err(HttpError::field("/query/from", format!("must be at most {to_or_end}: {last}")));
    }
    Ok(())
}
