//! `/workspace`.

use std::sync::Arc;

use axum::extract::State as Extracted;
use axum::response::Response;

use crate::http::conditional_response::{Conditions, Delivery};
use crate::http::error::{HttpError, LookupError};
use crate::http::extract::{Params, Single};
use crate::http::job_document::JobObject;
use crate::http::negotiation::Accept;
use crate::http::openapi::binary::{Binary, SummaryOrMesh};
use crate::http::openapi::problems::{WorkspaceBodyProblems, WorkspaceQueryProblems};
use crate::http::prefer::Prefer;
use crate::http::result_or_job::{Obtained, Patience};
use crate::http::result_response::{Surface, figures, mesh, respond};
use crate::http::state::{Shared, State};
use crate::operations::family_question::FamilyQuestion;
use crate::operations::question::Question;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::wire::format::MeshFormat;
use crate::wire::query::point_into_query;
use crate::wire::workspace::WorkspaceRequest;
use crate::wire::workspace_query::{MeshQuery, WorkspaceQuery};

/// The answer depends on the published machines, which change only with a restart.
const FOR_A_WHILE: &str = "public, max-age=300";

/// A workspace
///
/// Computes volume, area and bounds of the positions that the working mode reaches within every limit. `format` or
/// Accept (`model/gltf-binary`, `model/stl`, `model/ply`) selects the surface instead, as a watertight mesh coloured by
/// the active limit. `format=json` selects the mesh as JSON; Accept: application/json selects the summary. If the
/// computation takes longer than the wait, the answer is 202 with the job. The header `Prefer: wait=N` sets the wait;
/// `Prefer: respond-async` skips it (RFC 7240).
#[utoipa::path(
    get, path = "/workspace", operation_id = "workspace", tag = "workspace", params(WorkspaceQuery),
    responses(
        (status = 200, description = "The summary or the mesh.", content(
            (SummaryOrMesh = "application/json"), (Binary = "model/gltf-binary"), (Binary = "model/stl"),
            (Binary = "model/ply"),
        )),
        (status = 202, description = "The job that computes the result. The header Location has its path.", body =
            JobObject),
        WorkspaceQueryProblems
    )
)]
pub(crate) async fn get_workspace(
    Extracted(state): Extracted<Shared>,
    Params(query): Params<WorkspaceQuery>,
    accept: Accept,
    prefer: Prefer,
    conditions: Conditions,
) -> Result<Response, HttpError> {
    let wanted = wanted(query.format, &accept)?;
    let question =
        WorkspaceQuestion::new(&query.into_request(), &state.machines).map_err(point_into_query)?;
    let obtained = answer(&state, question, wanted, &prefer.patience).await.map_err(HttpError::in_query)?;
    let fresh = |delivery| Delivery { cache_control: Some(FOR_A_WHILE), ..delivery };
    respond(&state, obtained, fresh, prefer, &conditions)
}

/// A workspace or a family of workspaces, with a custom machine
///
/// Takes the parameters of GET /workspace as JSON. `machine` may be a complete machine object. The service stores the
/// result under its id, and GET returns it. If `tool_length`, `phi1` or `phi2` is a list or a range in steps, the
/// answer is a table of all combinations, and each combination has an id of its own.
#[utoipa::path(
    post, path = "/workspace", operation_id = "workspace_post", tag = "workspace", params(MeshQuery),
    request_body(content = WorkspaceRequest, description = "The workspace or workspaces, and the tolerance."),
    responses(
        (status = 200, description = "The summary, the table or the mesh.", content(
            (SummaryOrMesh = "application/json"), (Binary = "model/gltf-binary"), (Binary = "model/stl"),
            (Binary = "model/ply"),
        )),
        (status = 202, description = "The job that computes the result. The header Location has its path.", body =
            JobObject),
        WorkspaceBodyProblems
    )
)]
pub(crate) async fn post_workspace(
    Extracted(state): Extracted<Shared>,
    Params(query): Params<MeshQuery>,
    accept: Accept,
    prefer: Prefer,
    conditions: Conditions,
    Single(body): Single<WorkspaceRequest>,
) -> Result<Response, HttpError> {
    let obtained = if body.is_family() {
        let question = FamilyQuestion::new(&body, &state.machines)?;
        match query.format {
            Some(_) => return Err(LookupError::Mesh(question.id.to_string()).into()),
            None => accept.choose([("application/json", ())])?,
        }
        figures(&state, &Arc::new(Question::Family(question)), &prefer.patience).await?
    } else {
        let wanted = wanted(query.format, &accept)?;
        let question = WorkspaceQuestion::new(&body, &state.machines)?;
        answer(&state, question, wanted, &prefer.patience).await?
    };
    respond(&state, obtained, |delivery| delivery, prefer, &conditions)
}

/// The mesh's format, or nothing for the summary.
fn wanted(format: Option<MeshFormat>, accept: &Accept) -> Result<Option<MeshFormat>, HttpError> {
    if format.is_some() {
        return Ok(format);
    }
    let meshes =
        [MeshFormat::Glb, MeshFormat::Stl, MeshFormat::Ply].map(|format| (format.media(), Some(format)));
    accept.choose([("application/json", None)].into_iter().chain(meshes))
}

async fn answer(
    state: &State,
    question: WorkspaceQuestion,
    wanted: Option<MeshFormat>,
    patience: &Patience,
) -> Result<Obtained<Delivery>, HttpError> {
    let question = Arc::new(Question::Workspace(question));
    match wanted {
        None => figures(state, &question, patience).await,
        Some(format) => {
            let surface = Surface::of(question.id(), question.kind(), None)?;
            mesh(state, &surface, format, patience, || Ok(question)).await
        }
    }
}
