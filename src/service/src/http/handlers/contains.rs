//! `/workspace/contains`.

use axum::body::Bytes;
use axum::extract::State;
use axum::http::header::{CONTENT_TYPE, HeaderName};

use crate::http::error::HttpError;
use crate::http::extract::Batch;
use crate::http::openapi::problems::BatchProblems;
use crate::http::state::Shared;
use crate::operations::contains::answer_contains;
use crate::wire::contains::{ContainsAnswer, ContainsRequest};

/// Test whether points belong to a workspace
///
/// Uses the inverse solution and its margins instead of a mesh, so the answer is exact even next to the boundary. The
/// columns have the order of the points. If a point is malformed, the answer states this at the index of the point. The
/// other points are not affected.
#[utoipa::path(
    post, path = "/workspace/contains", operation_id = "workspace_contains", tag = "workspace",
    request_body(content = ContainsRequest, description = "The points."),
    responses((status = 200, description = "One entry for each point.", body = ContainsAnswer), BatchProblems)
)]
pub(crate) async fn post_contains(
    State(state): State<Shared>,
    batch: Batch,
) -> Result<([(HeaderName, &'static str); 1], Bytes), HttpError> {
    let answer = batch
        .answer(move |body, observer| answer_contains(body, &state.machines, state.limits.rows, observer));
    Ok(([(CONTENT_TYPE, "application/json")], answer.await?))
}
