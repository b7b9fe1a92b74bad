//! `/toolpath/{id}/rows`: the joint motion.

use axum::extract::State;
use axum::response::Response;

use crate::http::conditional_response::Conditions;
use crate::http::error::HttpError;
use crate::http::extractors::{PathParameter, QueryString};
use crate::http::job_document::{JobObject, accepted};
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::Text;
use crate::http::openapi::problem_responses::RowsProblems;
use crate::http::result_or_job::ResultOrJob;
use crate::http::state::SharedState;
use crate::http::toolpath_rows::{RowsResponse, rows_or_job, toolpath_record};
use crate::http::wait_policy::WaitPolicy;
use crate::operations::toolpath_row_text::RowTextWriter;
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
    let (record, count) = toolpath_record(&state, id).await?;
    let (id, range) = (record.id, query.from..query.to.unwrap_or(count));
    check(query.from, query.to, count)?;
    let mut response = match rows_or_job(&state, &record, range.clone(), &wait_policy).await? {
        ResultOrJob::Result(_) => {
            let (tag, media, extension) = (format.name().to_owned(), format.media(), format.name());
            let first = range.start;
            RowsResponse { id, range, tag, media, extension }
                .respond(&state, &conditions, || Ok(Box::new(RowTextWriter::new(id, format, first))))?
        }
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
