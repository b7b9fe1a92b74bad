//! The subtasks of one job: which are to be submitted, which are open, and their progress.

use std::collections::{HashMap, HashSet, VecDeque};

use crate::job::{Failure, Submission, clamp_cost};
use crate::job_id::JobId;

/// Fraction of a parent's progress and cost that belongs to its merge.
pub(crate) const MERGE_FRACTION: f64 = 0.05;

/// Most subtasks of one job that are queued or running.
const MAX_OPEN: usize = 256;

pub(crate) struct Subtasks {
    pending: VecDeque<Submission>,
    /// Subtasks that are queued or running.
    open: HashMap<JobId, Open>,
    /// Cost of the work that is done.
    done: f64,
    /// Cost of all subtasks.
    total: f64,
}

struct Open {
    cost: f64,
    progress: f64,
}

impl Subtasks {
    /// The subtasks of a job. Equal ones become one, and costs are clamped. A job must not be its own subtask.
    pub(crate) fn new(parent: JobId, subtasks: Vec<Submission>) -> Result<Self, Failure> {
        if subtasks.iter().any(|subtask| subtask.id == parent) {
            return Err(Failure::Panicked("the job is a subtask of itself".to_owned()));
        }
        let mut seen = HashSet::new();
        let distinct = subtasks.into_iter().filter(|subtask| seen.insert(subtask.id));
        let clamped = distinct.map(|subtask| Submission { cost: clamp_cost(subtask.cost), ..subtask });
        let pending: VecDeque<_> = clamped.collect();
        let total = pending.iter().map(|subtask| subtask.cost).sum();
        Ok(Self { pending, open: HashMap::new(), done: 0.0, total })
    }

    /// The next subtask that may be submitted now.
    pub(crate) fn next(&self) -> Option<&Submission> {
        self.pending.front().filter(|_| self.open.len() < MAX_OPEN)
    }

    /// The next subtask, which becomes open.
    pub(crate) fn open_next(&mut self) -> Option<Submission> {
        let subtask = self.next()?.clone();
        self.pending.pop_front();
        self.open.insert(subtask.id, Open { cost: subtask.cost, progress: 0.0 });
        Some(subtask)
    }

    /// Records the progress of an open subtask. Returns the parent's progress.
    pub(crate) fn set_progress(&mut self, subtask: JobId, progress: f64) -> f64 {
        if let Some(open) = self.open.get_mut(&subtask).filter(|open| open.progress < progress) {
            self.done += open.cost * (progress - open.progress);
            open.progress = progress;
        }
        (1.0 - MERGE_FRACTION) * self.done / self.total
    }

    /// An open subtask has succeeded. Returns the parent's progress.
    pub(crate) fn succeeded(&mut self, subtask: JobId) -> f64 {
        let progress = self.set_progress(subtask, 1.0);
        self.open.remove(&subtask);
        progress
    }

    /// An open subtask was lost and is to be submitted again.
    pub(crate) fn lost(&mut self, subtask: Submission) {
        if let Some(open) = self.open.remove(&subtask.id) {
            self.done -= open.cost * open.progress;
        }
        self.pending.push_front(subtask);
    }

    pub(crate) fn has_pending(&self) -> bool {
        !self.pending.is_empty()
    }

    /// Whether all subtasks have succeeded.
    pub(crate) fn are_finished(&self) -> bool {
        self.pending.is_empty() && self.open.is_empty()
    }

    pub(crate) fn into_open(self) -> impl Iterator<Item = JobId> {
        self.open.into_keys()
    }
}
