//! `/workspace`.

use std::sync::Arc;

use axum::extract::State;
use axum::response::Response;

use crate::answers::{Workspace, WorkspaceQuestion, compute_workspace, write_mesh};
use crate::delivery::{Conditions, Delivery};
use crate::error::Error;
use crate::extract::{Params, Single};
use crate::negotiation::Accept;
use crate::openapi::binary::{Binary, SummaryOrMesh};
use crate::openapi::problems::{WorkspaceBodyProblems, WorkspaceQueryProblems};
use crate::results::Content;
use crate::state::Shared;
use crate::wire::format::MeshFormat;
use crate::wire::query::point_into_query;
use crate::wire::workspace::WorkspaceRequest;
use crate::wire::workspace_query::{MeshQuery, WorkspaceQuery};
use crate::workers::{on_workers, on_workers_while_waited_for};

/// The answer depends on the published machines, which change only with a restart.
const FOR_A_WHILE: &str = "public, max-age=300";

/// A workspace
///
/// Volume, area and bounds of the positions that the working mode reaches within every limit; or, by `format` or
/// Accept (`model/gltf-binary`, `model/stl`, `model/ply`), its surface as a watertight mesh, coloured by what limits
/// it. `format=json` is the mesh as JSON, Accept: application/json the summary.
#[utoipa::path(
    get, path = "/workspace", operation_id = "workspace", tag = "workspace", params(WorkspaceQuery),
    responses(
        (status = 200, description = "The summary, or the mesh.", content(
            (SummaryOrMesh = "application/json"), (Binary = "model/gltf-binary"), (Binary = "model/stl"),
            (Binary = "model/ply"),
        )),
        WorkspaceQueryProblems
    )
)]
pub(crate) async fn get_workspace(
    State(state): State<Shared>,
    Params(query): Params<WorkspaceQuery>,
    accept: Accept,
    conditions: Conditions,
) -> Result<Response, Error> {
    let wanted = wanted(query.format, &accept)?;
    let question =
        WorkspaceQuestion::new(&query.into_request(), &state.machines).map_err(point_into_query)?;
    let delivery = answer(&state, question, wanted).await.map_err(point_into_query)?;
    Delivery { cache_control: Some(FOR_A_WHILE), ..delivery }.answer(&conditions)
}

/// A workspace, of a machine of one's own
///
/// The question of GET /workspace as JSON; `machine` may be a whole machine. The result is then kept for a while
/// under its id, for GET.
#[utoipa::path(
    post, path = "/workspace", operation_id = "workspace_post", tag = "workspace", params(MeshQuery),
    request_body(content = WorkspaceRequest, description = "Which workspace, how exactly."),
    responses(
        (status = 200, description = "The summary, or the mesh.", content(
            (SummaryOrMesh = "application/json"), (Binary = "model/gltf-binary"), (Binary = "model/stl"),
            (Binary = "model/ply"),
        )),
        WorkspaceBodyProblems
    )
)]
pub(crate) async fn post_workspace(
    State(state): State<Shared>,
    Params(query): Params<MeshQuery>,
    accept: Accept,
    conditions: Conditions,
    Single(request): Single<WorkspaceRequest>,
) -> Result<Response, Error> {
    let wanted = wanted(query.format, &accept)?;
    let question = WorkspaceQuestion::new(&request, &state.machines)?;
    answer(&state, question, wanted).await?.answer(&conditions)
}

/// The mesh's format, or nothing for the summary.
fn wanted(format: Option<MeshFormat>, accept: &Accept) -> Result<Option<MeshFormat>, Error> {
    if format.is_some() {
        return Ok(format);
    }
    let meshes =
        [MeshFormat::Glb, MeshFormat::Stl, MeshFormat::Ply].map(|format| (format.media(), Some(format)));
    accept.choose([("application/json", None)].into_iter().chain(meshes))
}

async fn answer(
    state: &Shared,
    question: WorkspaceQuestion,
    wanted: Option<MeshFormat>,
) -> Result<Delivery, Error> {
    let id = question.id.clone();
    let compute = on_workers_while_waited_for(move |observer| compute_workspace(question, observer));
    let workspace = state.results.workspace(&id, compute).await?;
    match wanted {
        None => Ok(summary(&workspace)),
        Some(format) => {
            let content = state.results.file(&id, format, written(workspace, format)).await?;
            Ok(mesh(&id, format, content))
        }
    }
}

/// Writes a workspace's mesh on the worker threads.
pub(super) async fn written(workspace: Arc<Workspace>, format: MeshFormat) -> Result<Content, Error> {
    on_workers(move || write_mesh(&workspace, format).map(Content::from)).await
}

/// Sends a summary.
pub(super) fn summary(workspace: &Workspace) -> Delivery {
    Delivery {
        content: workspace.summary.clone(),
        media: "application/json",
        cache_control: None,
        location: format!("/workspace/{}", workspace.question.id),
        file_name: None,
    }
}

/// Sends a mesh.
pub(super) fn mesh(id: &str, format: MeshFormat, content: Content) -> Delivery {
    let name = format.name();
    Delivery {
        content,
        media: format.media(),
        cache_control: None,
        location: format!("/workspace/{id}/mesh?format={name}"),
        file_name: Some(format!("workspace-{id:.8}.{name}")),
    }
}
