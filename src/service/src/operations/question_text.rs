//! Questions as text. A job's payload and a stored result hold the text of their question: all that another process
//! needs to answer it.

use std::sync::Arc;

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use utoipa::ToSchema;

use crate::operations::subtask::SubtaskRequest;
use crate::wire::answer::MachineId;
use crate::wire::canonical_toolpath::CanonicalToolpath;
use crate::wire::dexterity::CanonicalDexterity;
use crate::wire::error::OperationError;
use crate::wire::error_map::CanonicalErrorMap;
use crate::wire::family::CanonicalFamily;
use crate::wire::format::MeshFormat;
use crate::wire::machine::MachineObject;
use crate::wire::origins::CanonicalOrigins;
use crate::wire::placement::CanonicalPlacement;
use crate::wire::result_id::ResultId;
use crate::wire::window::CanonicalWindow;
use crate::wire::workspace::CanonicalWorkspace;

/// The kind of a result: `workspace`; `family`, a table of workspaces; `dexterity`, a map; `error_map`; `toolpath`;
/// `window` of a parameter of a program; `placement` of a program; `origins`, the region of its origins; `subtask`, a
/// part of a family, of a map or of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum QuestionKind {
    /// One workspace.
    Workspace,
    /// A table of workspaces.
    Family,
    /// A dexterity map.
    Dexterity,
    /// An error map.
    ErrorMap,
    /// A tool path.
    Toolpath,
    /// A window of a parameter of a program.
    Window,
    /// A placement of a program.
    Placement,
    /// The region of origins of a program.
    Origins,
    /// A subtask of a family, of a dexterity map or of a region of origins.
    Subtask,
}

impl QuestionKind {
    /// The path of a result of this kind.
    pub(crate) fn path(self, id: ResultId) -> String {
        if self.is_of_toolpath() { id.toolpath() } else { id.path() }
    }

    /// Whether the result is about a program, and so has its path below /toolpath.
    pub(crate) fn is_of_toolpath(self) -> bool {
        match self {
            Self::Workspace | Self::Family | Self::Dexterity | Self::ErrorMap | Self::Subtask => false,
            Self::Toolpath | Self::Window | Self::Placement | Self::Origins => true,
        }
    }

    /// The name in job documents, logs and metrics.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Workspace => "workspace",
            Self::Family => "family",
            Self::Dexterity => "dexterity",
            Self::ErrorMap => "error_map",
            Self::Toolpath => "toolpath",
            Self::Window => "window",
            Self::Placement => "placement",
            Self::Origins => "origins",
            Self::Subtask => "subtask",
        }
    }
}

/// What a job needs beside its question. It does not change the summary and the mesh.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct JobParameters {
    /// Most triangles of each mesh.
    pub max_triangles: u64,
    /// Estimated work, seconds of one core.
    pub cost: f64,
    /// The format in which a client waits for the mesh of a workspace. The job also stores the mesh in this format,
    /// because it has the mesh in memory.
    pub mesh_format: Option<MeshFormat>,
}

impl JobParameters {
    /// The parameters in a job's payload.
    pub(crate) fn read(payload: &[u8]) -> Result<Self, OperationError> {
        QuestionHeader::read(payload)?.parameters.ok_or(OperationError::OtherVersion)
    }

    /// Most triangles of each mesh.
    pub(crate) fn max_triangles(self) -> usize {
        usize::try_from(self.max_triangles).unwrap_or(usize::MAX)
    }
}

/// A question as text: the request, and the machine in full.
#[derive(Serialize, Deserialize)]
pub(crate) struct QuestionText {
    /// The request with its default values.
    #[serde(flatten)]
    pub request: CanonicalRequest,
    /// The machine.
    pub machine: MachineObject,
    /// The hash of the machine.
    pub hash: Arc<str>,
    /// The estimated work of a tool path, or of one plan of a program, seconds of one core. It depends on the program,
    /// which the text does not contain.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cost: Option<f64>,
    /// The parameters of the job, in its payload.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parameters: Option<JobParameters>,
}

/// The request of a question of any kind.
#[derive(Serialize, Deserialize)]
#[serde(tag = "asked", content = "request", rename_all = "snake_case")]
pub(crate) enum CanonicalRequest {
    Workspace(CanonicalWorkspace),
    Family(CanonicalFamily),
    Dexterity(CanonicalDexterity),
    ErrorMap(Box<CanonicalErrorMap>),
    Toolpath(Box<CanonicalToolpath>),
    Window(Box<CanonicalWindow>),
    Placement(Box<CanonicalPlacement>),
    Origins(Box<CanonicalOrigins>),
    Subtask(SubtaskRequest),
}

/// What a question's text says about itself. Reading it neither checks nor prepares the machine.
#[derive(Deserialize)]
pub(crate) struct QuestionHeader<'a> {
    /// The kind of question.
    #[serde(rename = "asked")]
    pub kind: QuestionKind,
    /// The request with its default values.
    #[serde(borrow)]
    pub request: &'a RawValue,
    machine: MachineName,
    hash: Arc<str>,
    parameters: Option<JobParameters>,
}

#[derive(Deserialize)]
struct MachineName {
    name: Arc<str>,
}

impl<'a> QuestionHeader<'a> {
    /// Reads the header of a question's text.
    pub(crate) fn read(text: &'a [u8]) -> Result<Self, OperationError> {
        serde_json::from_slice(text).map_err(|_| OperationError::OtherVersion)
    }

    /// Name and hash of the machine.
    pub(crate) fn machine(&self) -> MachineId {
        MachineId { name: Arc::clone(&self.machine.name), hash: Arc::clone(&self.hash) }
    }
}
