//! `/workspace/{id}`: stored results. The bytes of a result never change.

use axum::extract::State;
use axum::response::Response;

use crate::http::conditional_response::{Conditions, IMMUTABLE};
use crate::http::error::{HttpError, LookupError};
use crate::http::extractors::{PathParameter, QueryString};
use crate::http::job_document::JobObject;
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::{Binary, MeshObject, Summary, Text};
use crate::http::openapi::problem_responses::{MeshProblems, SliceProblems, SummaryProblems};
use crate::http::result_representation::{
    MeshSelection, Surface, mesh_format, mesh_or_job, slice_file, slice_format, summary,
};
use crate::http::state::{AppState, SharedState};
use crate::http::wait_policy::WaitPolicy;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::question::Question;
use crate::operations::question_text::QuestionKind;
use crate::operations::results::{Record, hashed};
use crate::operations::slice::answer_slice;
use crate::wire::error::OperationError;
use crate::wire::query::point_into_query;
use crate::wire::slice::SliceObject;
use crate::wire::workspace_query::{SliceQuery, StoredMeshQuery};

/// Summary of a computed workspace
///
/// Returns the answer that /workspace gave with this id. The service evicts results when it needs space; if you repeat
/// the request to /workspace, it returns the same id and the same bytes. The id is a hash of the request, so a client
/// that knows the id knows the request. Therefore any key may read the result.
#[utoipa::path(
    get, path = "/workspace/{id}", operation_id = "get_workspace_summary", tag = "workspace",
    params(("id" = String, Path, description = "The id from an answer of /workspace.")),
    responses(
        (status = 200, description = "The summary of a workspace or a map, or the table of a family.", body =
            Summary),
        SummaryProblems
    )
)]
pub(crate) async fn get_summary(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    accept: Accept,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let record = record(&state, id).await?;
    if record.kind.is_of_toolpath() {
        return Err(LookupError::Result(record.id.to_string()).into());
    }
    summary(&state, record).cached(IMMUTABLE).respond(&conditions)
}

/// The mesh of a computed workspace
///
/// Returns a watertight mesh within the tolerance of the true surface. Each triangle has the constraint that is active
/// there; in an error map it has the band of the greatest error at its corners. The path without the extension selects
/// the format by `format` or Accept; its default is GLB. The service supports strong ETags, conditional requests and
/// byte ranges.
#[utoipa::path(
    get, path = "/workspace/{id}/mesh", operation_id = "get_workspace_mesh", tag = "workspace",
    params(("id" = String, Path, description = "The id from an answer of /workspace."), StoredMeshQuery),
    responses(
        (status = 200, description = "The mesh.", content(
            (Binary = "model/gltf-binary"), (Binary = "model/stl"), (Binary = "model/ply"),
            (MeshObject = "application/json"),
        )),
        (status = 202, description = "The service evicted the mesh. This job computes it again.",
            body = JobObject),
        MeshProblems
    )
)]
pub(crate) async fn get_mesh(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    QueryString(query): QueryString<StoredMeshQuery>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let format = mesh_format(&accept, query.format)?;
    let record = record(&state, id).await?;
    if record.kind == QuestionKind::Origins {
        return Err(LookupError::Result(record.id.to_string()).into());
    }
    let surface = Surface::of(record.id, record.kind, MeshSelection { set: query.set, error: query.error })?;
    let question = || state.results.questions.get_or_read(record.id, &record.question);
    let mesh = mesh_or_job(&state, &surface, format, &wait_policy, question).await?;
    mesh.map(|mesh| mesh.cached(IMMUTABLE)).respond(&state, wait_policy, &conditions)
}

/// Slice of a computed workspace
///
/// Returns the cut of a workspace with a plane of constant z: polygons with holes, optionally with lines of constant
/// alpha (for the platform the ellipses of Eq (16)), as JSON, as a drawing (SVG) or for CAD (DXF). The slice is within
/// the workspace's tolerance of the true boundary. The service does not use the mesh for it. The path without the
/// extension selects the format by `format` or Accept.
#[utoipa::path(
    get, path = "/workspace/{id}/slice", operation_id = "get_workspace_slice", tag = "workspace",
    params(("id" = String, Path, description = "The id from an answer of /workspace."), SliceQuery),
    responses(
        (status = 200, description = "The slice.", content(
            (SliceObject = "application/json"), (Text = "image/svg+xml"), (Text = "image/vnd.dxf"),
            (Text = "application/dxf"),
        )),
        SliceProblems
    )
)]
pub(crate) async fn get_slice(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    QueryString(query): QueryString<SliceQuery>,
    accept: Accept,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let SliceQuery { z, alpha, format } = query;
    let (format, media) = slice_format(&accept, format)?;
    let Record { id, kind, question, inclination, .. } = record(&state, id).await?;
    if kind != QuestionKind::Workspace {
        return Err(LookupError::Slice(id.to_string()).into());
    }
    let question = state.results.questions.get_or_read(id, &question)?;
    let slice = run_on_pool(move |observer| match &*question {
        Question::Workspace(question) => {
            answer_slice(question, inclination, z, &alpha, format, observer).map(hashed)
        }
        _ => Err(OperationError::Internal),
    });
    let slice = slice.await.map_err(point_into_query)?;
    slice_file((id, kind), z, (format, media), slice).respond(&conditions)
}

/// The record of a stored result.
pub(crate) async fn record(state: &AppState, id: String) -> Result<Record, LookupError> {
    match id.parse() {
        Ok(known) => state.results.record(known).await.ok_or(LookupError::Result(id)),
        Err(_) => Err(LookupError::Result(id)),
    }
}

/// The record of a stored tool path.
pub(crate) async fn stored_toolpath(state: &AppState, id: String) -> Result<Record, LookupError> {
    stored_of_toolpath(state, id, |kind| kind == QuestionKind::Toolpath).await
}

/// The record of a stored result below `/toolpath` of an admitted kind.
pub(crate) async fn stored_of_toolpath(
    state: &AppState,
    id: String,
    admits: impl Fn(QuestionKind) -> bool,
) -> Result<Record, LookupError> {
    match record(state, id).await {
        Ok(record) if admits(record.kind) => Ok(record),
        Ok(record) => Err(LookupError::Toolpath(record.id.to_string())),
        Err(LookupError::Result(id)) => Err(LookupError::Toolpath(id)),
        Err(other) => Err(other),
    }
}
