//! What jobs compute: the answer to a written question, kept among the results.

use tokio::runtime::Handle;
use verne_jobs::{JobId, Stop, Watch, Work};
use verne_solver::workspace::Observer;

use crate::answers::{
    DexterityQuestion, FamilyQuestion, FamilyTable, Question, TaskFault, WorkspaceQuestion,
    compute_dexterity, compute_workspace, part_of,
};
use crate::error::Error;
use crate::result_id::ResultId;
use crate::results::{CELLS, MESH, Record, Results, packed_mesh};
use crate::wire::dexterity::SetName;
use crate::wire::json::write_json;

/// About the bytes of a failure.
const FAULT_BYTES: usize = 256;

/// Answers questions on the threads of the queue.
pub(crate) struct Tasks {
    results: Results,
    /// The store is asked on the runtime; the queue's threads are none of its own and may wait for it.
    runtime: Handle,
}

impl Tasks {
    /// Keeps what it computes among these results.
    pub(crate) fn new(results: Results, runtime: Handle) -> Self {
        Self { results, runtime }
    }

    fn answer(&self, question: &Question, observer: &dyn Observer) -> Result<(), Error> {
        match question {
            Question::Workspace(workspace) => self.workspace(workspace, observer).map(drop),
            Question::Family(family) => self.family(family, observer),
            Question::Dexterity(dexterity) => self.dexterity(dexterity, observer),
        }
    }

    /// Computes a workspace unless it is there, mesh and all; its summary.
    fn workspace(&self, asked: &WorkspaceQuestion, observer: &dyn Observer) -> Result<Vec<u8>, Error> {
        if let Some(record) = self.known(asked.id, &[MESH]) {
            return Ok(record.summary.bytes.to_vec());
        }
        let computed = compute_workspace(asked, observer)?;
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

    fn family(&self, family: &FamilyQuestion, observer: &dyn Observer) -> Result<(), Error> {
        let members = family.members.len();
        let mut table = FamilyTable::with_room(members);
        for (i, member) in family.members.iter().enumerate() {
            let summary = self.workspace(member, &part_of(observer, i, members));
            table.add(member, summary.as_deref().map_err(Clone::clone))?;
        }
        let summary = table.written(family)?;
        let question = Question::Family(family.clone());
        self.runtime.block_on(self.results.keep(&question, &summary, Vec::new(), None))
    }

    fn dexterity(&self, asked: &DexterityQuestion, observer: &dyn Observer) -> Result<(), Error> {
        let names = SetName::ALL.map(SetName::name);
        if self.known(asked.id, &[names[0], names[1], CELLS]).is_some() {
            return Ok(());
        }
        let computed = compute_dexterity(asked, observer)?;
        let mut parts = vec![(CELLS, computed.cells)];
        for (name, mesh) in names.into_iter().zip(&computed.meshes) {
            parts.push((name, packed_mesh(mesh)?));
        }
        let question = Question::Dexterity(asked.clone());
        self.runtime.block_on(self.results.keep(&question, &computed.summary, parts, None))
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
    fn run(&self, job: &JobId, payload: &[u8], watch: &dyn Watch) -> Result<(), Stop> {
        let answer = Question::read(payload, ResultId::from(*job))
            .and_then(|question| self.answer(&question, &Watched(watch)));
        answer.map_err(|error| match error {
            Error::Cancelled => Stop::Cancelled,
            error => {
                let fault = write_json(&TaskFault::from(error), FAULT_BYTES);
                Stop::Failed(fault.unwrap_or_default().into())
            }
        })
    }
}

/// The queue's view of a run as the solver's.
struct Watched<'a>(&'a dyn Watch);

impl Observer for Watched<'_> {
    fn progress(&self, part: f64) {
        self.0.progress(part);
    }

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
