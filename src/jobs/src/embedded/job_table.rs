//! Jobs that have not ended, and the slots that run them.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::sync::Arc;
use std::time::Instant;

use tokio::sync::watch;

use super::queue::{DequeuedJob, Queue};
use super::waiting_parent::{SubtaskState, WaitingParent};
use crate::counts::Counts;
use crate::error::UnavailableError;
use crate::execution::run::Run;
use crate::execution::slot::{Slot, SlotKind};
use crate::execution::stop::StopSignal;
use crate::job_id::{JobId, JobKey};
use crate::job_watch::JobSender;

/// Whether a submission is durable; `None` until that is known.
pub(super) type Recorded = watch::Receiver<Option<Result<(), UnavailableError>>>;

/// A job that is queued or running, or whose end is not recorded yet.
pub(super) struct Entry {
    pub(super) key: JobKey,
    pub(super) job: JobSender,
    pub(super) recorded: Recorded,
    pub(super) deadline: Option<Instant>,
    pub(super) claims: usize,
    /// The job continues without claims.
    pub(super) detached: bool,
    /// Jobs that wait for this one as their subtask.
    pub(super) parents: Vec<JobKey>,
    /// No client has submitted the job.
    pub(super) is_only_subtask: bool,
    pub(super) subtasks: SubtaskState,
    /// The present run.
    pub(super) run: Option<Arc<Run>>,
}

impl Entry {
    /// Whether a submission can join the job: it has not ended and was not told to stop.
    pub(super) fn is_active(&self) -> bool {
        !self.job.state().is_final() && self.stop_signal().is_none()
    }

    pub(super) fn stop_signal(&self) -> Option<StopSignal> {
        self.run.as_ref().and_then(|run| run.stop_signal())
    }

    pub(super) fn is_wanted(&self) -> bool {
        self.claims > 0 || self.detached || !self.parents.is_empty()
    }
}

pub(super) struct JobTable {
    pub(super) jobs: HashMap<JobId, Entry>,
    pub(super) queue: Queue,
    /// Runs by generation. Runs of earlier generations are here until they stop.
    pub(super) running: HashMap<u64, Arc<Run>>,
    pub(super) free_slots: Vec<Slot>,
    /// Jobs that wait for their subtasks.
    pub(super) waiting: usize,
    /// Sum of their payloads.
    pub(super) waiting_bytes: usize,
    /// Jobs with subtasks to submit, by generation.
    pub(super) submitting: BTreeMap<u64, JobId>,
    /// Jobs that had too many attempts when the records were opened.
    pub(super) given_up: HashSet<JobId>,
    /// Deadlines of jobs that have not ended.
    pub(super) deadlines: BTreeSet<(Instant, JobKey)>,
    pub(super) last_generation: u64,
    /// No more jobs are accepted or started.
    pub(super) closed: bool,
    pub(super) counts: Counts,
}

impl JobTable {
    pub(super) fn new(
        queue: Queue,
        free_slots: Vec<Slot>,
        last_generation: u64,
        given_up: HashSet<JobId>,
    ) -> Self {
        Self {
            jobs: HashMap::new(),
            queue,
            running: HashMap::new(),
            free_slots,
            waiting: 0,
            waiting_bytes: 0,
            submitting: BTreeMap::new(),
            given_up,
            deadlines: BTreeSet::new(),
            last_generation,
            closed: false,
            counts: Counts::default(),
        }
    }

    /// The entry of a job, if this is its latest generation.
    pub(super) fn entry(&mut self, key: JobKey) -> Option<&mut Entry> {
        self.jobs.get_mut(&key.id).filter(|entry| entry.key == key)
    }

    /// The latest generation of a job, if a submission can join it.
    pub(super) fn active(&self, id: JobId) -> Option<JobKey> {
        self.jobs.get(&id).filter(|entry| entry.is_active()).map(|entry| entry.key)
    }

    /// A free slot and the job to run in it. The express and the guest slot are for when the main slots are busy.
    pub(super) fn next(&mut self, now: Instant) -> Option<(Slot, DequeuedJob)> {
        [SlotKind::Main, SlotKind::Express, SlotKind::Guest].into_iter().find_map(|kind| {
            let slot = self.free_slots.iter().position(|slot| slot.kind == kind)?;
            let job = self.next_for(kind, now)?;
            Some((self.free_slots.swap_remove(slot), job))
        })
    }

    /// One client's jobs must not have all main slots and the guest slot while others wait: the last of these slots is
    /// for another client, and the guest slot is for nobody else.
    fn next_for(&mut self, kind: SlotKind, now: Instant) -> Option<DequeuedJob> {
        let free = self.free_slots.iter().filter(|slot| slot.kind != SlotKind::Express).count();
        let other = match self.only_client() {
            Some(client) if kind != SlotKind::Express && free == 1 => self.queue.take_other(&client, now),
            _ => None,
        };
        match kind {
            SlotKind::Guest => other,
            SlotKind::Main | SlotKind::Express => other.or_else(|| self.queue.take(kind, now)),
        }
    }

    /// The client of all jobs in the main slots and the guest slot, if it is one.
    fn only_client(&self) -> Option<String> {
        let mut runs = self.running.values().filter(|run| run.slot.kind != SlotKind::Express);
        let client = &runs.next()?.client;
        runs.all(|run| run.client == *client).then(|| client.clone())
    }

    pub(super) fn set_deadline(&mut self, key: JobKey, deadline: Option<Instant>) {
        let Some(entry) = self.entry(key) else {
            return;
        };
        if let Some(old) = std::mem::replace(&mut entry.deadline, deadline) {
            self.deadlines.remove(&(old, key));
        }
        if let Some(new) = deadline {
            self.deadlines.insert((new, key));
        }
    }

    /// The job, if it waits for its subtasks.
    pub(super) fn waiting_parent(&mut self, key: JobKey) -> Option<&mut WaitingParent> {
        match &mut self.entry(key)?.subtasks {
            SubtaskState::Waiting(parent) => Some(parent),
            SubtaskState::Unknown | SubtaskState::Finished => None,
        }
    }

    /// The job waits for its subtasks from now on.
    pub(super) fn start_waiting(&mut self, key: JobKey, parent: WaitingParent) {
        self.waiting += 1;
        self.waiting_bytes += parent.bytes;
        self.submitting.insert(key.generation, key.id);
        if let Some(entry) = self.entry(key) {
            (entry.run, entry.subtasks) = (None, SubtaskState::Waiting(parent));
        }
    }

    /// The job does not wait for its subtasks any more.
    pub(super) fn stop_waiting(&mut self, key: JobKey, state: SubtaskState) -> Option<WaitingParent> {
        self.waiting_parent(key)?;
        let SubtaskState::Waiting(parent) = std::mem::replace(&mut self.entry(key)?.subtasks, state) else {
            return None;
        };
        self.submitting.remove(&key.generation);
        self.waiting -= 1;
        self.waiting_bytes -= parent.bytes;
        Some(parent)
    }

    /// Adds a subtask's progress to that of its parents.
    pub(super) fn propagate_progress(&mut self, subtask: JobKey) {
        let Some(entry) = self.entry(subtask).filter(|entry| !entry.parents.is_empty()) else {
            return;
        };
        let (parents, progress) = (entry.parents.clone(), entry.job.job().progress);
        for parent in parents {
            if let Some(waiting) = self.waiting_parent(parent) {
                let of_parent = waiting.subtasks.set_progress(subtask.id, progress);
                self.set_progress(parent, of_parent);
            }
        }
    }

    /// Sets a waiting job's progress, and that of its own parents.
    pub(super) fn set_progress(&mut self, key: JobKey, progress: f64) {
        if self.entry(key).is_some_and(|entry| entry.job.set_progress(progress)) {
            self.propagate_progress(key);
        }
    }
}
