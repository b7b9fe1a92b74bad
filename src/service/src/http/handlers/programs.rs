//! `/programs`: programs that clients send.

use axum::extract::State;
use axum::http::header::LOCATION;
use axum::http::{HeaderMap, HeaderValue, StatusCode};
use axum::response::Response;

use crate::http::base_path::summary_below;
use crate::http::conditional_response::{Conditions, IMMUTABLE, Representation};
use crate::http::error::HttpError;
use crate::http::extractors::{PathParameter, QueryString};
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::{Binary, Text};
use crate::http::openapi::problem_responses::{ProgramBodyProblems, ProgramProblems};
use crate::http::program_body::ProgramBody;
use crate::http::program_source::respond_source;
use crate::http::state::{AppState, SharedState};
use crate::operations::programs::{StoredProgram, program_source, program_summary, store_program};
use crate::operations::results::hashed;
use crate::wire::error::OperationError;
use crate::wire::program::{ProgramSummary, program_path};
use crate::wire::program_query::ProgramQuery;
use crate::wire::result_id::ResultId;

/// Send a program
///
/// Reads a program, the file of a tool path, and keeps it. The service reads the file while it arrives. A program with
/// faults is rejected; the answer lists line, column and word of each fault, and what would be accepted. The answer is
/// 201 for a new program, and 200 with the same id if the service has it already. The service evicts programs like
/// results when it needs space.
#[utoipa::path(
    post, path = "/programs", operation_id = "post_program", tag = "programs", params(ProgramQuery),
    request_body(content(
        (Text = "text/plain"), (Text = "text/csv"), (Text = "application/x-ndjson"),
        (Binary = "application/vnd.apache.arrow.stream"),
        (Binary = "application/octet-stream"),
    ), description = "The file."),
    responses(
        (status = 200, description = "The service has the program already.", body = ProgramSummary),
        (status = 201, description = "The service has stored the program. The header Location has its path.",
            body = ProgramSummary),
        ProgramBodyProblems
    )
)]
pub(crate) async fn post_program(
    State(state): State<SharedState>,
    QueryString(query): QueryString<ProgramQuery>,
    accept: Accept,
    body: ProgramBody,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let format = query.format(body.media_type())?;
    let options = query.options(format)?;
    let received = body.receive(format, options).await?;
    let StoredProgram { id, summary, is_new } = store_program(&state.results, &received.program).await?;
    drop(received);
    let mut response = summary_of(&state, id, summary).respond(&Conditions::default())?;
    if is_new {
        *response.status_mut() = StatusCode::CREATED;
        let location = HeaderValue::try_from(program_path(id)).map_err(|_| OperationError::Internal)?;
        response.headers_mut().insert(LOCATION, location);
    }
    Ok(response)
}

/// Summary of a program
///
/// Returns the answer that POST /programs gave with this id. If the service has evicted the program, send it again; the
/// id stays the same.
#[utoipa::path(
    get, path = "/programs/{id}", operation_id = "get_program", tag = "programs",
    params(("id" = String, Path, description = "The id from an answer of /programs.")),
    responses((status = 200, description = "The summary.", body = ProgramSummary), ProgramProblems)
)]
pub(crate) async fn get_program(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    accept: Accept,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let id = known_id(id)?;
    let summary = program_summary(&state.results, id).await?;
    summary_of(&state, id, summary).cached(IMMUTABLE).respond(&conditions)
}

/// The file of a program
///
/// Returns the bytes that the client sent, decoded. The media type of rows is `text/csv` or `application/x-ndjson`.
/// With `Accept-Encoding: gzip` the service sends them compressed.
#[utoipa::path(
    get, path = "/programs/{id}/source", operation_id = "get_program_source", tag = "programs",
    params(("id" = String, Path, description = "The id from an answer of /programs.")),
    responses(
        (status = 200, description = "The file.", content(
            (Text = "text/plain"), (Text = "text/csv"), (Text = "application/x-ndjson"),
            (Binary = "application/vnd.apache.arrow.stream"),
        )),
        ProgramProblems
    )
)]
pub(crate) async fn get_source(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    headers: HeaderMap,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let id = known_id(id)?;
    let (source, format) = program_source(&state.results, id).await?;
    respond_source(id, &source, format, &headers, &conditions)
}

/// The id in a path. A text that is no id is the id of no program.
fn known_id(id: String) -> Result<ResultId, OperationError> {
    id.parse().map_err(|_| OperationError::ProgramNotFound(id))
}

fn summary_of(state: &AppState, id: ResultId, summary: verne_store::Content) -> Representation {
    let path = program_path(id);
    let below = summary_below(&state.base, &summary.bytes, &path);
    Representation::json(below.map_or(summary, hashed), path)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;
