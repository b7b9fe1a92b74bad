//! Errors of all back ends.

use std::fmt;
use std::time::Duration;

/// A submission was not accepted.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SubmitError {
    /// The queue is full.
    #[error("the queue is full; try again in {} s", retry_after.as_secs())]
    Full {
        /// Time after which the queue probably has room.
        retry_after: Duration,
    },
    /// The back end is closing.
    #[error("no more jobs are accepted: the queue is closing")]
    Draining,
    /// The job could not be recorded.
    #[error(transparent)]
    Unavailable(#[from] UnavailableError),
}

/// The records of jobs cannot be read or written now.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the records of jobs are not available: {0}")]
pub struct UnavailableError(pub String);

impl UnavailableError {
    /// Any other error, as text.
    pub(crate) fn new(reason: impl fmt::Display) -> Self {
        Self(reason.to_string())
    }

    /// The back end is closed.
    pub(crate) fn closed() -> Self {
        Self::new("closed")
    }
}
