//! Runs jobs: reads the question of a job, computes its answer and stores it among the results.

use std::sync::Arc;
use std::time::Instant;

use bytes::Bytes;
use tokio::runtime::Handle;
use tracing::info_span;
use verne_jobs::{JobId, RunControl, Submission, Work, WorkError};
use verne_solver::workspace::Observer;

use crate::operations::blocking_results::BlockingResults;
use crate::operations::dexterity_job::{self, DEXTERITY_MAP};
use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::dexterity_subtasks::{compute_slab, compute_volumes};
use crate::operations::document_job::answer_document;
use crate::operations::error_map_job::{self, ERROR_MAP};
use crate::operations::error_map_question::ErrorMapQuestion;
use crate::operations::error_map_subtasks;
use crate::operations::family_question::FamilyQuestion;
use crate::operations::family_table::FamilyTable;
use crate::operations::mesh_files::{MeshDescription, mesh_file_name, write_mesh};
use crate::operations::observers::{ObserverFns, equal_section};
use crate::operations::origins_job::{answer_part, merge_region};
use crate::operations::question::Question;
use crate::operations::question_text::JobParameters;
use crate::operations::results::{MESH, Results, pack_mesh};
use crate::operations::subtask::{Subtask, SubtaskRequest};
use crate::operations::toolpath_job::answer_toolpath;
use crate::operations::workspace::compute_workspace;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::telemetry::metrics::computations::ComputationMetrics;
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::result_id::ResultId;

/// The blob of a subtask's result.
const SUBTASK: &str = "subtask";

/// About the bytes of a job's error.
const ERROR_BYTES: usize = 256;

/// Computes the answers of jobs on the threads of the queue, and stores them.
pub(crate) struct JobExecutor {
    store: BlockingResults,
    computations: ComputationMetrics,
}

impl JobExecutor {
    /// An executor that stores its answers in `results` and counts them in `computations`. `runtime` runs the store.
    pub(crate) fn new(results: Results, computations: ComputationMetrics, runtime: Handle) -> Self {
        Self { store: BlockingResults { results, runtime }, computations }
    }

    fn answer(
        &self,
        question: &Question,
        parameters: JobParameters,
        observer: &dyn Observer,
    ) -> Result<(), OperationError> {
        match question {
            Question::Workspace(workspace) => self.workspace(workspace, parameters, observer).map(drop),
            Question::Family(family) => self.family(question, family, parameters, observer),
            Question::Dexterity(_) | Question::ErrorMap(_) | Question::Origins(_) => {
                self.merged(question, parameters, observer)
            }
            Question::Toolpath(path) => answer_toolpath(&self.store, path, &self.computations, observer),
            Question::Window(_) | Question::Placement(_) => {
                answer_document(&self.store, question, &self.computations, observer)
            }
            Question::Subtask(subtask) => self.subtask(subtask, parameters, observer).map(drop),
        }
    }

    /// The summary of a workspace. Computes and stores the workspace unless the store has its record and its mesh.
    fn workspace(
        &self,
        question: &WorkspaceQuestion,
        parameters: JobParameters,
        observer: &dyn Observer,
    ) -> Result<Bytes, OperationError> {
        if let Some(record) = self.store.complete_record(question.id, &[MESH]) {
            return Ok(record.summary.bytes);
        }
        self.computations.count();
        let computed = compute_workspace(question, parameters.max_triangles(), observer)?;
        self.store.put_blob(question.id, MESH, pack_mesh(&computed.mesh)?)?;
        if let Some(format) = parameters.mesh_format {
            let file = write_mesh(&MeshDescription::of_workspace(question), &computed.mesh, format)?;
            self.store.put_blob(question.id, &mesh_file_name(MESH, format), file)?;
        }
        let question = Question::Workspace(question.clone());
        self.store.put_record(&question, &computed.summary, computed.inclination)?;
        Ok(computed.summary.into())
    }

    /// The summary of a family's member, or the reason why it has none. The reason is a stored result as well.
    fn member(
        &self,
        member: &WorkspaceQuestion,
        parameters: JobParameters,
        observer: &dyn Observer,
    ) -> Result<Result<Bytes, OperationError>, OperationError> {
        let id = Subtask::of_member(member).id();
        if let Some(error) = self.store.blob(id, SUBTASK) {
            return Ok(Err(serde_json::from_slice(&error).map_err(|_| OperationError::Internal)?));
        }
        match self.workspace(member, parameters, observer) {
            Err(error @ OperationError::Fields(_)) => {
                self.store.put_blob(id, SUBTASK, write_json(&error, ERROR_BYTES)?)?;
                Ok(Err(error))
            }
            summary => summary.map(Ok),
        }
    }

    fn family(
        &self,
        question: &Question,
        family: &FamilyQuestion,
        parameters: JobParameters,
        observer: &dyn Observer,
    ) -> Result<(), OperationError> {
        let members = family.members.len();
        let mut table = FamilyTable::with_capacity(members);
        for (i, member) in family.members.iter().enumerate() {
            let summary = self.member(member, parameters, &equal_section(observer, i, members))?;
            table.add(member, summary)?;
        }
        self.store.put_record(question, &table.write(family)?, None)
    }

    /// The bytes of a subtask's result, stored or computed. A member has none unless it failed: its workspace is the
    /// result.
    fn subtask(
        &self,
        subtask: &Subtask,
        parameters: JobParameters,
        observer: &dyn Observer,
    ) -> Result<Bytes, OperationError> {
        let id = subtask.id();
        if let Some(stored) = self.store.blob(id, SUBTASK) {
            return Ok(stored);
        }
        let machine = Arc::clone(&subtask.machine);
        let computed = match &subtask.request {
            SubtaskRequest::Member(member) => {
                let member = WorkspaceQuestion::of(machine, *member);
                return self.member(&member, parameters, observer).map(|_| Bytes::new());
            }
            SubtaskRequest::Slab { map, number, count } => {
                compute_slab(&DexterityQuestion::of(machine, *map), [*number, *count], observer)?
            }
            SubtaskRequest::Volumes(map) => compute_volumes(&DexterityQuestion::of(machine, *map), observer)?,
            SubtaskRequest::Origins { region, part } => {
                answer_part(&self.store, &subtask.region(region), *part, observer)?
            }
            SubtaskRequest::ErrorSlab { map, number, count } => {
                let map = ErrorMapQuestion::of(machine, map);
                error_map_subtasks::compute_slab(&map, [*number, *count], observer)?
            }
            SubtaskRequest::ErrorSurface(map) => {
                let map = ErrorMapQuestion::of(machine, map);
                error_map_subtasks::compute_surface(&map, parameters.max_triangles(), observer)?
            }
        };
        self.computations.count();
        self.store.put_blob(id, SUBTASK, computed)
    }

    /// Merges an answer from the results of its subtasks, and computes those that the store has evicted.
    fn merged(
        &self,
        question: &Question,
        parameters: JobParameters,
        observer: &dyn Observer,
    ) -> Result<(), OperationError> {
        let subtasks = self.subtasks(question);
        if subtasks.is_empty() {
            return Ok(());
        }
        let parts = self.parts(&subtasks, parameters, observer)?;
        match question {
            Question::Dexterity(map) => dexterity_job::merge_and_store(&self.store, map, &parts, observer),
            Question::ErrorMap(map) => error_map_job::merge_and_store(&self.store, map, &parts, observer),
            Question::Origins(region) => merge_region(&self.store, region, &parts, observer),
            _ => Err(OperationError::Internal),
        }
    }

    /// The results of subtasks.
    fn parts(
        &self,
        subtasks: &[Subtask],
        parameters: JobParameters,
        observer: &dyn Observer,
    ) -> Result<Vec<Bytes>, OperationError> {
        let part =
            |(i, subtask)| self.subtask(subtask, parameters, &equal_section(observer, i, subtasks.len()));
        subtasks.iter().enumerate().map(part).collect()
    }

    /// The subtasks from which a question's answer is merged; none if the answer is stored.
    fn subtasks(&self, question: &Question) -> Vec<Subtask> {
        let (subtasks, blobs): (_, &[&str]) = match question {
            Question::Workspace(_)
            | Question::Toolpath(_)
            | Question::Window(_)
            | Question::Placement(_)
            | Question::Subtask(_) => return Vec::new(),
            Question::Family(family) => (Subtask::of_family(family), &[]),
            Question::Dexterity(map) => (Subtask::of_map(map), &DEXTERITY_MAP),
            Question::ErrorMap(map) => (Subtask::of_error_map(map), &ERROR_MAP),
            Question::Origins(region) => (Subtask::of_region(region), &[MESH]),
        };
        if self.store.complete_record(question.id(), blobs).is_some() { Vec::new() } else { subtasks }
    }

    /// The question of a job, which may come from another process.
    fn question(&self, job: JobId, payload: &[u8]) -> Result<Arc<Question>, OperationError> {
        self.store.results.questions.get_or_read(ResultId::from(job), payload)
    }

    fn submissions(&self, job: JobId, payload: &[u8]) -> Result<Vec<Submission>, OperationError> {
        let subtasks = self.subtasks(&*self.question(job, payload)?);
        if subtasks.is_empty() {
            return Ok(Vec::new());
        }
        let parameters = JobParameters { mesh_format: None, ..JobParameters::read(payload)? };
        let count = u32::try_from(subtasks.len()).unwrap_or(u32::MAX);
        // The deadline of the job holds for its subtasks.
        let submission = |subtask: Subtask| {
            let cost = subtask.cost(parameters.cost, count);
            let question = Arc::new(Question::Subtask(subtask));
            let submission = question.submission(JobParameters { cost, ..parameters }, String::new(), None);
            self.store.results.questions.insert(question);
            submission
        };
        let mut submissions =
            subtasks.into_iter().map(submission).collect::<Result<Vec<_>, OperationError>>()?;
        // The longest first: otherwise one worker might compute it at the end while the others have nothing to do.
        submissions.sort_by(|one, other| other.cost.total_cmp(&one.cost));
        Ok(submissions)
    }
}

impl Work for JobExecutor {
    fn subtasks(&self, job: &JobId, payload: &[u8]) -> Result<Vec<Submission>, WorkError> {
        self.submissions(*job, payload).map_err(|error| stop(&error))
    }

    fn run(&self, job: &JobId, payload: &[u8], control: &dyn RunControl) -> Result<(), WorkError> {
        let question = self.question(*job, payload).map_err(|error| stop(&error))?;
        let kind = question.kind().name();
        let _span = info_span!("job", %job, kind).entered();
        let began = Instant::now();
        let parameters = JobParameters::read(payload).map_err(|error| stop(&error))?;
        let observer = ObserverFns {
            progress: |fraction| control.progress(fraction),
            cancelled: || control.cancelled(),
        };
        let answered = self.answer(&question, parameters, &observer).map_err(|error| stop(&error));
        let outcome = match &answered {
            Ok(()) => "succeeded",
            Err(WorkError::Cancelled) => "stopped",
            Err(WorkError::Failed(_)) => "failed",
            Err(WorkError::CannotRunHere(_)) => "handed_on",
        };
        self.computations.ran(kind, outcome, began.elapsed());
        answered
    }
}

fn stop(error: &OperationError) -> WorkError {
    let reason = write_json(error, ERROR_BYTES).unwrap_or_default().into();
    match error {
        OperationError::Cancelled => WorkError::Cancelled,
        // A worker of the other version, or one that reaches the store, may succeed.
        OperationError::OtherVersion | OperationError::StoreUnavailable => WorkError::CannotRunHere(reason),
        _ => WorkError::Failed(reason),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests;
