//! Batches: `/fk/batch`, `/ik/batch` and `/workspace/contains`.

use axum::body::Bytes;
use axum::extract::{FromRequest, Request, State};
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};

use crate::http::client::Client;
use crate::http::error::HttpError;
use crate::http::extractors::{BatchBody, QueryString};
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::{Binary, Text};
use crate::http::openapi::problem_responses::BatchProblems;
use crate::http::row_stream::{answer_rows, formats, refuse_parameters};
use crate::http::state::SharedState;
use crate::operations::contains::answer_contains;
use crate::operations::contains_columns::ContainsColumns;
use crate::operations::forward_batch::answer_fk_batch;
use crate::operations::forward_columns::ForwardColumns;
use crate::operations::inverse_batch::answer_ik_batch;
use crate::operations::inverse_columns::InverseColumns;
use crate::wire::batch::{FkBatchAnswer, FkBatchNumbers, IkBatchAnswer, IkBatchNumbers};
use crate::wire::contains::{ContainsAnswer, ContainsRequest};
use crate::wire::error::OperationError;
use crate::wire::machine_ref::MachineRef;
use crate::wire::query::point_into_query;
use crate::wire::row_query::{ContainsRowsQuery, FkRowsQuery, IkRowsQuery};
use crate::wire::workspace::WorkspaceRequest;

pub(crate) fn json(body: Bytes) -> Response {
    ([(CONTENT_TYPE, "application/json")], body).into_response()
}

/// The JSON body of a batch.
pub(crate) async fn document(request: Request, state: &SharedState) -> Result<BatchBody, HttpError> {
    refuse_parameters(&request)?;
    BatchBody::from_request(request, state).await
}

/// The error of what stands in the query.
pub(crate) fn in_query(error: OperationError) -> HttpError {
    point_into_query(error).into()
}

/// Forward kinematics of a batch
///
/// Computes the working solution of each row, in order. If a row is malformed, has no solution or breaks a limit, the
/// answer states this at the index of the row. The other rows are not affected.
///
/// Instead of JSON the body may be a stream of Apache Arrow, CSV or NDJSON, with the columns rho1, rho2, rho3 and
/// perhaps theta1 and theta2 in any order; the query then has what is not a row. The service answers rows while later
/// rows arrive, and any number of them. Other columns are passed on; a column of the answer
/// replaces one of its name.
#[utoipa::path(
    post, path = "/fk/batch", operation_id = "post_fk_batch", tag = "kinematics", params(FkRowsQuery),
    request_body(description = "The rows of joints.", content(
        (FkBatchNumbers = "application/json"), (Binary = "application/vnd.apache.arrow.stream"),
        (Text = "text/csv"), (Text = "application/x-ndjson"),
    )),
    responses((status = 200, description = "One entry for each row.", content(
        (FkBatchAnswer = "application/json"), (Binary = "application/vnd.apache.arrow.stream"),
        (Text = "text/csv"), (Text = "application/x-ndjson"),
    )), BatchProblems)
)]
pub(crate) async fn fk_batch(
    State(state): State<SharedState>,
    client: Client,
    accept: Accept,
    QueryString(query): QueryString<FkRowsQuery>,
    request: Request,
) -> Result<Response, HttpError> {
    if let Some(formats) = formats(request.headers(), query.format, &accept)? {
        let machine = MachineRef::of_parameter(&query.machine).map_err(in_query)?;
        let rowless = FkBatchNumbers { machine, ..query.into() };
        let answer = ForwardColumns::new(&rowless, &state.machines).map_err(in_query)?;
        return answer_rows(&state, client, request, formats, Box::new(answer)).await;
    }
    let batch = document(request, &state).await?;
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
///
/// Instead of JSON the body may be a stream of Apache Arrow, CSV or NDJSON, with the columns x, y, z and phi1, phi2 or
/// i, j, k in any order; the query then has what is not a row. The service answers rows while later rows arrive, and
/// any number of them. Other columns are passed on; a column of the answer
/// replaces one of its name.
#[utoipa::path(
    post, path = "/ik/batch", operation_id = "post_ik_batch", tag = "kinematics", params(IkRowsQuery),
    request_body(description = "The rows of poses.", content(
        (IkBatchNumbers = "application/json"), (Binary = "application/vnd.apache.arrow.stream"),
        (Text = "text/csv"), (Text = "application/x-ndjson"),
    )),
    responses((status = 200, description = "One entry for each row.", content(
        (IkBatchAnswer = "application/json"), (Binary = "application/vnd.apache.arrow.stream"),
        (Text = "text/csv"), (Text = "application/x-ndjson"),
    )), BatchProblems)
)]
pub(crate) async fn ik_batch(
    State(state): State<SharedState>,
    client: Client,
    accept: Accept,
    QueryString(query): QueryString<IkRowsQuery>,
    request: Request,
) -> Result<Response, HttpError> {
    if let Some(formats) = formats(request.headers(), query.format, &accept)? {
        let machine = MachineRef::of_parameter(&query.machine).map_err(in_query)?;
        let rowless = IkBatchNumbers { machine, ..query.into() };
        let answer = InverseColumns::new(&rowless, &state.machines).map_err(in_query)?;
        return answer_rows(&state, client, request, formats, Box::new(answer)).await;
    }
    let batch = document(request, &state).await?;
    let answer = batch.answer(move |body, _| answer_ik_batch(body, &state.machines, state.limits.rows));
    answer.await.map(json)
}

/// Test whether points belong to a workspace
///
/// Uses the inverse solution and its margins instead of a mesh, so the answer is exact even next to the boundary. The
/// columns have the order of the points. If a point is malformed, the answer states this at the index of the point. The
/// other points are not affected.
///
/// Instead of JSON the body may be a stream of Apache Arrow, CSV or NDJSON, with the columns x, y and z in any order;
/// the query then has what is not a point. The service answers points while later points arrive, and any number of
/// them. Other columns are passed on; a column of the answer
/// replaces one of its name.
#[utoipa::path(
    post, path = "/workspace/contains", operation_id = "post_workspace_contains", tag = "workspace",
    params(ContainsRowsQuery),
    request_body(description = "The points.", content(
        (ContainsRequest = "application/json"), (Binary = "application/vnd.apache.arrow.stream"),
        (Text = "text/csv"), (Text = "application/x-ndjson"),
    )),
    responses((status = 200, description = "One entry for each point.", content(
        (ContainsAnswer = "application/json"), (Binary = "application/vnd.apache.arrow.stream"),
        (Text = "text/csv"), (Text = "application/x-ndjson"),
    )), BatchProblems)
)]
pub(crate) async fn workspace_contains(
    State(state): State<SharedState>,
    client: Client,
    accept: Accept,
    QueryString(query): QueryString<ContainsRowsQuery>,
    request: Request,
) -> Result<Response, HttpError> {
    if let Some(formats) = formats(request.headers(), query.format, &accept)? {
        let machine = MachineRef::of_parameter(&query.machine).map_err(in_query)?;
        let rowless = WorkspaceRequest { machine, ..query.into() };
        let answer = ContainsColumns::new(&rowless, &state.machines).map_err(in_query)?;
        return answer_rows(&state, client, request, formats, Box::new(answer)).await;
    }
    let batch = document(request, &state).await?;
    let answer = batch
        .answer(move |body, observer| answer_contains(body, &state.machines, state.limits.rows, observer));
    answer.await.map(json)
}
