//! A question that a job answers: a workspace, a family of workspaces, a dexterity map, an error map, a tool path, a
//! placement, a region of origins, or a subtask.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::Submission;
use verne_solver::workspace::Observer;

use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::error_map_question::ErrorMapQuestion;
use crate::operations::family_question::FamilyQuestion;
use crate::operations::machine_registry::IdentifiedMachine;
use crate::operations::origins_question::OriginsQuestion;
use crate::operations::placement_question::PlacementQuestion;
use crate::operations::question_text::{CanonicalRequest, JobParameters, QuestionKind, QuestionText};
use crate::operations::subtask::Subtask;
use crate::operations::toolpath_question::ToolpathQuestion;
use crate::operations::window_question::WindowQuestion;
use crate::operations::workspace_question::{WorkspaceQuestion, check_triangles, workspace_cost};
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::machine::MachineObject;
use crate::wire::origins::CanonicalOrigins;
use crate::wire::placement::CanonicalPlacement;
use crate::wire::result_id::ResultId;
use crate::wire::window::CanonicalWindow;

/// About the bytes of a question's text.
const TEXT_BYTES: usize = 2048;

/// A checked question that a job answers.
#[derive(Clone, Debug)]
pub(crate) enum Question {
    /// One workspace.
    Workspace(WorkspaceQuestion),
    /// A table of workspaces.
    Family(FamilyQuestion),
    /// A dexterity map.
    Dexterity(DexterityQuestion),
    /// An error map.
    ErrorMap(Box<ErrorMapQuestion>),
    /// A tool path.
    Toolpath(Box<ToolpathQuestion>),
    /// A window.
    Window(Box<WindowQuestion>),
    /// A placement.
    Placement(Box<PlacementQuestion>),
    /// A region of origins.
    Origins(Box<OriginsQuestion>),
    /// A subtask of a family, of a dexterity map or of a region of origins.
    Subtask(Subtask),
}

impl Question {
    /// The id of the answer.
    pub(crate) fn id(&self) -> ResultId {
        match self {
            Self::Workspace(question) => question.id,
            Self::Family(question) => question.id,
            Self::Dexterity(question) => question.id,
            Self::ErrorMap(question) => question.id,
            Self::Toolpath(question) => question.id,
            Self::Window(question) => question.id,
            Self::Placement(question) => question.id,
            Self::Origins(question) => question.id,
            Self::Subtask(subtask) => subtask.id(),
        }
    }

    /// The kind of the answer.
    pub(crate) fn kind(&self) -> QuestionKind {
        match self {
            Self::Workspace(_) => QuestionKind::Workspace,
            Self::Family(_) => QuestionKind::Family,
            Self::Dexterity(_) => QuestionKind::Dexterity,
            Self::ErrorMap(_) => QuestionKind::ErrorMap,
            Self::Toolpath(_) => QuestionKind::Toolpath,
            Self::Window(_) => QuestionKind::Window,
            Self::Placement(_) => QuestionKind::Placement,
            Self::Origins(_) => QuestionKind::Origins,
            Self::Subtask(_) => QuestionKind::Subtask,
        }
    }

    /// Estimates the work, in seconds of one core. It takes some milliseconds: call it on the compute pool.
    ///
    /// # Errors
    ///
    /// A mesh, of a family any mesh, is likely to have more than `max_triangles` triangles. The grid of a dexterity map
    /// has a limit of its own.
    pub(crate) fn cost(&self, max_triangles: u64, observer: &dyn Observer) -> Result<f64, OperationError> {
        let (triangles, workspaces) = match self {
            Self::Workspace(question) => (question.triangles(observer)?, 1),
            Self::Family(family) => (family.triangles(observer)?, family.count()),
            Self::Dexterity(question) => return Ok(question.cost()),
            Self::ErrorMap(question) => return question.cost(max_triangles, observer),
            Self::Toolpath(question) => return Ok(question.cost),
            Self::Window(question) => return Ok(question.cost()),
            Self::Placement(question) => return Ok(question.cost()),
            Self::Origins(question) => return Ok(question.cost()),
            Self::Subtask(_) => return Err(OperationError::Internal),
        };
        check_triangles(triangles, max_triangles)?;
        Ok(workspace_cost(triangles) * f64::from(workspaces))
    }

    /// The question as text: with the parameters of a job as its payload, without them as part of a stored result.
    pub(crate) fn to_text(&self, parameters: Option<JobParameters>) -> Result<Vec<u8>, OperationError> {
        let (machine, request) = match self {
            Self::Workspace(question) => (&question.machine, CanonicalRequest::Workspace(question.request)),
            Self::Family(family) => (&family.machine, CanonicalRequest::Family(family.request.clone())),
            Self::Dexterity(map) => (&map.machine, CanonicalRequest::Dexterity(map.request)),
            Self::ErrorMap(map) => (&map.machine, CanonicalRequest::ErrorMap(Box::new(map.request))),
            Self::Toolpath(path) => {
                (&path.machine, CanonicalRequest::Toolpath(Box::new(path.request.clone())))
            }
            Self::Window(question) => {
                (&question.toolpath.machine, CanonicalRequest::Window(Box::new(question.request())))
            }
            Self::Placement(question) => {
                (&question.toolpath.machine, CanonicalRequest::Placement(Box::new(question.request())))
            }
            Self::Origins(question) => {
                (&question.toolpath.machine, CanonicalRequest::Origins(Box::new(question.request())))
            }
            Self::Subtask(subtask) => (&subtask.machine, CanonicalRequest::Subtask(subtask.request.clone())),
        };
        let hash = Arc::clone(&machine.id.hash);
        let machine = MachineObject::from(machine.data());
        let cost = match self {
            Self::Toolpath(question) => Some(question.cost),
            Self::Window(question) => Some(question.toolpath.cost),
            Self::Placement(question) => Some(question.toolpath.cost),
            Self::Origins(question) => Some(question.toolpath.cost),
            _ => None,
        };
        write_json(&QuestionText { request, machine, hash, cost, parameters }, TEXT_BYTES)
    }

    /// Reads a question from its text, and prepares its machine.
    ///
    /// # Errors
    ///
    /// [`OperationError::OtherVersion`] if the id differs: a binary of another version, or for another target, wrote
    /// the text and meant another answer.
    pub(crate) fn from_text(text: &[u8], id: ResultId) -> Result<Self, OperationError> {
        let text: QuestionText = serde_json::from_slice(text).map_err(|_| OperationError::OtherVersion)?;
        let machine =
            IdentifiedMachine::from_object(&text.machine).map_err(|_| OperationError::OtherVersion)?.into();
        let toolpath =
            |machine, request| ToolpathQuestion::of(machine, request, text.cost.unwrap_or_default());
        let question = match text.request {
            CanonicalRequest::Workspace(request) => Self::Workspace(WorkspaceQuestion::of(machine, request)),
            CanonicalRequest::Family(request) => Self::Family(FamilyQuestion::of(machine, request)),
            CanonicalRequest::Dexterity(request) => Self::Dexterity(DexterityQuestion::of(machine, request)),
            CanonicalRequest::ErrorMap(request) => {
                Self::ErrorMap(Box::new(ErrorMapQuestion::of(machine, &request)))
            }
            CanonicalRequest::Toolpath(request) => Self::Toolpath(Box::new(toolpath(machine, *request))),
            CanonicalRequest::Window(request) => {
                let CanonicalWindow { toolpath: path, parameter, from, to } = *request;
                Self::Window(Box::new(WindowQuestion::of(toolpath(machine, path), parameter, [from, to])))
            }
            CanonicalRequest::Placement(request) => {
                let CanonicalPlacement { toolpath: path, free, reserve } = *request;
                Self::Placement(Box::new(PlacementQuestion::of(toolpath(machine, path), free, reserve)))
            }
            CanonicalRequest::Origins(request) => {
                let CanonicalOrigins { toolpath: path, cell } = *request;
                Self::Origins(Box::new(OriginsQuestion::of(toolpath(machine, path), cell)))
            }
            CanonicalRequest::Subtask(request) => Self::Subtask(Subtask { machine, request }),
        };
        if question.id() == id { Ok(question) } else { Err(OperationError::OtherVersion) }
    }

    /// The question as a job of a client.
    pub(crate) fn submission(
        &self,
        parameters: JobParameters,
        client: String,
        deadline: Option<Duration>,
    ) -> Result<Submission, OperationError> {
        let payload = self.to_text(Some(parameters))?.into();
        Ok(Submission { id: self.id().job(), client, cost: parameters.cost, payload, deadline })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use serde::de::DeserializeOwned;
    use serde_json::{Value, from_value, json};
    use verne_solver::Machine;

    use super::Question;
    use crate::operations::dexterity_question::DexterityQuestion;
    use crate::operations::error_map_question::ErrorMapQuestion;
    use crate::operations::family_question::FamilyQuestion;
    use crate::operations::machine_registry::MachineRegistry;
    use crate::operations::question_text::{JobParameters, QuestionHeader};
    use crate::operations::subtask::Subtask;
    use crate::operations::workspace_question::WorkspaceQuestion;
    use crate::wire::format::MeshFormat;
    use crate::wire::machine::MachineObject;

    fn request<T: DeserializeOwned>(value: Value) -> T {
        from_value(value).unwrap()
    }

    #[test]
    fn questions_read_from_their_text_have_the_same_id() {
        let machines = MachineRegistry::default();
        let part = json!({"kind": "part", "phi1": 0.1, "table_clearance": 0});
        let family = json!({"kind": "tool", "tool_length": [50, 0.3]});
        let map = json!({"phi1": {"from": -20, "to": 20.1}, "cell": 100});
        let errors = json!({"kind": "part", "tool_length": 0.3, "cell": 100, "parameter_tolerances":
            {"L1": 0.1, "tilt_zero": 0.003}});
        let errors = ErrorMapQuestion::new(&request(errors), &machines).unwrap();
        let family = FamilyQuestion::new(&request(family), &machines).unwrap();
        let map = DexterityQuestion::new(&request(map), &machines).unwrap();
        let subtasks = Subtask::of_family(&family).into_iter().chain(Subtask::of_map(&map));
        let subtasks = subtasks.chain(Subtask::of_error_map(&errors));
        let mut questions: Vec<Question> = subtasks.map(Question::Subtask).collect();
        questions.push(Question::Workspace(WorkspaceQuestion::new(&request(part), &machines).unwrap()));
        questions.push(Question::Family(family));
        questions.push(Question::Dexterity(map));
        questions.push(Question::ErrorMap(Box::new(errors)));
        let parameters = JobParameters { max_triangles: 10, cost: 0.1, mesh_format: Some(MeshFormat::Glb) };
        for question in questions {
            let text = question.to_text(Some(parameters)).unwrap();
            let read = Question::from_text(&text, question.id()).unwrap();
            assert_eq!((read.id(), read.kind()), (question.id(), question.kind()));
            assert_eq!(QuestionHeader::read(&text).unwrap().kind, question.kind());
            assert_eq!(JobParameters::read(&text).unwrap().cost.to_bits(), 0.1_f64.to_bits());
        }
    }

    #[test]
    fn drives_change_no_id_and_reach_the_worker() {
        let plain = MachineObject::from(Machine::verne().data());
        let mut machine = serde_json::to_value(&plain).unwrap();
        let axis = json!({"velocity": 50, "acceleration": 0.001});
        machine["drives"] = json!({"slider": {"velocity": 500}, "tilt": axis, "rotary": {"velocity": 1e6}});
        let machines = MachineRegistry::default();
        let asked = |machine: &Value| {
            let workspace = json!({"kind": "part", "tolerance": 5, "machine": machine});
            let map = json!({"phi1": {"from": -20, "to": 20}, "machine": machine});
            [
                Question::Workspace(WorkspaceQuestion::new(&request(workspace), &machines).unwrap()),
                Question::Dexterity(DexterityQuestion::new(&request(map), &machines).unwrap()),
            ]
        };
        for (with, without) in asked(&machine).into_iter().zip(asked(&json!("verne"))) {
            assert_eq!(with.id(), without.id());
            let text = with.to_text(None).unwrap();
            assert!(Question::from_text(&text, without.id()).is_ok());
            let text: Value = serde_json::from_slice(&text).unwrap();
            let drives: MachineObject = from_value(text["machine"].clone()).unwrap();
            assert_eq!(drives, from_value(machine.clone()).unwrap(), "to the last digit");
        }
    }
}
