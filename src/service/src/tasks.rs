//! What jobs compute: the answer to a written question, kept among the results.

use tokio::runtime::Handle;
use verne_jobs::{JobId, Stop, Watch, Work};
use verne_solver::workspace::Observer;

use crate::answers::{FamilyQuestion, FamilyTable, Question, TaskFault, compute_workspace, part_of};
use crate::answers::WorkspaceQuestion;
use crate::error::Error;
use crate::result_id::ResultId;
use crate::results::Results;
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
        }
    }

    /// Computes a workspace unless it is there, mesh and all; its summary.
    fn workspace(&self, asked: &WorkspaceQuestion, observer: &dyn Observer) -> Result<Vec<u8>, Error> {
        let known = self.runtime.block_on(async {
            let record = self.results.record(asked.id).await?;
            self.results.mesh(asked.id).await.map(|_| record.summary)
        });
        if let Some(summary) = known {
            return Ok(summary.bytes.to_vec());
        }
        let computed = compute_workspace(asked, observer)?;
        let question = Question::Workspace(asked.clone());
        let mesh = Some((&computed.mesh, computed.inclination));
        self.runtime.block_on(self.results.keep(&question, &computed.summary, mesh))?;
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
        self.runtime.block_on(self.results.keep(&Question::Family(family.clone()), &summary, None))
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
