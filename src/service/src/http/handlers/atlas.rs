//! `/atlas`.

use axum::extract::State;
use axum::response::Response;

use crate::http::client::Client;
use crate::http::conditional_response::{Conditions, Representation, UNTIL_RESTART};
use crate::http::error::HttpError;
use crate::http::extractors::{JsonBody, QueryString};
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::Text;
use crate::http::openapi::problem_responses::{AtlasBodyProblems, AtlasProblems};
use crate::http::result_representation::slice_format;
use crate::http::state::SharedState;
use crate::limits::response_memory::bytes_with_permit;
use crate::operations::atlas::answer_atlas;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::results::hashed;
use crate::wire::atlas::AtlasObject;
use crate::wire::atlas_query::{AtlasBody, AtlasFormatQuery, AtlasQuery};
use crate::wire::error::OperationError;
use crate::wire::format::SliceFormat;

/// Atlas of solutions
///
/// Computes in which parts of a plane the parallel module has how many solutions. The number of inverse solutions
/// depends on x and y of the platform only (space `platform`), the number of forward solutions on rho2 - rho1 and
/// rho3 - rho1 only (space `joints`). The answer has the curves on which solutions merge, their special points, and the
/// regions between them with their numbers of solutions, as JSON, as a drawing (SVG) or for CAD (DXF). Limits of the
/// machine, such as strokes and joint cones, play no part. The path without the extension selects the format by
/// `format` or Accept.
#[utoipa::path(
    get, path = "/atlas", operation_id = "get_atlas", tag = "kinematics", params(AtlasQuery),
    responses(
        (status = 200, description = "The atlas.", content(
            (AtlasObject = "application/json"), (Text = "image/svg+xml"), (Text = "image/vnd.dxf"),
            (Text = "application/dxf"),
        )),
        AtlasProblems
    )
)]
pub(crate) async fn get_atlas(
    State(state): State<SharedState>,
    client: Client,
    QueryString(query): QueryString<AtlasQuery>,
    accept: Accept,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let format = slice_format(&accept, query.format)?;
    let answer = answer(state, &client, query.into_body(), format).await.map_err(HttpError::in_query)?;
    answer.cached(UNTIL_RESTART).respond(&conditions)
}

/// Atlas of solutions of a custom machine
///
/// Takes the parameters of GET /atlas as JSON. `machine` may be a complete machine object. The path without the
/// extension selects the format by `format` or Accept.
#[utoipa::path(
    post, path = "/atlas", operation_id = "post_atlas", tag = "kinematics", params(AtlasFormatQuery),
    request_body(content = AtlasBody, description = "The machine and the plane."),
    responses(
        (status = 200, description = "The atlas.", content(
            (AtlasObject = "application/json"), (Text = "image/svg+xml"), (Text = "image/vnd.dxf"),
            (Text = "application/dxf"),
        )),
        AtlasBodyProblems
    )
)]
pub(crate) async fn post_atlas(
    State(state): State<SharedState>,
    client: Client,
    QueryString(query): QueryString<AtlasFormatQuery>,
    accept: Accept,
    conditions: Conditions,
    JsonBody(body): JsonBody<AtlasBody>,
) -> Result<Response, HttpError> {
    let format = slice_format(&accept, query.format)?;
    answer(state, &client, body, format).await?.respond(&conditions)
}

/// The atlas in a format. It takes a permit of the batches until it is sent: an atlas is as much work as a batch.
async fn answer(
    state: SharedState,
    client: &Client,
    body: AtlasBody,
    (format, media): (SliceFormat, &'static str),
) -> Result<Representation, HttpError> {
    let permit = state.admission.batches.take(client.quota())?;
    let file_name = format!("atlas-{}.{}", body.space.name(), format.name());
    let answer = run_on_pool(move |observer| {
        let bytes = answer_atlas(&body, &state.machines, format, observer)?;
        Ok::<_, OperationError>(hashed(bytes_with_permit(bytes, permit)))
    });
    Ok(Representation {
        content: answer.await?.into(),
        is_unshared: true,
        media,
        cache_control: None,
        location: None,
        file_name: Some(file_name),
    })
}
