//! Sends results: figures and meshes, or the address of the job that will have them.

use axum::response::Response;
use verne_store::Found;

use super::jobs::accepted;
use crate::answers::{Described, Question, write_mesh};
use crate::delivery::{Conditions, Delivery};
use crate::error::{Error, Fault};
use crate::obtain::{Obtained, Patience};
use crate::prefer::Prefer;
use crate::results::{MESH, Record};
use crate::state::State;
use crate::wire::dexterity::SetName;
use crate::wire::format::MeshFormat;
use crate::workers::on_workers;

/// The figures that answer a question.
pub(super) async fn figures(
    state: &State,
    question: &Question,
    patience: &Patience,
) -> Result<Obtained<Delivery>, Error> {
    Ok(match state.obtain(question, patience).await? {
        Obtained::Ready(record) => Obtained::Ready(summary(record)),
        Obtained::Pending(job) => Obtained::Pending(job),
    })
}

/// Which surface of a question's answer is meant: its name among the kept parts, and what its files say.
fn surface(question: &Question, set: Option<SetName>) -> Result<(&'static str, Described<'_>), Error> {
    match (question, set) {
        (Question::Workspace(workspace), None) => Ok((MESH, Described::workspace(workspace))),
        (Question::Workspace(_), Some(_)) => {
            let detail = "is for dexterity maps: a workspace has one mesh";
            Err(Error::Fields(vec![Fault::new("/query/set", detail)]))
        }
        (Question::Family(_) | Question::Piece(_), _) => Err(Error::NoMesh(question.id().to_string())),
        (Question::Dexterity(dexterity), set) => {
            let set = set.unwrap_or(SetName::Reachable);
            Ok((set.name(), Described::set(dexterity, set)))
        }
    }
}

/// A mesh in a format.
pub(super) async fn mesh(
    state: &State,
    question: Question,
    set: Option<SetName>,
    format: MeshFormat,
    patience: &Patience,
) -> Result<Obtained<Delivery>, Error> {
    let (id, (part, described)) = (question.id(), surface(&question, set)?);
    let (results, name) = (&state.results, format.name());
    let sent = |content: Found| {
        let set = set.map(|set| format!("&set={}", set.name())).unwrap_or_default();
        Delivery {
            content,
            media: format.media(),
            cache_control: None,
            location: format!("{}/mesh?format={name}{set}", id.path()),
            file_name: Some(format!("workspace-{id:.8}.{name}")),
        }
    };
    let file = format!("{part}.{name}");
    if let Some(content) = results.found(id, &file).await {
        return Ok(Obtained::Ready(sent(content)));
    }
    let look = || results.mesh(id, part);
    let mesh = match state.part(&question, patience, look).await? {
        Obtained::Ready(mesh) => mesh,
        Obtained::Pending(job) => return Ok(Obtained::Pending(job)),
    };
    drop(described);
    let write = on_workers(move || write_mesh(&surface(&question, set)?.1, &mesh, format));
    Ok(Obtained::Ready(sent(results.part_or(id, &file, write).await?.into())))
}

/// The answer, or the address of the job that will have it.
pub(super) fn respond(
    obtained: Obtained<Delivery>,
    describe: impl FnOnce(Delivery) -> Delivery,
    prefer: Prefer,
    conditions: &Conditions,
) -> Result<Response, Error> {
    let mut response = match obtained {
        Obtained::Ready(delivery) => describe(delivery).answer(conditions)?,
        Obtained::Pending(job) => accepted(&job)?,
    };
    prefer.tell(&mut response);
    Ok(response)
}

/// A record's figures.
pub(super) fn summary(record: Record) -> Delivery {
    Delivery {
        location: record.question.id().path(),
        content: record.summary.into(),
        media: "application/json",
        cache_control: None,
        file_name: None,
    }
}
