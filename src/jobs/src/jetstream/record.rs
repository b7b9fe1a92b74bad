//! A job as the broker keeps it.

use std::collections::BTreeSet;
use std::time::SystemTime;

use bytes::Bytes;
use serde::{Deserialize, Serialize};

use super::bus::Line;
use crate::job::{finish, queued};
use crate::moment::now;
use crate::threads::run::{Outcome, Told};
use crate::{Job, JobId, State, Submission};

/// Of records and messages. It is in their names at the broker: processes of different layouts have each their own jobs
/// there, and what the ones write the others need not read.
pub(super) const LAYOUT: &str = "4";

/// Whose interest keeps a job alive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(super) enum Claimant {
    /// A process in which somebody waits.
    Process(u64),
    /// A life of a job of which it is a part.
    Whole(JobId, u64),
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Record {
    /// Grows with each submission that begins a life, and with time.
    pub(super) life: u64,
    /// How often this life was queued again.
    pub(super) turn: u32,
    pub(super) job: Job,
    pub(super) deadline: Option<SystemTime>,
    /// In which it waits.
    pub(super) line: Line,
    /// It has only been asked for as a part.
    pub(super) hidden: bool,
    pub(super) kept: bool,
    pub(super) claimants: BTreeSet<Claimant>,
    /// A running job is to stop.
    pub(super) told: Option<Told>,
    /// It waits for its parts, or merges them.
    pub(super) split: bool,
}

impl Record {
    pub(super) fn new(
        life: u64,
        submission: Submission,
        line: Line,
        claimant: Claimant,
        hidden: bool,
    ) -> Self {
        let as_part = matches!(claimant, Claimant::Whole(..));
        let deadline = submission.deadline.and_then(|limit| now().checked_add(limit));
        let mut job = queued(submission, as_part);
        job.progress = 0.0;
        let claimants = BTreeSet::from([claimant]);
        Self { life, turn: 0, job, deadline, line, hidden, kept: false, claimants, told: None, split: false }
    }

    pub(super) fn encode(&self) -> Option<Bytes> {
        postcard::to_stdvec(self).ok().map(Bytes::from)
    }

    /// `None`: it is damaged.
    pub(super) fn decode(bytes: &[u8]) -> Option<Self> {
        postcard::from_bytes(bytes).ok()
    }

    /// Whether a submission joins it; not what has ended, or has been told to.
    pub(super) fn goes_on(&self) -> bool {
        !self.job.state.is_final() && self.told.is_none()
    }

    pub(super) fn is_wanted(&self) -> bool {
        self.kept || !self.claimants.is_empty()
    }

    /// Takes a submission in; whether that changes it.
    pub(super) fn join(&mut self, submission: &Submission, claimant: Claimant, as_part: bool) -> bool {
        let mut changes = self.claimants.insert(claimant);
        if !as_part {
            changes |= self.job.clients.join(&submission.client);
        }
        if self.hidden && !as_part {
            self.hidden = false;
            changes = true;
        }
        let deadline = submission.deadline.and_then(|limit| now().checked_add(limit));
        if self.deadline.is_some() && deadline.is_none_or(|later| Some(later) > self.deadline) {
            self.deadline = deadline;
            changes = true;
        }
        changes
    }

    /// A client does not want it any more; whether that changes anything.
    pub(super) fn leave(&mut self, client: &str) -> bool {
        if !self.goes_on() || !self.job.clients.contains(client) {
            return false;
        }
        let is_last = self.job.clients.is_only(client);
        if is_last {
            self.kept = false;
            self.claimants.retain(|claimant| matches!(claimant, Claimant::Whole(..)));
        }
        if is_last && !self.is_wanted() {
            self.stop(Told::Cancelled);
        } else {
            self.job.clients.leave(client);
        }
        true
    }

    /// A queued job ends, a running one is told to.
    pub(super) fn stop(&mut self, told: Told) {
        match (self.job.state, told) {
            (State::Queued, Told::DeadlinePassed) => {
                self.end(Outcome::Failed(crate::Failure::DeadlinePassed));
            }
            (State::Queued, _) => self.end(Outcome::Cancelled),
            (State::Running, _) if self.told.is_none() => self.told = Some(told),
            _ => {}
        }
    }

    pub(super) fn end(&mut self, outcome: Outcome) {
        finish(&mut self.job, outcome);
        (self.told, self.split) = (None, false);
        self.claimants.clear();
    }

    /// As it was told to.
    pub(super) fn end_as(&mut self, told: Told) {
        self.end(match told {
            Told::DeadlinePassed => Outcome::Failed(crate::Failure::DeadlinePassed),
            Told::Cancelled | Told::Drained | Told::Overran => Outcome::Cancelled,
        });
    }

    pub(super) fn begin(&mut self) {
        self.job.state = State::Running;
        self.job.attempts = self.job.attempts.saturating_add(1);
        self.job.started = Some(now());
        self.split = false;
    }

    /// As if it had not been begun; only the attempts stay.
    pub(super) fn requeue(&mut self) {
        (self.job.state, self.job.progress, self.job.started) = (State::Queued, 0.0, None);
        self.turn = self.turn.saturating_add(1);
        self.split = false;
    }
}
