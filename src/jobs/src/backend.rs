//! The interface of all back ends.

use std::time::Duration;

use async_trait::async_trait;

use crate::claim::Claim;
use crate::counts::Counts;
use crate::error::{SubmitError, UnavailableError};
use crate::job::{Job, Submission};
use crate::job_id::JobId;
use crate::job_watch::Watcher;
use crate::page::{Filter, Page};

/// Records jobs and runs them.
#[async_trait]
pub trait Backend: Send + Sync {
    /// Submits a job. The job is durable when this returns. If an equal job is queued or running, the submission joins
    /// it. If it has ended, it starts again; so a caller that stores results looks for the result first.
    async fn submit(&self, submission: Submission) -> Result<Claim, SubmitError>;

    /// A job, or `None` if it is unknown or forgotten.
    async fn get(&self, id: JobId) -> Result<Option<Job>, UnavailableError>;

    /// Lists jobs, the newest first, without jobs that are only [subtasks](crate::Work::subtasks) of others.
    async fn list(&self, filter: Filter) -> Result<Page, UnavailableError>;

    /// Watches a job. A watcher is no claim: it does not prevent that the job is cancelled.
    async fn watch(&self, id: JobId) -> Result<Option<Watcher>, UnavailableError>;

    /// Cancels a job, whatever claims exist, and returns it. A running job stops first and is [`State::Cancelled`]
    /// then; a job that has ended does not change.
    ///
    /// [`State::Cancelled`]: crate::State::Cancelled
    async fn cancel(&self, id: JobId) -> Result<Option<Job>, UnavailableError>;

    /// Removes one of the job's [clients](Job::clients) and returns the job. If it was the last client, the job is
    /// cancelled and still names it, unless another job needs it as a subtask. Nothing changes if the job has ended or
    /// the client is not one of the job's.
    async fn leave(&self, id: JobId, client: &str) -> Result<Option<Job>, UnavailableError>;

    /// Checks that records can be written: by what is known already, or by a request that costs little.
    async fn reachable(&self) -> Result<(), UnavailableError>;

    /// Whether other processes have the same jobs.
    fn is_shared(&self) -> bool;

    /// Counts of jobs since this back end was opened.
    fn counts(&self) -> Counts;

    /// Closes the back end. It accepts and starts no more jobs and stops the running ones; these return to the queue,
    /// for the next process that opens the back end. Returns when all have stopped, or shortly after `limit`. Callers
    /// that wait for a job that has not ended then receive its last state.
    async fn drain(&self, limit: Duration);
}
