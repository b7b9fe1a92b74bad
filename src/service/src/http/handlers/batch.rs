//! Batches: `/fk/batch`, `/ik/batch` and `/workspace/contains`.

use axum::body::Bytes;
use axum::extract::State;
use axum::http::header::{CONTENT_TYPE, HeaderName};

use crate::http::error::HttpError;
use crate::http::extractors::BatchBody;
use crate::http::openapi::problem_responses::BatchProblems;
use crate::http::state::SharedState;
use crate::operations::contains::answer_contains;
use crate::operations::forward_batch::answer_fk_batch;
use crate::operations::inverse_batch::answer_ik_batch;
use crate::wire::batch::{FkBatchAnswer, FkBatchNumbers, IkBatchAnswer, IkBatchNumbers};
use crate::wire::contains::{ContainsAnswer, ContainsRequest};

type JsonBytes = ([(HeaderName, &'static str); 1], Bytes);

fn json(body: Bytes) -> JsonBytes {
    ([(CONTENT_TYPE, "application/json")], body)
}

/// Forward kinematics of a batch
///
/// Computes the working solution of each row, in order. If a row is malformed, has no solution or breaks a limit, the
/// answer states this at the index of the row. The other rows are not affected.
#[utoipa::path(
    post, path = "/fk/batch", operation_id = "post_fk_batch", tag = "kinematics",
    request_body(content = FkBatchNumbers, description = "The rows of joints."),
    responses((status = 200, description = "One entry for each row.", body = FkBatchAnswer), BatchProblems)
)]
pub(crate) async fn fk_batch(
    State(state): State<SharedState>,
    batch: BatchBody,
) -> Result<JsonBytes, HttpError> {
    let answer = batch.answer(move |body, _| answer_fk_batch(body, &state.machines, state.limits.rows));
    answer.await.map(json)
}

/// Inverse kinematics of a batch
///
/// Computes the working solution of each row, in order. If a row is malformed, has no solution or breaks a limit, the
/// answer states this at the index of the row. The other rows are not affected.
///
/// With `continuous` the rows are a path: each row continues from the row before, and `jump` marks rows that cannot.
/// POST /toolpath looks ahead, and adds the rows that keep the tool within a tolerance.
#[utoipa::path(
    post, path = "/ik/batch", operation_id = "post_ik_batch", tag = "kinematics",
    request_body(content = IkBatchNumbers, description = "The rows of poses."),
    responses((status = 200, description = "One entry for each row.", body = IkBatchAnswer), BatchProblems)
)]
pub(crate) async fn ik_batch(
    State(state): State<SharedState>,
    batch: BatchBody,
) -> Result<JsonBytes, HttpError> {
    let answer = batch.answer(move |body, _| answer_ik_batch(body, &state.machines, state.limits.rows));
    answer.await.map(json)
}

/// Test whether points belong to a workspace
///
/// Uses the inverse solution and its margins instead of a mesh, so the answer is exact even next to the boundary. The
/// columns have the order of the points. If a point is malformed, the answer states this at the index of the point. The
/// other points are not affected.
#[utoipa::path(
    post, path = "/workspace/contains", operation_id = "post_workspace_contains", tag = "workspace",
    request_body(content = ContainsRequest, description = "The points."),
    responses((status = 200, description = "One entry for each point.", body = ContainsAnswer), BatchProblems)
)]
pub(crate) async fn workspace_contains(
    State(state): State<SharedState>,
    batch: BatchBody,
) -> Result<JsonBytes, HttpError> {
    let answer = batch
        .answer(move |body, observer| answer_contains(body, &state.machines, state.limits.rows, observer));
    answer.await.map(json)
}
