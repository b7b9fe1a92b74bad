//! A checked question whose answer is kept, and how it is written down for a job.

use std::time::Duration;

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use verne_jobs::Submission;
use verne_solver::workspace::Observer;

use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::family_question::FamilyQuestion;
use crate::operations::registry::Published;
use crate::operations::subtask::{Piece, WrittenPiece};
use crate::operations::workspace_question;
use crate::operations::workspace_question::{WorkspaceQuestion, check_triangles};
use crate::wire::answer::MachineId;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::machine::MachineObject;
use crate::wire::result_id::ResultId;

/// What a job may be asked for.
#[derive(Clone, Debug)]
pub(crate) enum Question {
    /// One workspace.
    Workspace(WorkspaceQuestion),
    /// A table of workspaces.
    Family(FamilyQuestion),
    /// A dexterity map.
    Dexterity(DexterityQuestion),
    /// A piece of one of these.
    Piece(Piece),
}

#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Asked {
    Workspace,
    Family,
    Dexterity,
    Piece,
}

/// A question with its machine, as text: all that another process needs to answer it.
#[derive(Serialize, Deserialize)]
struct Written<'a> {
    asked: Asked,
    machine: MachineObject,
    hash: String,
    /// There if it is written for a job.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    terms: Option<Terms>,
    #[serde(borrow)]
    request: &'a RawValue,
}

/// On which terms a job answers a question; they are no part of the question.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Terms {
    /// Most triangles of each mesh.
    pub most_triangles: u64,
    /// Estimated work, seconds of one core.
    pub cost: f64,
}

impl Terms {
    /// Those that are written with a question.
    pub(crate) fn read(text: &[u8]) -> Result<Self, OperationError> {
        let written: Written<'_> = serde_json::from_slice(text).map_err(|_| OperationError::OtherVersion)?;
        written.terms.ok_or(OperationError::OtherVersion)
    }

    /// Most triangles of each mesh.
    pub(crate) fn most(self) -> usize {
        usize::try_from(self.most_triangles).unwrap_or(usize::MAX)
    }
}

impl Question {
    /// The answer's id.
    pub(crate) fn id(&self) -> ResultId {
        match self {
            Self::Workspace(question) => question.id,
            Self::Family(question) => question.id,
            Self::Dexterity(question) => question.id,
            Self::Piece(piece) => piece.id(),
        }
    }

    /// What it asks for, in a word.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Workspace(_) => "workspace",
            Self::Family(_) => "family",
            Self::Dexterity(_) => "dexterity",
            Self::Piece(_) => "piece",
        }
    }

    fn published(&self) -> &Published {
        match self {
            Self::Workspace(question) => &question.published,
            Self::Family(question) => &question.published,
            Self::Dexterity(question) => &question.published,
            Self::Piece(piece) => piece.published(),
        }
    }

    /// On which terms a job may answer it: estimates its work, and refuses meshes of more triangles than `most`, of each
    /// member of a family. The grid of a dexterity map has a bound of its own. It takes some milliseconds: to be called on
    /// the worker threads.
    pub(crate) fn terms(&self, most: u64, observer: &dyn Observer) -> Result<Terms, OperationError> {
        let cost = match self {
            Self::Workspace(question) => {
                let triangles = question.triangles(observer)?;
                check_triangles(triangles, most)?;
                workspace_question::cost(triangles)
            }
            Self::Family(family) => {
                let triangles = family.triangles(observer)?;
                check_triangles(triangles, most)?;
                workspace_question::cost(triangles) * f64::from(family.count())
            }
            Self::Dexterity(question) => question.cost(),
            Self::Piece(_) => return Err(OperationError::Internal),
        };
        Ok(Terms { most_triangles: most, cost })
    }

    /// The question as text, without terms.
    pub(crate) fn written(&self) -> Result<Vec<u8>, OperationError> {
        self.written_on(None)
    }

    fn written_on(&self, terms: Option<Terms>) -> Result<Vec<u8>, OperationError> {
        let (asked, request) = match self {
            Self::Workspace(question) => (Asked::Workspace, raw(&question.request)?),
            Self::Family(question) => (Asked::Family, raw(&question.request)?),
            Self::Dexterity(question) => (Asked::Dexterity, raw(&question.request)?),
            Self::Piece(piece) => (Asked::Piece, raw(&piece.written())?),
        };
        let published = self.published();
        let machine = MachineObject::from(published.machine.data());
        let hash = (*published.id.hash).to_owned();
        let written = Written { asked, machine, hash, terms, request: &request };
        serde_json::to_vec(&written).map_err(|_| OperationError::Internal)
    }

    /// The question that was written. Another version of the service may have asked, and meant another answer.
    pub(crate) fn read(text: &[u8], id: ResultId) -> Result<Self, OperationError> {
        let written: Written<'_> = serde_json::from_slice(text).map_err(|_| OperationError::OtherVersion)?;
        let published =
            Published::from_object(&written.machine).map_err(|_| OperationError::OtherVersion)?.into();
        let request = written.request.get();
        let question = match written.asked {
            Asked::Workspace => serde_json::from_str(request)
                .map(|request| Self::Workspace(WorkspaceQuestion::of(published, request))),
            Asked::Family => serde_json::from_str(request)
                .map(|request| Self::Family(FamilyQuestion::of(&published, request))),
            Asked::Dexterity => serde_json::from_str(request)
                .map(|request| Self::Dexterity(DexterityQuestion::of(published, request))),
            Asked::Piece => {
                serde_json::from_str::<WrittenPiece>(request).map(|piece| Self::Piece(piece.read(published)))
            }
        };
        question.ok().filter(|question| question.id() == id).ok_or(OperationError::OtherVersion)
    }

    /// The question as a job for a client.
    pub(crate) fn submission(
        &self,
        terms: Terms,
        client: String,
        deadline: Option<Duration>,
    ) -> Result<Submission, OperationError> {
        let payload = self.written_on(Some(terms))?.into();
        Ok(Submission { id: self.id().job(), client, cost: terms.cost, payload, deadline })
    }
}

fn raw(request: &impl Serialize) -> Result<Box<RawValue>, OperationError> {
    serde_json::value::to_raw_value(request).map_err(|_| OperationError::Internal)
}

/// What a written question says about itself, unchecked.
#[derive(Deserialize)]
pub(crate) struct Gist<'a> {
    machine: Name,
    hash: String,
    /// The request.
    #[serde(borrow)]
    pub request: &'a RawValue,
}

#[derive(Deserialize)]
struct Name {
    name: String,
}

impl<'a> Gist<'a> {
    /// Reads it.
    pub(crate) fn of(written: &'a [u8]) -> Result<Self, OperationError> {
        serde_json::from_slice(written).map_err(|_| OperationError::Internal)
    }

    /// The machine.
    pub(crate) fn machine(&self) -> MachineId {
        MachineId { name: self.machine.name.as_str().into(), hash: self.hash.as_str().into() }
    }
}

/// Why a job failed, as it is kept with the job.
#[derive(Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum TaskFault {
    /// These fields cannot be used, as only the work has shown.
    Fields(Vec<FieldError>),
    /// Another version asked.
    OtherVersion,
    /// The store took nothing.
    NotKept,
    /// A defect.
    Internal,
}

impl From<OperationError> for TaskFault {
    fn from(error: OperationError) -> Self {
        match error {
            OperationError::Fields(faults) => Self::Fields(faults),
            OperationError::OtherVersion => Self::OtherVersion,
            OperationError::StoreUnavailable => Self::NotKept,
            _ => Self::Internal,
        }
    }
}

impl From<TaskFault> for OperationError {
    fn from(fault: TaskFault) -> Self {
        match fault {
            TaskFault::Fields(faults) => Self::Fields(faults),
            TaskFault::OtherVersion => Self::OtherVersion,
            TaskFault::NotKept => Self::StoreUnavailable,
            TaskFault::Internal => Self::Internal,
        }
    }
}
