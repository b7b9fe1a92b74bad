//! `/workspace/dexterity` and the points of its map.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;

use crate::http::conditional_response::{Conditions, Delivery, FOR_EVER};
use crate::http::error::{HttpError, LookupError};
use crate::http::extract::Single;
use crate::http::handlers::workspace_results::{Id, kept};
use crate::http::job_document::JobObject;
use crate::http::negotiation::Accept;
use crate::http::openapi::problems::{CellsProblems, DexterityProblems};
use crate::http::prefer::Prefer;
use crate::http::result_or_job::Obtained;
use crate::http::result_response::{figures, respond};
use crate::http::state::Shared;
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
    post, path = "/workspace/dexterity", operation_id = "dexterity", tag = "workspace",
    request_body(content = DexterityBody, description = "The inclinations, the tool and the grid."),
    responses(
        (status = 200, description = "The summary of the map.", body = DexteritySummary),
        (status = 202, description = "The job that computes the result. The header Location has its path.", body =
            JobObject),
        DexterityProblems
    )
)]
pub(crate) async fn post_dexterity(
    State(state): State<Shared>,
    accept: Accept,
    prefer: Prefer,
    conditions: Conditions,
    Single(body): Single<DexterityBody>,
) -> Result<Response, HttpError> {
    accept.choose([("application/json", ())])?;
    let question = Arc::new(Question::Dexterity(DexterityQuestion::new(&body, &state.machines)?));
    let obtained = figures(&state, &question, &prefer.patience).await?;
    respond(&state, obtained, |delivery| delivery, prefer, &conditions)
}

/// The points of a dexterity map
///
/// Returns the intervals of phi1 at each point. The service supports strong ETags, conditional requests and byte
/// ranges.
#[utoipa::path(
    get, path = "/workspace/{id}/cells", operation_id = "dexterity_cells", tag = "workspace",
    params(("id" = String, Path, description = "The id from an answer of /workspace/dexterity.")),
    responses(
        (status = 200, description = "The points.", body = DexterityCells),
        (status = 202, description = "The service evicted the points. This job computes them again.",
            body = JobObject),
        CellsProblems
    )
)]
pub(crate) async fn get_cells(
    State(state): State<Shared>,
    id: Id,
    accept: Accept,
    prefer: Prefer,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let record = kept(&state, id.map_err(|_| HttpError::UnknownPath)?).await?;
    accept.choose([("application/json", ())])?;
    let id = record.id;
    if record.kind != QuestionKind::Dexterity {
        return Err(LookupError::Grid(id.to_string()).into());
    }
    let cells = || state.results.find_blob(id, CELLS);
    let question = state.results.questions.get_or_read(id, &record.question)?;
    let obtained = match state.blob(&question, None, &prefer.patience, cells).await? {
        Obtained::Pending(job) => Obtained::Pending(job),
        Obtained::Ready(content) => Obtained::Ready(Delivery {
            content,
            own: false,
            media: "application/json",
            cache_control: Some(FOR_EVER),
            location: format!("{}/cells", id.path()),
            file_name: None,
        }),
    };
    respond(&state, obtained, |delivery| delivery, prefer, &conditions)
}
