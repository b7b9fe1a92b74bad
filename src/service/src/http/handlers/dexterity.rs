//! `/workspace/dexterity` and the points of its map.

use std::io;
use std::sync::Arc;

use axum::body::{Body, Bytes};
use axum::extract::State;
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use verne_rows::Format;

use crate::http::conditional_response::{Conditions, IMMUTABLE, Representation, StreamedText, entity_tag};
use crate::http::error::{HttpError, LookupError};
use crate::http::extractors::{JsonBody, PathParameter, QueryString};
use crate::http::handlers::results::record;
use crate::http::job_document::JobObject;
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::{Binary, MapCells, Text};
use crate::http::openapi::problem_responses::{CellsProblems, DexterityProblems};
use crate::http::result_or_job::ResultOrJob;
use crate::http::result_representation::summary_or_job;
use crate::http::state::SharedState;
use crate::http::wait_policy::WaitPolicy;
use crate::limits::response_memory::UnsharedBytes;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::map_table::MapTable;
use crate::operations::question::Question;
use crate::operations::question_text::QuestionKind;
use crate::operations::results::CELLS;
use crate::wire::dexterity::{CellsQuery, DexterityBody, DexteritySummary};
use crate::wire::error::OperationError;
use crate::wire::result_id::ResultId;
use crate::wire::row_format::RowFormat;

/// Dexterity map: the inclinations that reach each point of the part
///
/// Computes the exact intervals of phi1, within the requested range, that keep every limit, for each point of a grid
/// over the part frame. It also computes volumes and watertight meshes of the reachable points (at least one
/// inclination) and of the dexterous points (all inclinations). The job takes long; with `Prefer: respond-async` the
/// service returns its address immediately.
#[utoipa::path(
    post, path = "/workspace/dexterity", operation_id = "post_dexterity", tag = "workspace",
    request_body(content = DexterityBody, description = "The inclinations, the tool and the grid."),
    responses(
        (status = 200, description = "The summary of the map.", body = DexteritySummary),
        (status = 202, description = "The job that computes the result. The header Location has its path.", body =
            JobObject),
        DexterityProblems
    )
)]
pub(crate) async fn post_dexterity(
    State(state): State<SharedState>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
    JsonBody(body): JsonBody<DexterityBody>,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let question = Arc::new(Question::Dexterity(DexterityQuestion::new(&body, &state.machines)?));
    let summary = summary_or_job(&state, &question, &wait_policy).await?;
    summary.respond(&state, wait_policy, &conditions)
}

/// The points of a map
///
/// Returns the intervals of phi1 at each point of a dexterity map, or the errors at each point of an error map. For
/// JSON the service supports strong ETags, conditional requests and byte ranges. As a table (Arrow, CSV or NDJSON) the
/// answer has a row for each interval of a dexterity map: the number of the point, its x, y and z in the part frame,
/// and `from` and `to`. For an error map it has a row for each point inside the workspace: the number of the point, its
/// x, y and z, `tip_rms`, `tip_worst`, `axis_rms` and `axis_worst`.
#[utoipa::path(
    get, path = "/workspace/{id}/cells", operation_id = "get_dexterity_cells", tag = "workspace",
    params(("id" = String, Path, description = "The id from an answer of /workspace/dexterity or \
            /workspace/error-budget."), CellsQuery),
    responses(
        (status = 200, description = "The points.", content(
            (MapCells = "application/json"), (Text = "application/x-ndjson"), (Text = "text/csv"),
            (Binary = "application/vnd.apache.arrow.stream"),
        )),
        (status = 202, description = "The service evicted the points. This job computes them again.",
            body = JobObject),
        CellsProblems
    )
)]
pub(crate) async fn get_cells(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    QueryString(query): QueryString<CellsQuery>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let record = record(&state, id).await?;
    let format = match query.format {
        Some(format) => format,
        None => accept.choose(RowFormat::ALL.map(|format| (format.media(), format)))?,
    };
    let id = record.id;
    if !matches!(record.kind, QuestionKind::Dexterity | QuestionKind::ErrorMap) {
        return Err(LookupError::Grid(id.to_string()).into());
    }
    let find = || state.results.find_blob(id, CELLS);
    let question = state.results.questions.get_or_read(id, &record.question)?;
    let cells = state.blob_or_job(&question, &wait_policy, None, find).await?;
    let cells = match (cells, format.columns()) {
        (ResultOrJob::Result(_), Some(format)) => {
            let mut response = respond_table(&state, (id, record.kind), format, &conditions).await?;
            wait_policy.state_preference(&mut response);
            return Ok(response);
        }
        (cells, _) => cells,
    };
    let path = format!("{}/cells", id.path());
    let cells = cells.map(|content| Representation::json(content, path).cached(IMMUTABLE));
    cells.respond(&state, wait_policy, &conditions)
}

/// The stored points as a table, which is written while it is sent.
async fn respond_table(
    state: &SharedState,
    (id, kind): (ResultId, QuestionKind),
    format: Format,
    conditions: &Conditions,
) -> Result<Response, HttpError> {
    let name = format!("{id} cells {}", format.name());
    let text = StreamedText {
        etag: entity_tag(&blake3::hash(name.as_bytes()), None)?,
        vary: "accept",
        media: format.media(),
        file_name: format!("{}-{id:.8}.{}", kind.name().replace('_', "-"), format.name()),
    };
    let about = match text.begin(conditions) {
        Ok(about) => about,
        Err(unmodified) => return Ok(*unmodified),
    };
    let stored = state.results.blob(id, CELLS).await.ok_or(OperationError::Internal)?.bytes;
    // The points are parsed: some times their stored bytes.
    let memory = 3 * stored.len() as u64;
    let table = run_on_pool(move |_| MapTable::new(kind, &stored, format)).await?;
    let pieces = stream::try_unfold(table, |mut table| async move {
        let piece =
            run_on_pool(move |_| table.next().map(|piece| piece.map(|piece| (Bytes::from(piece), table))));
        piece.await.map_err(|error: OperationError| io::Error::other(error))
    });
    let mut response = (about, Body::from_stream(pieces)).into_response();
    response.extensions_mut().insert(UnsharedBytes(memory));
    Ok(response)
}
