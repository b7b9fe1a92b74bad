//! Jobs, their states and how they end.

use std::time::{Duration, SystemTime};

use bytes::Bytes;
use serde::{Deserialize, Serialize};

use crate::clients::Clients;
use crate::job_id::JobId;
use crate::timestamp::now;

/// A request for a job. It is data, so every process that has the same [`Work`](crate::Work) can run it.
#[derive(Clone, Debug)]
pub struct Submission {
    /// Hash of the result.
    pub id: JobId,
    /// The client for which the job counts in the fair queue.
    pub client: String,
    /// Estimated work in seconds of one core; values outside of a millisecond to [`MAX_COST`] are clamped.
    pub cost: f64,
    /// Input of the work, in its own format. It is stored as long as the job. The caller bounds one payload; the queue
    /// bounds their sum.
    pub payload: Bytes,
    /// Most time in the queue and running together, from the submission, and again from a restart. Then the job fails
    /// with
    /// [`Failure::DeadlinePassed`]. Of equal submissions the latest deadline applies; `None` is the latest.
    pub deadline: Option<Duration>,
}

/// Greatest cost of a job, seconds of one core.
pub const MAX_COST: f64 = 1e6;

/// State of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum State {
    /// The job waits in the queue.
    Queued,
    /// The job or its subtasks are being computed.
    Running,
    /// The result exists.
    Succeeded,
    /// There is no result; [`Job::failure`] states why.
    Failed,
    /// The job had no claims left, or somebody cancelled it.
    Cancelled,
}

impl State {
    /// All states, in the order in which a job may have them.
    pub const ALL: [Self; 5] = [Self::Queued, Self::Running, Self::Succeeded, Self::Failed, Self::Cancelled];

    /// Whether the job has ended.
    pub const fn is_final(self) -> bool {
        matches!(self, Self::Succeeded | Self::Failed | Self::Cancelled)
    }

    /// The name in lowercase letters.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Queued => "queued",
            Self::Running => "running",
            Self::Succeeded => "succeeded",
            Self::Failed => "failed",
            Self::Cancelled => "cancelled",
        }
    }
}

/// Why a job failed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Failure {
    /// The work failed with this reason, in its own format.
    Work(Bytes),
    /// The work panicked with this message: it has a defect.
    Panicked(String),
    /// [`Submission::deadline`] passed.
    DeadlinePassed,
    /// The process died in each of the allowed attempts, because of this job or of one beside it.
    TooManyAttempts,
}

/// A job at one time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Job {
    /// Hash of the result.
    pub id: JobId,
    /// The client whose submission started the job.
    pub client: String,
    /// Clients that have submitted this generation of the job; empty if it is only a subtask.
    pub clients: Clients,
    /// Estimated work, seconds of one core.
    pub cost: f64,
    /// Input of the work, in its own format.
    pub payload: Bytes,
    /// Present state.
    pub state: State,
    /// Fraction of the work that is done, from 0 to 1; never falls while the job runs.
    pub progress: f64,
    /// Time of the submission that started this generation.
    pub created: SystemTime,
    /// Start of the last attempt.
    pub started: Option<SystemTime>,
    /// End of the job.
    pub finished: Option<SystemTime>,
    /// Number of attempts.
    pub attempts: u32,
    /// Present if the state is [`State::Failed`].
    pub failure: Option<Failure>,
}

/// How a job ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    Succeeded,
    Failed(Failure),
    Cancelled,
}

impl Job {
    /// A job that enters the queue.
    pub(crate) fn new(submission: Submission, as_subtask: bool) -> Self {
        Self {
            id: submission.id,
            clients: if as_subtask { Clients::default() } else { Clients::of(&submission.client) },
            client: submission.client,
            cost: clamp_cost(submission.cost),
            payload: submission.payload,
            state: State::Queued,
            progress: 0.0,
            created: now(),
            started: None,
            finished: None,
            attempts: 0,
            failure: None,
        }
    }

    /// Starts an attempt.
    pub(crate) fn start(&mut self) {
        self.state = State::Running;
        self.attempts = self.attempts.saturating_add(1);
        self.started = Some(now());
    }

    /// Returns to the queue. Only the number of attempts stays.
    pub(crate) fn requeue(&mut self) {
        (self.state, self.progress, self.started) = (State::Queued, 0.0, None);
    }

    pub(crate) fn finish(&mut self, outcome: Outcome) {
        self.finished = Some(now());
        match outcome {
            Outcome::Succeeded => (self.state, self.progress) = (State::Succeeded, 1.0),
            Outcome::Failed(failure) => (self.state, self.failure) = (State::Failed, Some(failure)),
            Outcome::Cancelled => self.state = State::Cancelled,
        }
    }

    /// How the end of a subtask ends its parent; `None` if the parent continues.
    pub(crate) fn parent_outcome(&self) -> Option<Outcome> {
        match (self.state, &self.failure) {
            (State::Succeeded, _) => None,
            (State::Failed, Some(failure)) => Some(Outcome::Failed(failure.clone())),
            _ => Some(Outcome::Cancelled),
        }
    }
}

/// The cost of a job that has cost more than its estimate in the express slot. It is above that of small jobs, which
/// this slot runs: there the job would exceed its estimate again.
pub(crate) fn cost_after_overrun(estimate: f64, shown: f64, small: f64) -> f64 {
    clamp_cost(shown.max(estimate).max(small.next_up()))
}

/// A cost whose sums are finite. NaN becomes the greatest cost.
pub(crate) fn clamp_cost(cost: f64) -> f64 {
    if cost.is_nan() { MAX_COST } else { cost.clamp(1e-3, MAX_COST) }
}
