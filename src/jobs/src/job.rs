use std::time::{Duration, SystemTime};

use bytes::Bytes;
use serde::{Deserialize, Serialize};

use crate::moment::now;
use crate::threads::run::Outcome;
use crate::{Clients, JobId};

/// What is asked for: data, so that any process that knows the [`Work`](crate::Work) can do it.
#[derive(Clone, Debug)]
pub struct Submission {
    /// Hash of what it makes.
    pub id: JobId,
    /// Whose share of the cores the job is charged to.
    pub client: String,
    /// Estimated work in seconds of one core; taken between a millisecond and [`MAX_COST`].
    pub cost: f64,
    /// The question in the work's own terms. Kept as long as the job; bounding one payload is the caller's part,
    /// their sum in the queue is bounded here.
    pub payload: Bytes,
    /// After this long in the queue and running together the job fails with [`Failure::DeadlinePassed`]. It counts from the
    /// submission, and anew from a restart. Of equal submissions the latest deadline holds; `None` is the latest.
    pub deadline: Option<Duration>,
}

/// Greatest cost that is told apart, seconds of one core.
pub const MAX_COST: f64 = 1e6;

/// Where a job stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum State {
    /// Waits for its turn.
    Queued,
    /// Is computed, or its parts are.
    Running,
    /// Its result exists.
    Succeeded,
    /// There is no result, see [`Job::failure`].
    Failed,
    /// Nobody wanted it any more, or somebody said so.
    Cancelled,
}

impl State {
    /// In the order of a life.
    pub const ALL: [Self; 5] = [Self::Queued, Self::Running, Self::Succeeded, Self::Failed, Self::Cancelled];

    /// Whether nothing follows.
    pub const fn is_final(self) -> bool {
        matches!(self, Self::Succeeded | Self::Failed | Self::Cancelled)
    }

    /// Its lowercase name.
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
    /// The work's own reason, in its own terms.
    Work(Bytes),
    /// The work panicked with this message: a defect of the work.
    Panicked(String),
    /// See [`Submission::deadline`].
    DeadlinePassed,
    /// The process died in each of the allowed attempts, by this job or beside it.
    TooManyAttempts,
}

/// A job as it stood at one moment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Job {
    /// Hash of what it makes.
    pub id: JobId,
    /// To whom it was charged first.
    pub client: String,
    /// Who has submitted this life of it; nobody, as long as it has only been asked for as a part.
    pub clients: Clients,
    /// Seconds of one core, estimated.
    pub cost: f64,
    /// The question, in the work's own terms.
    pub payload: Bytes,
    /// Where it stands.
    pub state: State,
    /// Part of the work that is done, from 0 to 1; never falls while the job runs.
    pub progress: f64,
    /// When this life of it was submitted.
    pub created: SystemTime,
    /// When the last attempt was begun.
    pub started: Option<SystemTime>,
    /// When it ended.
    pub finished: Option<SystemTime>,
    /// How often it was begun.
    pub attempts: u32,
    /// There when the state is [`State::Failed`].
    pub failure: Option<Failure>,
}

/// As it enters the queue.
pub(crate) fn queued(submission: Submission, as_part: bool) -> Job {
    Job {
        id: submission.id,
        clients: if as_part { Clients::default() } else { Clients::of(&submission.client) },
        client: submission.client,
        cost: told_apart(submission.cost),
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

/// As it ends.
pub(crate) fn finish(job: &mut Job, outcome: Outcome) {
    job.finished = Some(now());
    match outcome {
        Outcome::Succeeded => (job.state, job.progress) = (State::Succeeded, 1.0),
        Outcome::Failed(failure) => (job.state, job.failure) = (State::Failed, Some(failure)),
        Outcome::Cancelled => job.state = State::Cancelled,
    }
}

/// A cost that sums well: what is not a number counts as the greatest.
pub(crate) fn told_apart(cost: f64) -> f64 {
    if cost.is_nan() { MAX_COST } else { cost.clamp(1e-3, MAX_COST) }
}
