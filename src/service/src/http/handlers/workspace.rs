//! `/workspace`: summaries and meshes of workspaces and families.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;

use crate::http::conditional_response::{Conditions, Representation};
use crate::http::error::{HttpError, LookupError};
use crate::http::extractors::{JsonBody, QueryString};
use crate::http::job_document::JobObject;
use crate::http::negotiation::Accept;
use crate::http::openapi::body_schemas::{Binary, WorkspaceAnswer};
use crate::http::openapi::problem_responses::{WorkspaceBodyProblems, WorkspaceQueryProblems};
use crate::http::result_or_job::ResultOrJob;
use crate::http::result_representation::{MeshSelection, Surface, mesh_or_job, summary_or_job};
use crate::http::state::{AppState, SharedState};
use crate::http::wait_policy::WaitPolicy;
use crate::operations::family_question::FamilyQuestion;
use crate::operations::question::Question;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::wire::format::MeshFormat;
use crate::wire::query::point_into_query;
use crate::wire::workspace::WorkspaceRequest;
use crate::wire::workspace_query::{MeshQuery, WorkspaceQuery};
use crate::wire::workspace_summary::WorkspaceSummary;

/// The answer depends on the published machines, which change only with a restart.
const CACHEABLE: &str = "public, max-age=300";

/// A workspace
///
/// Computes volume, area and bounds of the positions that the working mode reaches within every limit. `format` or
/// Accept (`model/gltf-binary`, `model/stl`, `model/ply`) selects the surface instead, as a watertight mesh coloured by
/// the active limit. `format=json` selects the mesh as JSON; Accept: application/json selects the summary. If the
/// computation takes longer than the wait, the answer is 202 with the job. The header `Prefer: wait=N` sets the wait;
/// `Prefer: respond-async` skips it (RFC 7240).
#[utoipa::path(
    get, path = "/workspace", operation_id = "get_workspace", tag = "workspace", params(WorkspaceQuery),
    responses(
        (status = 200, description = "The summary or the mesh.", content(
            (WorkspaceSummary = "application/json"), (Binary = "model/gltf-binary"), (Binary = "model/stl"),
            (Binary = "model/ply"),
        )),
        (status = 202, description = "The job that computes the result. The header Location has its path.", body =
            JobObject),
        WorkspaceQueryProblems
    )
)]
pub(crate) async fn get_workspace(
    State(state): State<SharedState>,
    QueryString(query): QueryString<WorkspaceQuery>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let format = chosen_format(query.format, &accept)?;
    let question =
        WorkspaceQuestion::new(&query.into_request(), &state.machines).map_err(point_into_query)?;
    let result = representation_or_job(&state, question, format, &wait_policy).await;
    let result = result.map_err(HttpError::in_query)?.map(|representation| representation.cached(CACHEABLE));
    result.respond(&state, wait_policy, &conditions)
}

/// A workspace or a family of workspaces, with a custom machine
///
/// Takes the parameters of GET /workspace as JSON. `machine` may be a complete machine object. The service stores the
/// result under its id, and GET returns it. If `tool_length`, `phi1` or `phi2` is a list or a range in steps, the
/// answer is a table of all combinations, and each combination has an id of its own.
#[utoipa::path(
    post, path = "/workspace", operation_id = "post_workspace", tag = "workspace", params(MeshQuery),
    request_body(content = WorkspaceRequest, description = "The workspace or workspaces, and the tolerance."),
    responses(
        (status = 200, description = "The summary, the table or the mesh.", content(
            (WorkspaceAnswer = "application/json"), (Binary = "model/gltf-binary"), (Binary = "model/stl"),
            (Binary = "model/ply"),
        )),
        (status = 202, description = "The job that computes the result. The header Location has its path.", body =
            JobObject),
        WorkspaceBodyProblems
    )
)]
pub(crate) async fn post_workspace(
    State(state): State<SharedState>,
    QueryString(query): QueryString<MeshQuery>,
    accept: Accept,
    wait_policy: WaitPolicy,
    conditions: Conditions,
    JsonBody(body): JsonBody<WorkspaceRequest>,
) -> Result<Response, HttpError> {
    let result = if body.is_family() {
        let question = FamilyQuestion::new(&body, &state.machines)?;
        if query.format.is_some() {
            return Err(LookupError::Mesh(question.id.to_string()).into());
        }
        accept.require_json()?;
        summary_or_job(&state, &Arc::new(Question::Family(question)), &wait_policy).await?
    } else {
        let format = chosen_format(query.format, &accept)?;
        let question = WorkspaceQuestion::new(&body, &state.machines)?;
        representation_or_job(&state, question, format, &wait_policy).await?
    };
    result.respond(&state, wait_policy, &conditions)
}

/// The format of the mesh; `None` for the summary.
fn chosen_format(format: Option<MeshFormat>, accept: &Accept) -> Result<Option<MeshFormat>, HttpError> {
    if format.is_some() {
        return Ok(format);
    }
    let meshes =
        [MeshFormat::Glb, MeshFormat::Stl, MeshFormat::Ply].map(|format| (format.media(), Some(format)));
    accept.choose([("application/json", None)].into_iter().chain(meshes))
}

async fn representation_or_job(
    state: &AppState,
    question: WorkspaceQuestion,
    format: Option<MeshFormat>,
    wait_policy: &WaitPolicy,
) -> Result<ResultOrJob<Representation>, HttpError> {
    let question = Arc::new(Question::Workspace(question));
    match format {
        None => summary_or_job(state, &question, wait_policy).await,
        Some(format) => {
            let surface = Surface::of(question.id(), question.kind(), MeshSelection::default())?;
            mesh_or_job(state, &surface, format, wait_policy, || Ok(question)).await
        }
    }
}
