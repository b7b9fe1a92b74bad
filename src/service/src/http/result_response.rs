//! Sends results: figures and meshes, or the address of the job that will have them.

use std::sync::Arc;

use axum::response::Response;
use verne_store::ContentReader;

use crate::http::base_path::linked;
use crate::http::conditional_response::{Conditions, Delivery};
use crate::http::error::{HttpError, LookupError};
use crate::http::handlers::jobs::accepted;
use crate::http::prefer::Prefer;
use crate::http::result_or_job::{Obtained, Patience};
use crate::http::state::State;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::mesh_files::{MeshDescription, mesh_file_name, write_mesh};
use crate::operations::question::Question;
use crate::operations::question_text::QuestionKind;
use crate::operations::results::{MESH, Record, hashed, unpack_mesh};
use crate::wire::dexterity::SetName;
use crate::wire::error::OperationError;
use crate::wire::format::MeshFormat;
use crate::wire::result_id::ResultId;

/// The figures that answer a question.
pub(crate) async fn figures(
    state: &State,
    question: &Arc<Question>,
    patience: &Patience,
) -> Result<Obtained<Delivery>, HttpError> {
    Ok(match state.obtain(question, patience).await? {
        Obtained::Ready(record) => Obtained::Ready(summary(state, record)),
        Obtained::Pending(job) => Obtained::Pending(job),
    })
}

/// A surface of a result.
pub(crate) struct Surface {
    id: ResultId,
    /// The set of a dexterity map.
    set: Option<SetName>,
    /// The blob with its mesh.
    blob: &'static str,
}

impl Surface {
    /// The surface of a result that a request means by `set`.
    pub(crate) fn of(id: ResultId, kind: QuestionKind, set: Option<SetName>) -> Result<Self, HttpError> {
        let blob = match (kind, set) {
            (QuestionKind::Workspace, None) => MESH,
            (QuestionKind::Workspace, Some(_)) => {
                let detail = "is allowed only for dexterity maps: a workspace has one mesh";
                return Err(HttpError::field("/query/set", detail));
            }
            (QuestionKind::Family | QuestionKind::Subtask, _) => {
                return Err(LookupError::Mesh(id.to_string()).into());
            }
            (QuestionKind::Dexterity, set) => set.unwrap_or(SetName::Reachable).name(),
        };
        Ok(Self { id, set, blob })
    }

    fn delivery(&self, format: MeshFormat, content: ContentReader, own: bool) -> Delivery {
        let (id, name) = (self.id, format.name());
        let set = self.set.map(|set| format!("&set={}", set.name())).unwrap_or_default();
        Delivery {
            content,
            own,
            media: format.media(),
            cache_control: None,
            location: format!("{}/mesh?format={name}{set}", id.path()),
            file_name: Some(format!("workspace-{id:.8}.{name}")),
        }
    }
}

/// The mesh of a surface in a format. `question` is the question of the result; it is needed if the file is not stored.
pub(crate) async fn mesh(
    state: &State,
    surface: &Surface,
    format: MeshFormat,
    patience: &Patience,
    question: impl FnOnce() -> Result<Arc<Question>, OperationError>,
) -> Result<Obtained<Delivery>, HttpError> {
    let file = mesh_file_name(surface.blob, format);
    if let Some(content) = state.results.find_blob(surface.id, &file).await {
        return Ok(Obtained::Ready(surface.delivery(format, content, false)));
    }
    let question = question()?;
    let make = || async {
        // Without the mesh a job is to compute it again.
        made(state, &question, surface, format, &file, patience.caller.sharer()).await.transpose()
    };
    Ok(match state.blob(&question, Some(format), patience, make).await? {
        Obtained::Ready(made) => {
            let Made { content, own } = made?;
            Obtained::Ready(surface.delivery(format, content, own))
        }
        Obtained::Pending(job) => Obtained::Pending(job),
    })
}

/// The file of a mesh.
struct Made {
    content: ContentReader,
    /// Whether this request made it, and not another one or the job.
    own: bool,
}

/// Makes the file of a mesh from the stored mesh, once for all requests of this moment; `None` if the mesh is not stored.
/// It counts among the files that are made at once until it is made, even if the client no longer waits.
async fn made(
    state: &State,
    question: &Arc<Question>,
    surface: &Surface,
    format: MeshFormat,
    file: &str,
    client: Option<&str>,
) -> Result<Option<Made>, HttpError> {
    if let Some(content) = state.results.find_blob(surface.id, file).await {
        return Ok(Some(Made { content, own: false }));
    }
    let (id, blob, set) = (surface.id, surface.blob, surface.set);
    let mut turn = None;
    let make = Box::pin(async {
        let taken = Arc::clone(turn.insert(Arc::new(state.admission.mesh(client).await?)));
        let Some(packed) = state.results.blob(id, blob).await else { return Ok::<_, HttpError>(None) };
        let question = Arc::clone(question);
        run_on_pool(move |_| {
            let _taken = taken;
            let Some(mesh) = unpack_mesh(&packed) else { return Ok(None) };
            drop(packed);
            Ok(Some(write_mesh(&description(&question, set)?, &mesh, format)?))
        })
        .await
    });
    let content = state.results.blob_or_make(id, file, make).await?;
    Ok(content.map(|content| Made { content: content.into(), own: turn.is_some() }))
}

fn description(question: &Question, set: Option<SetName>) -> Result<MeshDescription<'_>, OperationError> {
    match question {
        Question::Workspace(workspace) => Ok(MeshDescription::of_workspace(workspace)),
        Question::Dexterity(map) => Ok(MeshDescription::of_set(map, set.unwrap_or(SetName::Reachable))),
        Question::Family(_) | Question::Subtask(_) => Err(OperationError::Internal),
    }
}

/// The answer, or the address of the job that will have it.
pub(crate) fn respond(
    state: &State,
    obtained: Obtained<Delivery>,
    describe: impl FnOnce(Delivery) -> Delivery,
    prefer: Prefer,
    conditions: &Conditions,
) -> Result<Response, HttpError> {
    let mut response = match obtained {
        Obtained::Ready(delivery) => describe(delivery).answer(conditions)?,
        Obtained::Pending(job) => accepted(&job, &state.base)?,
    };
    prefer.tell(&mut response);
    Ok(response)
}

/// A record's figures.
pub(crate) fn summary(state: &State, record: Record) -> Delivery {
    let id = record.id;
    let linked = linked(&record.summary.bytes, id, &state.base);
    Delivery {
        location: id.path(),
        content: linked.map_or(record.summary, hashed).into(),
        own: false,
        media: "application/json",
        cache_control: None,
        file_name: None,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use axum::body::{Body, to_bytes};
    use axum::http::header::{CONTENT_TYPE, RETRY_AFTER};
    use axum::http::{Request, StatusCode};
    use axum::response::Response;
    use clap::{Args, Command, FromArgMatches};
    use futures_util::future::join_all;
    use serde_json::Value;
    use tower::ServiceExt;

    use crate::process::config::ServeConfig;
    use crate::process::service::Service;

    async fn send(service: &Service, request: Request<Body>) -> Response {
        service.router.clone().oneshot(request).await.unwrap()
    }

    async fn get(service: &Service, path: &str) -> Response {
        send(service, Request::get(path).body(Body::empty()).unwrap()).await
    }

    /// A service that works on at most so many requests, and the path of a mesh.
    async fn with_mesh(requests: usize) -> (Service, String) {
        let command = ServeConfig::augment_args(Command::new("verne").no_binary_name(true));
        let flags = ["--memory-only".to_owned(), format!("--max-requests={requests}")];
        let config = ServeConfig::from_arg_matches(&command.get_matches_from(flags)).unwrap();
        let service = Service::open(&config).await.unwrap();
        let question = Request::post("/workspace").header(CONTENT_TYPE, "application/json");
        let answer =
            send(&service, question.body(r#"{"kind": "part", "tolerance": 50}"#.into()).unwrap()).await;
        assert_eq!(answer.status(), StatusCode::OK);
        let bytes = to_bytes(answer.into_body(), usize::MAX).await.unwrap();
        let summary: Value = serde_json::from_slice(&bytes).unwrap();
        (service, format!("/workspace/{}/mesh", summary["id"].as_str().unwrap()))
    }

    #[tokio::test]
    async fn files_of_meshes_are_made_within_a_bound() {
        let (service, mesh) = with_mesh(2).await;
        let [kept, stl] = ["glb", "stl"].map(|format| format!("{mesh}?format={format}"));
        assert_eq!(get(&service, &kept).await.status(), StatusCode::OK);
        let taken = service.state.admission.mesh(None).await.unwrap();
        let refused = get(&service, &stl).await;
        assert_eq!(refused.status(), StatusCode::SERVICE_UNAVAILABLE);
        assert_eq!(refused.headers()[RETRY_AFTER], "1");
        assert_eq!(get(&service, &kept).await.status(), StatusCode::OK, "nothing is to be made");
        drop(taken);
        assert_eq!(get(&service, &stl).await.status(), StatusCode::OK);
    }

    #[tokio::test]
    async fn equal_files_are_made_once_and_in_one_turn() {
        let (service, mesh) = with_mesh(8).await;
        let _taken = service.state.admission.mesh(None).await.unwrap();
        let path = format!("{mesh}?format=ply");
        for answer in join_all((0..6).map(|_| get(&service, &path))).await {
            assert_eq!(answer.status(), StatusCode::OK);
        }
    }
}
