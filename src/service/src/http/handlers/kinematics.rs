//! `/fk` and `/ik`.

use axum::extract::State;
use axum::http::header::{CACHE_CONTROL, CONTENT_TYPE, HeaderName};

use crate::http::conditional_response::UNTIL_RESTART;
use crate::http::error::HttpError;
use crate::http::extractors::{JsonBody, QueryString};
use crate::http::openapi::problem_responses::{BodyProblems, CommonProblems};
use crate::http::state::SharedState;
use crate::operations::forward::answer_fk;
use crate::operations::inverse::answer_ik;
use crate::wire::answer::Answer;
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::query::{FkQuery, IkQuery, point_into_query};
use crate::wire::request::{FkRequest, IkRequest};

const CACHEABLE: (HeaderName, &str) = (CACHE_CONTROL, UNTIL_RESTART);

const JSON: (HeaderName, &str) = (CONTENT_TYPE, "application/json");

/// About the bytes of a solution.
const SOLUTION_BYTES: usize = 2048;

type JsonBytes<const HEADERS: usize> = ([(HeaderName, &'static str); HEADERS], Vec<u8>);

fn write(answer: &Answer) -> Result<Vec<u8>, OperationError> {
    write_json(answer, SOLUTION_BYTES * answer.solutions.len().max(1))
}

/// Forward kinematics
///
/// Computes the poses of the platform and the tool for given slider positions. The answer has every assembly mode, the
/// working modes, or only the feasible ones. theta1 and theta2 add the pose in the part frame.
#[utoipa::path(
    get, path = "/fk", operation_id = "get_fk", tag = "kinematics", params(FkQuery),
    responses((status = 200, description = "The solutions, or the reason why there is none.", body = Answer),
        CommonProblems)
)]
pub(crate) async fn get_fk(
    State(state): State<SharedState>,
    QueryString(query): QueryString<FkQuery>,
) -> Result<JsonBytes<2>, HttpError> {
    let answer = query.into_request().and_then(|request| answer_fk(&request, &state.machines));
    let text = answer.and_then(|answer| write(&answer)).map_err(point_into_query)?;
    Ok(([JSON, CACHEABLE], text))
}

/// Forward kinematics with a custom machine
///
/// Takes the parameters of GET /fk as JSON. `machine` may be a complete machine object.
#[utoipa::path(
    post, path = "/fk", operation_id = "post_fk", tag = "kinematics",
    request_body(content = FkRequest, description = "The joints and the options."),
    responses((status = 200, description = "The solutions, or the reason why there is none.", body = Answer),
        BodyProblems)
)]
pub(crate) async fn post_fk(
    State(state): State<SharedState>,
    JsonBody(request): JsonBody<FkRequest>,
) -> Result<JsonBytes<1>, HttpError> {
    let answer = answer_fk(&request, &state.machines)?;
    Ok(([JSON], write(&answer)?))
}

/// Inverse kinematics
///
/// Computes the joints for a pose of the platform or the tool. The answer has every solution (up to 16 for the
/// platform, up to 24 for the part), the working ones, or only the feasible ones.
#[utoipa::path(
    get, path = "/ik", operation_id = "get_ik", tag = "kinematics", params(IkQuery),
    responses((status = 200, description = "The solutions, or the reason why there is none.", body = Answer),
        CommonProblems)
)]
pub(crate) async fn get_ik(
    State(state): State<SharedState>,
    QueryString(query): QueryString<IkQuery>,
) -> Result<JsonBytes<2>, HttpError> {
    let answer = query.into_request().and_then(|request| answer_ik(&request, &state.machines));
    let text = answer.and_then(|answer| write(&answer)).map_err(point_into_query)?;
    Ok(([JSON, CACHEABLE], text))
}

/// Inverse kinematics with a custom machine
///
/// Takes the parameters of GET /ik as JSON. `machine` may be a complete machine object.
#[utoipa::path(
    post, path = "/ik", operation_id = "post_ik", tag = "kinematics",
    request_body(content = IkRequest, description = "The pose and the options."),
    responses((status = 200, description = "The solutions, or the reason why there is none.", body = Answer),
        BodyProblems)
)]
pub(crate) async fn post_ik(
    State(state): State<SharedState>,
    JsonBody(request): JsonBody<IkRequest>,
) -> Result<JsonBytes<1>, HttpError> {
    let answer = answer_ik(&request, &state.machines)?;
    Ok(([JSON], write(&answer)?))
}
