//! Why a run was told to stop, and how it ended.

use bytes::Bytes;
use serde::{Deserialize, Serialize};

use crate::job::{Failure, Outcome, Submission};

/// Why a run was told to stop. The broker stores it: the order of the variants must not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum StopSignal {
    Cancelled,
    DeadlinePassed,
    /// The process closes; the job returns to the queue.
    Drained,
    /// The run occupied the express slot for too long.
    Overran,
}

impl StopSignal {
    /// How a job ends that was told to stop.
    pub(crate) fn outcome(self) -> Outcome {
        match self {
            Self::DeadlinePassed => Outcome::Failed(Failure::DeadlinePassed),
            Self::Cancelled | Self::Drained | Self::Overran => Outcome::Cancelled,
        }
    }
}

/// How a run ended.
#[derive(Clone, Debug)]
pub(crate) enum RunEnd {
    /// The job has ended.
    Final(Outcome),
    /// The job has these subtasks and is to merge their results.
    Split(Vec<Submission>),
    /// The job returns to the queue.
    Drained,
    /// The job returns to the queue with the cost that it has shown, seconds of one core.
    Overran(f64),
    /// Another process is to run the job. If none can, the job fails with this reason.
    CannotRunHere(Bytes),
}

impl From<StopSignal> for RunEnd {
    fn from(signal: StopSignal) -> Self {
        match signal {
            StopSignal::Cancelled | StopSignal::DeadlinePassed => Self::Final(signal.outcome()),
            // Only a run that has started knows how long it took.
            StopSignal::Drained | StopSignal::Overran => Self::Drained,
        }
    }
}
