//! `/workspace/dexterity` and the points of its map.

use axum::extract::State;
use axum::response::Response;

use super::sending::{figures, respond};
use super::workspace_results::{Id, kept};
use crate::answers::{DexterityQuestion, Question};
use crate::delivery::{Conditions, Delivery, FOR_EVER};
use crate::error::Error;
use crate::extract::Single;
use crate::negotiation::Accept;
use crate::obtain::Obtained;
use crate::openapi::problems::{CellsProblems, DexterityProblems};
use crate::prefer::Prefer;
use crate::results::CELLS;
use crate::state::Shared;
use crate::wire::dexterity::{DexterityBody, DexterityCells, DexteritySummary};
use crate::wire::job::JobObject;

/// With which inclinations points of the part are reached
///
/// For each point of a grid over the part frame, the exact intervals of phi1 within the asked range that keep every
/// limit; volumes and watertight meshes of what is reachable (with some inclination) and dexterous (with all of them). A
/// long job by nature: `Prefer: respond-async` answers its address at once.
#[utoipa::path(
    post, path = "/workspace/dexterity", operation_id = "dexterity", tag = "workspace",
    request_body(content = DexterityBody, description = "Which inclinations of which tool, on how fine a grid."),
    responses(
        (status = 200, description = "The map in figures.", body = DexteritySummary),
        (status = 202, description = "The job that computes it, at the path in Location.", body = JobObject),
        DexterityProblems
    )
)]
pub(crate) async fn post_dexterity(
    State(state): State<Shared>,
    accept: Accept,
    prefer: Prefer,
    conditions: Conditions,
    Single(body): Single<DexterityBody>,
) -> Result<Response, Error> {
    accept.choose([("application/json", ())])?;
    let question = Question::Dexterity(DexterityQuestion::new(&body, &state.machines)?);
    let obtained = figures(&state, &question, &prefer.patience).await?;
    respond(&state, obtained, |delivery| delivery, prefer, &conditions)
}

/// The points of a dexterity map
///
/// Each point's intervals of phi1. Strong ETags, conditional requests and byte ranges.
#[utoipa::path(
    get, path = "/workspace/{id}/cells", operation_id = "dexterity_cells", tag = "workspace",
    params(("id" = String, Path, description = "The id that /workspace/dexterity answered.")),
    responses(
        (status = 200, description = "The points.", body = DexterityCells),
        (status = 202, description = "The points have made room for others: the job that computes them again.",
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
) -> Result<Response, Error> {
    let record = kept(&state, id.map_err(|_| Error::NoSuchPath)?).await?;
    accept.choose([("application/json", ())])?;
    let (id, question) = (record.question.id(), record.question);
    if !matches!(question, Question::Dexterity(_)) {
        return Err(Error::NoCells(id.to_string()));
    }
    let cells = || state.results.found(id, CELLS);
    let obtained = match state.part(&question, &prefer.patience, cells).await? {
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
