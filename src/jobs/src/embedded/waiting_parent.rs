//! A parent job that waits for its subtasks.

use super::queue::{DequeuedJob, Tag};
use crate::subtasks::Subtasks;

/// The scheduler's knowledge of a job's subtasks.
pub(super) enum SubtaskState {
    /// The job has not been asked for subtasks.
    Unknown,
    /// The job waits for its subtasks.
    Waiting(WaitingParent),
    /// All subtasks have succeeded; the job is to merge their results.
    Finished,
}

/// A parent job that waits for its subtasks.
pub(super) struct WaitingParent {
    pub(super) client: String,
    /// Length of the parent's payload.
    pub(super) bytes: usize,
    /// The parent is small, so small subtasks may run in the express slot: a client waits for them.
    is_small: bool,
    /// Start of the next subtask's share.
    next_start: Tag,
    pub(super) subtasks: Subtasks,
}

/// A subtask's share of its parent's place in the queue.
#[derive(Clone, Copy)]
pub(super) struct SubtaskShare {
    pub(super) start: Tag,
    pub(super) parent_is_small: bool,
}

impl WaitingParent {
    pub(super) fn new(subtasks: Subtasks, parent: &DequeuedJob) -> Self {
        let (client, bytes, is_small) = (parent.job.client.clone(), parent.job.bytes, parent.job.is_small);
        Self { client, bytes, is_small, next_start: parent.start(), subtasks }
    }

    /// The share of the next subtask, which has this cost.
    pub(super) fn next_share(&mut self, cost: f64) -> SubtaskShare {
        let start = self.next_start;
        self.next_start = start.plus(cost);
        SubtaskShare { start, parent_is_small: self.is_small }
    }
}
