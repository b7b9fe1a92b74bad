//! `/toolpath/origins`, and the mesh and the slices of a region of origins.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;

use crate::http::conditional_response::{Conditions, IMMUTABLE};
use crate::http::error::{HttpError, JobError, LookupError};
use crate::http::extractors::{BatchBody, PathParameter, QueryString};
use crate::http::handlers::results::stored_of_toolpath;
use crate::http::handlers::toolpath::about_program;
use crate::http::job_document::JobObject;
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::{Binary, MeshObject, Text};
use crate::http::openapi::problem_responses::{RegionProblems, ToolpathProblems};
use crate::http::result_or_job::ResultOrJob;
use crate::http::result_representation::{
    MeshSelection, Surface, mesh_format, mesh_or_job, slice_file, slice_format, summary_or_job,
};
use crate::http::state::{AppState, SharedState};
use crate::http::wait_policy::WaitPolicy;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::origins::slice_of_origins;
use crate::operations::origins_question::CheckedOrigins;
use crate::operations::question::Question;
use crate::operations::question_text::QuestionKind;
use crate::operations::results::{MESH, Record, hashed, unpack_mesh};
use crate::operations::toolpath_request::read_fields;
use crate::wire::error::OperationError;
use crate::wire::origins::{OriginsBody, OriginsSliceQuery, OriginsSummary};
use crate::wire::parse::parse_body;
use crate::wire::query::point_into_query;
use crate::wire::slice::SliceObject;
use crate::wire::workspace_query::MeshQuery;

/// The region of origins of a program
///
/// Computes the set of all x, y, z of `setup`, with all else fixed, at which the machine can follow the whole program:
/// its volume and a watertight mesh. The job is divided into parts, as that of a dexterity map. With `Prefer:
/// respond-async` the service returns its address immediately. GET /toolpath/{id} returns the summary again.
#[utoipa::path(
    post, path = "/toolpath/origins", operation_id = "post_origins", tag = "toolpath",
    request_body(content = OriginsBody, content_type = "application/json", description =
        "The program with its tool and the rotation of its frame, and the grid."),
    responses(
        (status = 200, description = "The summary of the region.", body = OriginsSummary),
        (status = 202, description = "The job that computes the result. The header Location has its path.", body =
            JobObject),
        ToolpathProblems
    )
)]
pub(crate) async fn post_origins(
    State(state): State<SharedState>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
    body: BatchBody,
) -> Result<Response, HttpError> {
    accept.require_json()?;
    let shared = Arc::clone(&state);
    let read = move |body: &[u8]| {
        let request: OriginsBody = parse_body(body)?;
        let (checked, source) = read_fields(&request.toolpath, &shared.machines)?;
        let fields = CheckedOrigins::new(&request.more, &checked)?;
        Ok((checked, source, fields))
    };
    let (checked, source, fields) = body.read(read).await?;
    let of = |toolpath| fields.question(toolpath);
    let question = about_program(&state, checked, source, of, |question| question.id).await?;
    let question = Arc::new(Question::Origins(Box::new(question)));
    summary_or_job(&state, &question, &wait_policy).await?.respond(&state, wait_policy, &conditions)
}

/// The mesh of a region of origins
///
/// Returns a watertight mesh. The path without the extension selects the format by `format` or Accept; its default is
/// GLB. The service supports strong ETags, conditional requests and byte ranges.
#[utoipa::path(
    get, path = "/toolpath/{id}/mesh", operation_id = "get_origins_mesh", tag = "toolpath",
    params(("id" = String, Path, description = "The id from an answer of /toolpath/origins."), MeshQuery),
    responses(
        (status = 200, description = "The mesh.", content(
            (Binary = "model/gltf-binary"), (Binary = "model/stl"), (Binary = "model/ply"),
            (MeshObject = "application/json"),
        )),
        (status = 202, description = "The service evicted the mesh. This job computes it again.",
            body = JobObject),
        RegionProblems
    )
)]
pub(crate) async fn get_origins_mesh(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    QueryString(query): QueryString<MeshQuery>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let format = mesh_format(&accept, query.format)?;
    let record = region(&state, id).await?;
    let surface = Surface::of(record.id, record.kind, MeshSelection::default())?;
    let question = || state.results.questions.get_or_read(record.id, &record.question);
    let mesh = mesh_or_job(&state, &surface, format, &wait_policy, question).await?;
    mesh.map(|mesh| mesh.cached(IMMUTABLE)).respond(&state, wait_policy, &conditions)
}

/// Slice of a region of origins
///
/// Returns the cut of the region's mesh with a plane of constant z: polygons with holes as JSON, as a drawing (SVG) or
/// for CAD (DXF). The path without the extension selects the format by `format` or Accept.
#[utoipa::path(
    get, path = "/toolpath/{id}/slice", operation_id = "get_origins_slice", tag = "toolpath",
    params(("id" = String, Path, description = "The id from an answer of /toolpath/origins."), OriginsSliceQuery),
    responses(
        (status = 200, description = "The slice.", content(
            (SliceObject = "application/json"), (Text = "image/svg+xml"), (Text = "image/vnd.dxf"),
            (Text = "application/dxf"),
        )),
        (status = 202, description = "The service evicted the mesh. This job computes it again.",
            body = JobObject),
        RegionProblems
    )
)]
pub(crate) async fn get_origins_slice(
    State(state): State<SharedState>,
    PathParameter(id): PathParameter,
    QueryString(query): QueryString<OriginsSliceQuery>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let OriginsSliceQuery { z, format } = query;
    let (format, media) = slice_format(&accept, format)?;
    let record = region(&state, id).await?;
    let id = record.id;
    let question = state.results.questions.get_or_read(id, &record.question)?;
    let Question::Origins(origins) = &*question else { return Err(OperationError::Internal.into()) };
    let cell = origins.cell;
    let find = || state.results.find_blob(id, MESH);
    if let ResultOrJob::Job(job) = state.blob_or_job(&question, &wait_policy, None, find).await? {
        return ResultOrJob::Job(job).respond(&state, wait_policy, &conditions);
    }
    let packed = state.results.blob(id, MESH).await.ok_or(JobError::ResultTooLarge)?;
    let slice = run_on_pool(move |_| {
        let mesh = unpack_mesh(&packed).ok_or(OperationError::Internal)?;
        slice_of_origins(id, cell, &mesh, z, format).map(hashed)
    });
    let slice = slice.await.map_err(point_into_query)?;
    slice_file((id, record.kind), z, (format, media), slice).respond(&conditions)
}

/// The record of a stored region of origins.
async fn region(state: &AppState, id: String) -> Result<Record, LookupError> {
    let record = stored_of_toolpath(state, id, QuestionKind::is_of_toolpath).await?;
    match record.kind {
        QuestionKind::Origins => Ok(record),
        _ => Err(LookupError::Region(record.id.to_string())),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;
