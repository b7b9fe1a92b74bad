//! `/fk` and `/ik`.

use axum::Json;
use axum::extract::State;
use axum::http::header::{CACHE_CONTROL, HeaderName};

use crate::answers::{answer_fk, answer_ik};
use crate::error::Error;
use crate::extract::{Params, Single};
use crate::openapi::problems::{BodyProblems, QueryProblems};
use crate::state::Shared;
use crate::wire::answer::Answer;
use crate::wire::query::{FkQuery, IkQuery, point_into_query};
use crate::wire::request::{FkRequest, IkRequest};

/// An answer depends on its URL and on the published machines, which change only with a restart.
const CACHEABLE: [(HeaderName, &str); 1] = [(CACHE_CONTROL, "public, max-age=300")];

type Cacheable = ([(HeaderName, &'static str); 1], Json<Answer>);

/// Forward kinematics
///
/// Where platform, tool and part are for given slider positions: every assembly mode, the working one, or only what
/// breaks no limit. theta1 and theta2 add the pose in the table frame.
#[utoipa::path(
    get, path = "/fk", operation_id = "fk", tag = "kinematics", params(FkQuery),
    responses((status = 200, description = "The solutions, or why there are none.", body = Answer), QueryProblems)
)]
pub(crate) async fn get_fk(
    State(state): State<Shared>,
    Params(query): Params<FkQuery>,
) -> Result<Cacheable, Error> {
    let answer = query.into_request().and_then(|request| answer_fk(&request, &state.machines));
    answer.map(|answer| (CACHEABLE, Json(answer))).map_err(point_into_query)
}

/// Forward kinematics, with a machine of one's own
///
/// The question of GET /fk as JSON; `machine` may be a whole machine.
#[utoipa::path(
    post, path = "/fk", operation_id = "fk_post", tag = "kinematics",
    request_body(content = FkRequest, description = "The joints, and what is wanted."),
    responses((status = 200, description = "The solutions, or why there are none.", body = Answer), BodyProblems)
)]
pub(crate) async fn post_fk(
    State(state): State<Shared>,
    Single(request): Single<FkRequest>,
) -> Result<Json<Answer>, Error> {
    answer_fk(&request, &state.machines).map(Json)
}

/// Inverse kinematics
///
/// Which joints bring platform, tool or part to a pose: every solution (up to sixteen for the platform, up to 24 for
/// the part), the working one, or only what breaks no limit.
#[utoipa::path(
    get, path = "/ik", operation_id = "ik", tag = "kinematics", params(IkQuery),
    responses((status = 200, description = "The solutions, or why there are none.", body = Answer), QueryProblems)
)]
pub(crate) async fn get_ik(
    State(state): State<Shared>,
    Params(query): Params<IkQuery>,
) -> Result<Cacheable, Error> {
    let answer = query.into_request().and_then(|request| answer_ik(&request, &state.machines));
    answer.map(|answer| (CACHEABLE, Json(answer))).map_err(point_into_query)
}

/// Inverse kinematics, with a machine of one's own
///
/// The question of GET /ik as JSON; `machine` may be a whole machine.
#[utoipa::path(
    post, path = "/ik", operation_id = "ik_post", tag = "kinematics",
    request_body(content = IkRequest, description = "The pose, and what is wanted."),
    responses((status = 200, description = "The solutions, or why there are none.", body = Answer), BodyProblems)
)]
pub(crate) async fn post_ik(
    State(state): State<Shared>,
    Single(request): Single<IkRequest>,
) -> Result<Json<Answer>, Error> {
    answer_ik(&request, &state.machines).map(Json)
}
