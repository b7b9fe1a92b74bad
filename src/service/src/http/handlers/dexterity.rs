//! `/workspace/dexterity` and the points of its map.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;

use crate::http::conditional_response::{Conditions, IMMUTABLE, Representation};
use crate::http::error::{HttpError, LookupError};
use crate::http::extractors::{JsonBody, PathParameter};
use crate::http::handlers::results::record;
use crate::http::job_document::JobObject;
use crate::http::negotiation::Accept;
use crate::http::openapi::problem_responses::{CellsProblems, DexterityProblems};
use crate::http::result_representation::summary_or_job;
use crate::http::state::SharedState;
use crate::http::wait_policy::WaitPolicy;
use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::question::Question;
use crate::operations::question_text::QuestionKind;
use crate::operations::results::CELLS;
use crate::wire::dexterity::{DexterityBody, DexterityCells, DexteritySummary};

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

/// The points of a dexterity map
///
/// Returns the intervals of phi1 at each point. The service supports strong ETags, conditional requests and byte
/// ranges.
#[utoipa::path(
    get, path = "/workspace/{id}/cells", operation_id = "get_dexterity_cells", tag = "workspace",
    params(("id" = String, Path, description = "The id from an answer of /workspace/dexterity.")),
    responses(
        (status = 200, description = "The points.", body = DexterityCells),
        (status = 202, description = "The service evicted the points. This job computes them again.",
            body = JobObject),
        CellsProblems
    )
)]
pub(crate) async fn get_cells(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let record = record(&state, id).await?;
    accept.require_json()?;
    let id = record.id;
    if record.kind != QuestionKind::Dexterity {
        return Err(LookupError::Grid(id.to_string()).into());
    }
    let find = || state.results.find_blob(id, CELLS);
    let question = state.results.questions.get_or_read(id, &record.question)?;
    let cells = state.blob_or_job(&question, &wait_policy, None, find).await?;
    let path = format!("{}/cells", id.path());
    let cells = cells.map(|content| Representation::json(content, path).cached(IMMUTABLE));
    cells.respond(&state, wait_policy, &conditions)
}
