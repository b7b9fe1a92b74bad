//! What jobs compute: the answer to a written question, kept among the results.

use std::time::Instant;

use axum::body::Bytes;
use tokio::runtime::Handle;
use tracing::info_span;
use verne_jobs::{JobId, RunControl, Submission, Work, WorkError};
use verne_solver::workspace::Observer;

use crate::operations::dexterity::merge_dexterity;
use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::dexterity_subtasks::{compute_slab, compute_volumes};
use crate::operations::family::FamilyTable;
use crate::operations::family_question::FamilyQuestion;
use crate::operations::question::{Question, TaskFault, Terms};
use crate::operations::results::{CELLS, MESH, Record, Results, packed_mesh};
use crate::operations::subprogress::part_of;
use crate::operations::subtask::Piece;
use crate::operations::workspace::compute_workspace;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::telemetry::metrics::computations::Computations;
use crate::wire::dexterity::SetName;
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::result_id::ResultId;

/// The parts of a dexterity map.
const MAP: [&str; 3] = [SetName::Reachable.name(), SetName::Dexterous.name(), CELLS];

/// The one part of a piece.
const PIECE: &str = "piece";

/// About the bytes of a failure.
const FAULT_BYTES: usize = 256;

/// Answers questions on the threads of the queue.
pub(crate) struct Tasks {
    results: Results,
    computations: Computations,
    /// The store is asked on the runtime; the queue's threads are none of its own and may wait for it.
    runtime: Handle,
}

impl Tasks {
    /// Keeps what it computes among these results, and counts it.
    pub(crate) fn new(results: Results, computations: Computations, runtime: Handle) -> Self {
        Self { results, computations, runtime }
    }

    /// A mesh may have `most` triangles.
    fn answer(
        &self,
        question: &Question,
        most: usize,
        observer: &dyn Observer,
    ) -> Result<(), OperationError> {
        match question {
            Question::Workspace(workspace) => self.workspace(workspace, most, observer).map(drop),
            Question::Family(family) => self.family(family, most, observer),
            Question::Dexterity(map) => self.dexterity(map, most, observer),
            Question::Piece(piece) => self.piece(piece, most, observer).map(drop),
        }
    }

    /// Computes a workspace unless it is there, mesh and all; its summary.
    fn workspace(
        &self,
        asked: &WorkspaceQuestion,
        most: usize,
        observer: &dyn Observer,
    ) -> Result<Vec<u8>, OperationError> {
        if let Some(record) = self.known(asked.id, &[MESH]) {
            return Ok(record.summary.bytes.to_vec());
        }
        self.computations.count();
        let computed = compute_workspace(asked, most, observer)?;
        let parts = vec![(MESH, packed_mesh(&computed.mesh)?)];
        let question = Question::Workspace(asked.clone());
        self.runtime.block_on(self.results.keep(
            &question,
            &computed.summary,
            parts,
            computed.inclination,
        ))?;
        Ok(computed.summary)
    }

    /// A member's summary, or why it has none, which is a result as well.
    fn member(
        &self,
        member: &WorkspaceQuestion,
        most: usize,
        observer: &dyn Observer,
    ) -> Result<Result<Vec<u8>, OperationError>, OperationError> {
        let piece = Piece::Member(member.clone()).id();
        if let Some(fault) = self.kept(piece) {
            let fault: TaskFault = serde_json::from_slice(&fault).map_err(|_| OperationError::Internal)?;
            return Ok(Err(fault.into()));
        }
        match self.workspace(member, most, observer) {
            Err(OperationError::Fields(faults)) => {
                let fault = write_json(&TaskFault::Fields(faults.clone()), FAULT_BYTES)?;
                self.keep(piece, fault)?;
                Ok(Err(OperationError::Fields(faults)))
            }
            summary => summary.map(Ok),
        }
    }

    fn family(
        &self,
        family: &FamilyQuestion,
        most: usize,
        observer: &dyn Observer,
    ) -> Result<(), OperationError> {
        let members = family.members.len();
        let mut table = FamilyTable::with_room(members);
        for (i, member) in family.members.iter().enumerate() {
            let summary = self.member(member, most, &part_of(observer, i, members))?;
            table.add(member, summary.as_deref().map_err(Clone::clone))?;
        }
        let summary = table.written(family)?;
        let question = Question::Family(family.clone());
        self.runtime.block_on(self.results.keep(&question, &summary, Vec::new(), None))
    }

    /// A piece's bytes, kept or made. Of a member there are none unless it failed.
    fn piece(&self, piece: &Piece, most: usize, observer: &dyn Observer) -> Result<Bytes, OperationError> {
        if let Some(kept) = self.kept(piece.id()) {
            return Ok(kept);
        }
        let made = match piece {
            Piece::Member(member) => return self.member(member, most, observer).map(|_| Bytes::new()),
            Piece::Slab { of, number, count } => compute_slab(of, [*number, *count], observer)?,
            Piece::Volumes(map) => compute_volumes(map, observer)?,
        };
        self.computations.count();
        self.keep(piece.id(), made)
    }

    /// Merges a map from its pieces; one that has made room for others is made again.
    fn dexterity(
        &self,
        map: &DexterityQuestion,
        most: usize,
        observer: &dyn Observer,
    ) -> Result<(), OperationError> {
        if self.known(map.id, &MAP).is_some() {
            return Ok(());
        }
        let pieces = Piece::of_map(map);
        let made = pieces
            .iter()
            .enumerate()
            .map(|(i, piece)| self.piece(piece, most, &part_of(observer, i, pieces.len())));
        let made = made.collect::<Result<Vec<Bytes>, OperationError>>()?;
        let Some((volumes, slabs)) = made.split_last() else { return Err(OperationError::Internal) };
        let computed = merge_dexterity(map, slabs, volumes, observer)?;
        let [reachable, dexterous] = &computed.meshes;
        let parts = [packed_mesh(reachable)?, packed_mesh(dexterous)?, computed.cells];
        let parts = MAP.into_iter().zip(parts).collect();
        let question = Question::Dexterity(map.clone());
        self.runtime.block_on(self.results.keep(&question, &computed.summary, parts, None))
    }

    fn kept(&self, piece: ResultId) -> Option<Bytes> {
        self.runtime.block_on(self.results.part(piece, PIECE)).map(|content| content.bytes)
    }

    fn keep(&self, piece: ResultId, bytes: Vec<u8>) -> Result<Bytes, OperationError> {
        self.runtime.block_on(self.results.keep_part(piece, PIECE, bytes)).map(|content| content.bytes)
    }

    /// What a question's answer is merged from, unless the answer is there.
    fn pieces(&self, question: &Question) -> Vec<Piece> {
        let (pieces, parts): (_, &[&str]) = match question {
            Question::Workspace(_) | Question::Piece(_) => return Vec::new(),
            Question::Family(family) => (Piece::of_family(family), &[]),
            Question::Dexterity(map) => (Piece::of_map(map), &MAP),
        };
        if self.known(question.id(), parts).is_some() { Vec::new() } else { pieces }
    }

    /// The record of a result that is there with these parts.
    fn known(&self, id: ResultId, parts: &[&str]) -> Option<Record> {
        self.runtime.block_on(async {
            let record = self.results.record(id).await?;
            for part in parts {
                self.results.part(id, part).await?;
            }
            Some(record)
        })
    }
}

impl Work for Tasks {
    fn subtasks(&self, job: &JobId, payload: &[u8]) -> Result<Vec<Submission>, WorkError> {
        let question = Question::read(payload, ResultId::from(*job)).map_err(stop)?;
        let pieces = self.pieces(&question);
        let (whole, count) = (Terms::read(payload).map_err(stop)?, u32::try_from(pieces.len()));
        // The job's own deadline holds for all of them.
        let submission = |piece: Piece| {
            let cost = piece.cost(whole.cost, count.unwrap_or(u32::MAX));
            Question::Piece(piece).submission(Terms { cost, ..whole }, String::new(), None)
        };
        let mut pieces =
            pieces.into_iter().map(submission).collect::<Result<Vec<_>, OperationError>>().map_err(stop)?;
        // The longest first: at the end one worker would have it while the others had nothing.
        pieces.sort_by(|one, other| other.cost.total_cmp(&one.cost));
        Ok(pieces)
    }

    fn run(&self, job: &JobId, payload: &[u8], control: &dyn RunControl) -> Result<(), WorkError> {
        let question = Question::read(payload, ResultId::from(*job)).map_err(stop)?;
        let _span = info_span!("job", %job, kind = question.kind()).entered();
        let began = Instant::now();
        let most = Terms::read(payload).map_err(stop)?.most();
        let answered = self.answer(&question, most, &Watched(control)).map_err(stop);
        let outcome = match &answered {
            Ok(()) => "succeeded",
            Err(WorkError::Cancelled) => "stopped",
            Err(WorkError::Failed(_)) => "failed",
            Err(WorkError::CannotRunHere(_)) => "handed_on",
        };
        self.computations.ran(question.kind(), outcome, began.elapsed());
        answered
    }
}

fn stop(error: OperationError) -> WorkError {
    match error {
        OperationError::Cancelled => WorkError::Cancelled,
        // A worker of that version can, or one that reaches the store.
        error @ (OperationError::OtherVersion | OperationError::StoreUnavailable) => {
            WorkError::CannotRunHere(written(error))
        }
        error => WorkError::Failed(written(error)),
    }
}

fn written(error: OperationError) -> Bytes {
    write_json(&TaskFault::from(error), FAULT_BYTES).unwrap_or_default().into()
}

/// The queue's view of a run as the solver's.
struct Watched<'a>(&'a dyn RunControl);

impl Observer for Watched<'_> {
    fn progress(&self, part: f64) {
        self.0.progress(part);
    }

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
