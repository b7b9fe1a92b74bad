//! Sends results: figures and meshes, or the address of the job that will have them.

use std::sync::Arc;

use axum::response::Response;
use verne_store::{Content, Found};

use crate::http::base_path::linked;
use crate::http::conditional_response::{Conditions, Delivery};
use crate::http::error::{HttpError, LookupError};
use crate::http::handlers::jobs::accepted;
use crate::http::prefer::Prefer;
use crate::http::result_or_job::{Obtained, Patience};
use crate::http::state::State;
use crate::operations::compute_pool::on_workers;
use crate::operations::mesh_files::{Described, write_mesh};
use crate::operations::question::Question;
use crate::operations::results::{MESH, Record, content, unpacked_mesh};
use crate::wire::dexterity::SetName;
use crate::wire::format::MeshFormat;

/// The figures that answer a question.
pub(crate) async fn figures(
    state: &State,
    question: &Question,
    patience: &Patience,
) -> Result<Obtained<Delivery>, HttpError> {
    Ok(match state.obtain(question, patience).await? {
        Obtained::Ready(record) => Obtained::Ready(summary(state, record)),
        Obtained::Pending(job) => Obtained::Pending(job),
    })
}

/// Which surface of a question's answer is meant: its name among the kept parts, and what its files say.
fn surface(question: &Question, set: Option<SetName>) -> Result<(&'static str, Described<'_>), HttpError> {
    match (question, set) {
        (Question::Workspace(workspace), None) => Ok((MESH, Described::workspace(workspace))),
        (Question::Workspace(_), Some(_)) => {
            let detail = "is allowed only for dexterity maps: a workspace has one mesh";
            Err(HttpError::field("/query/set", detail))
        }
        (Question::Family(_) | Question::Piece(_), _) => {
            Err(LookupError::Mesh(question.id().to_string()).into())
        }
        (Question::Dexterity(dexterity), set) => {
            let set = set.unwrap_or(SetName::Reachable);
            Ok((set.name(), Described::set(dexterity, set)))
        }
    }
}

/// A mesh in a format.
pub(crate) async fn mesh(
    state: &State,
    question: Question,
    set: Option<SetName>,
    format: MeshFormat,
    patience: &Patience,
) -> Result<Obtained<Delivery>, HttpError> {
    let (id, name) = (question.id(), format.name());
    let sent = |content: Found, own| {
        let set = set.map(|set| format!("&set={}", set.name())).unwrap_or_default();
        Delivery {
            content,
            own,
            media: format.media(),
            cache_control: None,
            location: format!("{}/mesh?format={name}{set}", id.path()),
            file_name: Some(format!("workspace-{id:.8}.{name}")),
        }
    };
    let file = format!("{}.{name}", surface(&question, set)?.0);
    if let Some(content) = state.results.found(id, &file).await {
        return Ok(Obtained::Ready(sent(content, false)));
    }
    let make = || async {
        // Without the mesh a job is to compute it again.
        made(state, &question, set, format, &file, patience.caller.sharer()).await.transpose()
    };
    Ok(match state.part(&question, patience, make).await? {
        Obtained::Ready(made) => {
            let Made { content, own } = made?;
            Obtained::Ready(sent(content.into(), own))
        }
        Obtained::Pending(job) => Obtained::Pending(job),
    })
}

/// The file of a mesh.
struct Made {
    content: Content,
    /// Here, and not for another who asked at the same time.
    own: bool,
}

/// Makes the file of a mesh, once for all who ask for it now; `None` where the mesh is not kept. It has its turn
/// until the file is made, whether anybody waits or not, and while somebody does until it is kept.
async fn made(
    state: &State,
    question: &Question,
    set: Option<SetName>,
    format: MeshFormat,
    file: &str,
    client: Option<&str>,
) -> Result<Option<Made>, HttpError> {
    let (id, part) = (question.id(), surface(question, set)?.0);
    let mut turn = None;
    let make = Box::pin(async {
        let taken = Arc::clone(turn.insert(Arc::new(state.admission.mesh(client).await?)));
        let Some(packed) = state.results.part(id, part).await else { return Ok::<_, HttpError>(None) };
        let question = question.clone();
        on_workers(move || {
            let _taken = taken;
            let Some(mesh) = unpacked_mesh(&packed) else { return Ok(None) };
            drop(packed);
            Ok(Some(write_mesh(&surface(&question, set)?.1, &mesh, format)?))
        })
        .await
    });
    let content = state.results.part_or(id, file, make).await?;
    Ok(content.map(|content| Made { content, own: turn.is_some() }))
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
    let id = record.question.id();
    let linked = linked(&record.summary.bytes, id, &state.base);
    Delivery {
        location: id.path(),
        content: linked.map_or(record.summary, content).into(),
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
