//! Counts of jobs and slots.

use crate::job::State;

/// Numbers of jobs, subtasks included.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Queued now.
    pub queued: usize,
    /// Running now, without jobs that wait for their subtasks.
    pub running: usize,
    /// Calls of [`Work::run`](crate::Work::run) since the back end was opened.
    pub started: u64,
    /// Jobs that have succeeded since the back end was opened.
    pub succeeded: u64,
    /// Jobs that have failed since the back end was opened.
    pub failed: u64,
    /// Jobs that were cancelled since the back end was opened.
    pub cancelled: u64,
}

impl Counts {
    /// Counts a job that has come to this state, if it is final.
    pub(crate) fn count_end(&mut self, state: State) {
        match state {
            State::Succeeded => self.succeeded += 1,
            State::Failed => self.failed += 1,
            State::Cancelled => self.cancelled += 1,
            State::Queued | State::Running => {}
        }
    }
}

/// Slots of this process, the express and the guest slot included. A slot runs one job at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Slots {
    /// Number of slots.
    pub total: usize,
    /// Slots in which a job runs.
    pub busy: usize,
}
