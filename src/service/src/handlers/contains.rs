//! `/workspace/contains`.

use axum::body::Bytes;
use axum::extract::State;
use axum::http::header::{CONTENT_TYPE, HeaderName};

use crate::answers::answer_contains;
use crate::error::Error;
use crate::extract::Batch;
use crate::openapi::problems::BatchProblems;
use crate::state::Shared;
use crate::wire::contains::{ContainsAnswer, ContainsRequest};

/// Which points belong to a workspace
///
/// By the inverse solution and its margins, not by a mesh: exact, also next to the boundary. Columns in the order of
/// the points; one that cannot be read says so in its own place and spoils no other.
#[utoipa::path(
    post, path = "/workspace/contains", operation_id = "workspace_contains", tag = "workspace",
    request_body(content = ContainsRequest, description = "The points."),
    responses((status = 200, description = "One entry for each point.", body = ContainsAnswer), BatchProblems)
)]
pub(crate) async fn post_contains(
    State(state): State<Shared>,
    batch: Batch,
) -> Result<([(HeaderName, &'static str); 1], Bytes), Error> {
    let answer = batch
        .answer(move |body, observer| answer_contains(body, &state.machines, state.limits.rows, observer));
    Ok(([(CONTENT_TYPE, "application/json")], answer.await?))
}
