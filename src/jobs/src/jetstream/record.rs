//! A job's record at the broker.

use std::collections::BTreeSet;
use std::time::SystemTime;

use bytes::Bytes;
use serde::{Deserialize, Serialize};

use super::queue_class::QueueClass;
use crate::execution::stop::StopSignal;
use crate::job::{Job, Outcome, State, Submission};
use crate::job_id::JobKey;
use crate::timestamp::now;

/// Version of the layout of records and messages. It is in their names at the broker, so processes with different
/// layouts have separate jobs and need not read each other's records.
pub(super) const LAYOUT: &str = "4";

/// Keeps a job from being cancelled. The order of the variants must not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) enum Claimant {
    /// A process with claims on the job.
    Process(u64),
    /// A job whose subtask it is.
    Parent(JobKey),
}

/// A job's record. Its encoding depends on the order of the fields.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Record {
    /// Grows with every submission that starts a generation, and with time.
    pub(super) generation: u64,
    /// How often this generation returned to the queue.
    pub(super) requeues: u32,
    pub(super) job: Job,
    pub(super) deadline: Option<SystemTime>,
    pub(super) class: QueueClass,
    /// No client has submitted the job.
    pub(super) is_only_subtask: bool,
    /// The job continues without claims.
    pub(super) is_detached: bool,
    pub(super) claimants: BTreeSet<Claimant>,
    /// The running job must stop.
    pub(super) stop_signal: Option<StopSignal>,
    /// The job waits for its subtasks, or merges their results.
    pub(super) is_waiting: bool,
}

impl Record {
    pub(super) fn new(
        generation: u64,
        submission: Submission,
        class: QueueClass,
        claimant: Claimant,
        is_only_subtask: bool,
    ) -> Self {
        let as_subtask = matches!(claimant, Claimant::Parent(_));
        Self {
            generation,
            requeues: 0,
            deadline: deadline(&submission),
            job: Job::new(submission, as_subtask),
            class,
            is_only_subtask,
            is_detached: false,
            claimants: BTreeSet::from([claimant]),
            stop_signal: None,
            is_waiting: false,
        }
    }

    pub(super) fn encode(&self) -> Option<Bytes> {
        postcard::to_stdvec(self).ok().map(Bytes::from)
    }

    /// `None` if the record is damaged.
    pub(super) fn decode(bytes: &[u8]) -> Option<Self> {
        postcard::from_bytes(bytes).ok()
    }

    pub(super) fn key(&self) -> JobKey {
        JobKey { id: self.job.id, generation: self.generation }
    }

    /// Whether a submission can join the job: it has not ended and was not told to stop.
    pub(super) fn is_active(&self) -> bool {
        !self.job.state.is_final() && self.stop_signal.is_none()
    }

    pub(super) fn is_wanted(&self) -> bool {
        self.is_detached || !self.claimants.is_empty()
    }

    /// An equal submission joins the job. Returns whether the record changes.
    pub(super) fn join(&mut self, submission: &Submission, claimant: Claimant) -> bool {
        let mut changes = self.claimants.insert(claimant);
        if matches!(claimant, Claimant::Process(_)) {
            changes |= self.job.clients.add(&submission.client);
            changes |= std::mem::take(&mut self.is_only_subtask);
        }
        let deadline = deadline(submission);
        if self.deadline.is_some() && deadline.is_none_or(|later| Some(later) > self.deadline) {
            self.deadline = deadline;
            changes = true;
        }
        changes
    }

    /// Removes a client. Returns whether the record changes.
    pub(super) fn leave(&mut self, client: &str) -> bool {
        if !self.is_active() || !self.job.clients.contains(client) {
            return false;
        }
        let is_last = self.job.clients.is_only(client);
        if is_last {
            self.is_detached = false;
            self.claimants.retain(|claimant| matches!(claimant, Claimant::Parent(_)));
        }
        if is_last && !self.is_wanted() {
            self.stop(StopSignal::Cancelled);
        } else {
            self.job.clients.remove(client);
        }
        true
    }

    /// Ends a queued job, or tells a running one to stop.
    pub(super) fn stop(&mut self, signal: StopSignal) {
        match self.job.state {
            State::Queued => self.end(signal.outcome()),
            State::Running => self.stop_signal = self.stop_signal.or(Some(signal)),
            State::Succeeded | State::Failed | State::Cancelled => {}
        }
    }

    pub(super) fn end(&mut self, outcome: Outcome) {
        self.job.finish(outcome);
        (self.stop_signal, self.is_waiting) = (None, false);
        self.claimants.clear();
    }

    pub(super) fn start(&mut self) {
        self.job.start();
        self.is_waiting = false;
    }

    pub(super) fn requeue(&mut self) {
        self.job.requeue();
        self.requeues = self.requeues.saturating_add(1);
        self.is_waiting = false;
    }
}

fn deadline(submission: &Submission) -> Option<SystemTime> {
    submission.deadline.and_then(|limit| now().checked_add(limit))
}
