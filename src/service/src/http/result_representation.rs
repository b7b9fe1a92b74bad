//! The representations of a result: its summary as JSON, and its meshes as files.

use std::sync::Arc;

use verne_store::{Content, ContentReader};

use crate::http::base_path::summary_below;
use crate::http::conditional_response::{IMMUTABLE, Representation};
use crate::http::error::{HttpError, LookupError};
use crate::http::negotiation::Accept;
use crate::http::result_or_job::ResultOrJob;
use crate::http::state::AppState;
use crate::http::wait_policy::WaitPolicy;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::mesh_files::{MeshDescription, mesh_file_name, write_mesh};
use crate::operations::question::Question;
use crate::operations::question_text::QuestionKind;
use crate::operations::results::{MESH, Record, hashed, unpack_mesh};
use crate::wire::dexterity::SetName;
use crate::wire::error::OperationError;
use crate::wire::error_map::ErrorName;
use crate::wire::format::{MeshFormat, SliceFormat};
use crate::wire::result_id::ResultId;

/// The summary of a record.
pub(crate) fn summary(state: &AppState, record: Record) -> Representation {
    let path = record.kind.path(record.id);
    let below = summary_below(&state.base, &record.summary.bytes, &path);
    Representation::json(below.map_or(record.summary, hashed), path)
}

/// The summary that answers a question, or the job that computes it.
pub(crate) async fn summary_or_job(
    state: &AppState,
    question: &Arc<Question>,
    wait_policy: &WaitPolicy,
) -> Result<ResultOrJob<Representation>, HttpError> {
    Ok(state.record_or_job(question, wait_policy).await?.map(|record| summary(state, record)))
}

/// The format that a request for a mesh states, or else prefers.
pub(crate) fn mesh_format(accept: &Accept, stated: Option<MeshFormat>) -> Result<MeshFormat, HttpError> {
    match stated {
        Some(format) => Ok(format),
        None => accept.choose(MeshFormat::ALL.map(|format| (format.media(), format))),
    }
}

/// The format that a request for a slice states, or else prefers, with its media type.
pub(crate) fn slice_format(
    accept: &Accept,
    stated: Option<SliceFormat>,
) -> Result<(SliceFormat, &'static str), HttpError> {
    let offers = |format: SliceFormat| format.media().iter().map(move |&media| (media, (format, media)));
    match stated {
        Some(format) => Ok((format, format.media()[0])),
        None => accept.choose(SliceFormat::ALL.into_iter().flat_map(offers)),
    }
}

/// The slice of a result at a height.
pub(crate) fn slice_file(
    (id, kind): (ResultId, QuestionKind),
    z: f64,
    (format, media): (SliceFormat, &'static str),
    bytes: Content,
) -> Representation {
    let name = format.name();
    Representation {
        content: bytes.into(),
        is_unshared: true,
        media,
        cache_control: Some(IMMUTABLE),
        location: Some(format!("{}/slice?z={z}&format={name}", kind.path(id))),
        file_name: Some(format!("slice-{id:.8}.{name}")),
    }
}

/// Which mesh of a result with several ones.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MeshSelection {
    /// The set of a dexterity map.
    pub set: Option<SetName>,
    /// The error of an error map.
    pub error: Option<ErrorName>,
}

impl MeshSelection {
    /// Refuses what a result of this kind does not have.
    fn check(self, kind: QuestionKind) -> Result<(), HttpError> {
        let refused = |name, maps| {
            let detail = format!("is allowed only for {maps}: a workspace has one mesh");
            Err(HttpError::field(format!("/query/{name}"), detail))
        };
        match self {
            Self { set: Some(_), .. } if kind != QuestionKind::Dexterity => refused("set", "dexterity maps"),
            Self { error: Some(_), .. } if kind != QuestionKind::ErrorMap => refused("error", "error maps"),
            _ => Ok(()),
        }
    }

    fn set(self) -> SetName {
        self.set.unwrap_or(SetName::Reachable)
    }

    fn error(self) -> ErrorName {
        self.error.unwrap_or(ErrorName::TipWorst)
    }

    /// The parameters of a query.
    fn parameters(self) -> String {
        let set = self.set.map(|set| format!("&set={}", set.name())).unwrap_or_default();
        set + &self.error.map(|error| format!("&error={}", error.name())).unwrap_or_default()
    }
}

/// A surface of a result.
pub(crate) struct Surface {
    id: ResultId,
    kind: QuestionKind,
    selection: MeshSelection,
    /// The blob with its mesh.
    blob: &'static str,
}

impl Surface {
    /// The surface of a result that a request means.
    pub(crate) fn of(id: ResultId, kind: QuestionKind, selection: MeshSelection) -> Result<Self, HttpError> {
        let blob = match kind {
            QuestionKind::Workspace | QuestionKind::Origins => MESH,
            QuestionKind::Dexterity => selection.set().name(),
            QuestionKind::ErrorMap => selection.error().name(),
            QuestionKind::Toolpath | QuestionKind::Window | QuestionKind::Placement => {
                return Err(LookupError::Result(id.to_string()).into());
            }
            QuestionKind::Family | QuestionKind::Subtask => {
                return Err(LookupError::Mesh(id.to_string()).into());
            }
        };
        selection.check(kind)?;
        Ok(Self { id, kind, selection, blob })
    }

    fn representation(
        &self,
        format: MeshFormat,
        content: ContentReader,
        is_unshared: bool,
    ) -> Representation {
        let (id, name) = (self.id, format.name());
        let selection = self.selection.parameters();
        Representation {
            content,
            is_unshared,
            media: format.media(),
            cache_control: None,
            location: Some(format!("{}/mesh?format={name}{selection}", self.kind.path(id))),
            file_name: Some(match self.kind {
                QuestionKind::Origins => format!("origins-{id:.8}.{name}"),
                _ => format!("workspace-{id:.8}.{name}"),
            }),
        }
    }
}

/// The mesh of a surface as a file, or the job that computes the mesh. `question` is the question of the result; it is
/// needed if the file is not stored.
pub(crate) async fn mesh_or_job(
    state: &AppState,
    surface: &Surface,
    format: MeshFormat,
    wait_policy: &WaitPolicy,
    question: impl FnOnce() -> Result<Arc<Question>, OperationError>,
) -> Result<ResultOrJob<Representation>, HttpError> {
    let file = mesh_file_name(surface.blob, format);
    if let Some(content) = state.results.find_blob(surface.id, &file).await {
        return Ok(ResultOrJob::Result(surface.representation(format, content, false)));
    }
    let question = question()?;
    let client = wait_policy.client.quota();
    let find =
        || async { found_or_encoded(state, &question, surface, format, &file, client).await.transpose() };
    Ok(match state.blob_or_job(&question, wait_policy, Some(format), find).await? {
        ResultOrJob::Result(found) => {
            let (content, is_unshared) = found?;
            ResultOrJob::Result(surface.representation(format, content, is_unshared))
        }
        ResultOrJob::Job(job) => ResultOrJob::Job(job),
    })
}

/// The file of a mesh, and whether this call encoded it; `None` if the store has neither the file nor the mesh.
///
/// Concurrent calls for the same file share one encoding. The encoding has a permit until the file is stored; if all
/// callers leave, until the file is encoded.
async fn found_or_encoded(
    state: &AppState,
    question: &Arc<Question>,
    surface: &Surface,
    format: MeshFormat,
    file: &str,
    client: Option<&str>,
) -> Result<Option<(ContentReader, bool)>, HttpError> {
    if let Some(content) = state.results.find_blob(surface.id, file).await {
        return Ok(Some((content, false)));
    }
    let (id, blob, selection) = (surface.id, surface.blob, surface.selection);
    let mut permit = None;
    let encode = Box::pin(async {
        let taken = Arc::clone(permit.insert(Arc::new(state.admission.mesh(client).await?)));
        let Some(packed) = state.results.blob(id, blob).await else { return Ok::<_, HttpError>(None) };
        let question = Arc::clone(question);
        run_on_pool(move |_| {
            let _taken = taken;
            let Some(mesh) = unpack_mesh(&packed) else { return Ok(None) };
            drop(packed);
            Ok(Some(write_mesh(&description(&question, selection)?, &mesh, format)?))
        })
        .await
    });
    let content = state.results.blob_or_make(id, file, encode).await?;
    Ok(content.map(|content| (content.into(), permit.is_some())))
}

fn description(question: &Question, selection: MeshSelection) -> Result<MeshDescription<'_>, OperationError> {
    match question {
        Question::Workspace(workspace) => Ok(MeshDescription::of_workspace(workspace)),
        Question::Dexterity(map) => Ok(MeshDescription::of_set(map, selection.set())),
        Question::ErrorMap(map) => Ok(MeshDescription::of_errors(map, selection.error())),
        Question::Origins(region) => Ok(MeshDescription::of_origins(region)),
        Question::Family(_)
        | Question::Toolpath(_)
        | Question::Window(_)
        | Question::Placement(_)
        | Question::Subtask(_) => Err(OperationError::Internal),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::body::{Body, to_bytes};
    use axum::http::header::{CONTENT_TYPE, RETRY_AFTER};
    use axum::http::{Request, StatusCode};
    use axum::response::Response;
    use futures_util::future::join_all;
    use serde_json::Value;
    use tower::ServiceExt;

    use crate::process::service::Service;
    use crate::test_service::service;

    async fn send(service: &Service, request: Request<Body>) -> Response {
        service.router.clone().oneshot(request).await.unwrap()
    }

    async fn get(service: &Service, path: &str) -> Response {
        send(service, Request::get(path).body(Body::empty()).unwrap()).await
    }

    /// A service with a limit of concurrent requests, and the path of a mesh.
    async fn with_mesh(requests: usize) -> (Service, String) {
        let service = service(&format!("--max-requests={requests}")).await;
        let question = Request::post("/workspace").header(CONTENT_TYPE, "application/json");
        let answer =
            send(&service, question.body(r#"{"kind": "part", "tolerance": 50}"#.into()).unwrap()).await;
        assert_eq!(answer.status(), StatusCode::OK);
        let bytes = to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        let summary: Value = serde_json::from_slice(&bytes).unwrap();
        (service, format!("/workspace/{}/mesh", summary["id"].as_str().unwrap()))
    }

    #[tokio::test]
    async fn the_number_of_encodings_at_once_is_limited() {
        let (service, mesh) = with_mesh(2).await;
        let [kept, stl] = ["glb", "stl"].map(|format| format!("{mesh}?format={format}"));
        assert_eq!(get(&service, &kept).await.status(), StatusCode::OK);
        let taken = service.state.admission.mesh(None).await.unwrap();
        let refused = get(&service, &stl).await;
        assert_eq!(refused.status(), StatusCode::SERVICE_UNAVAILABLE);
        assert_eq!(refused.headers()[RETRY_AFTER], "1");
        assert_eq!(get(&service, &kept).await.status(), StatusCode::OK, "the file is stored");
        drop(taken);
        assert_eq!(get(&service, &stl).await.status(), StatusCode::OK);
    }

    #[tokio::test]
    async fn concurrent_requests_for_a_file_share_one_encoding() {
        let (service, mesh) = with_mesh(8).await;
        let _taken = service.state.admission.mesh(None).await.unwrap();
        let path = format!("{mesh}?format=ply");
        for answer in join_all((0..6).map(|_| get(&service, &path))).await {
            assert_eq!(answer.status(), StatusCode::OK);
        }
    }
}
