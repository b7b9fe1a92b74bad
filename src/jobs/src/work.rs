//! The interface to the computations that jobs run.

use bytes::Bytes;

use crate::job::Submission;
use crate::job_id::JobId;

/// Computes what jobs ask for.
///
/// A run stores its result elsewhere under the job's id and returns nothing. A run must be idempotent: the same job is
/// run again after a crash, and rarely while an abandoned run of it is still ending.
pub trait Work: Send + Sync + 'static {
    /// The subtasks from whose results [`Work::run`] merges the job's result, or none if the job is computed directly.
    ///
    /// Called before [`Work::run`], on the same kind of thread. Must be cheap and return the same subtasks at each
    /// call.
    /// [`Submission::client`] of a subtask is ignored: it is the parent's client. A job must not have itself as a
    /// subtask, directly or through others.
    fn subtasks(&self, job: &JobId, payload: &[u8]) -> Result<Vec<Submission>, WorkError> {
        let _ = (job, payload);
        Ok(Vec::new())
    }

    /// Computes and stores the result. If the job has subtasks, all of them have succeeded.
    ///
    /// Called on a thread of a rayon pool that no other job uses at the same time; may use rayon inside.
    fn run(&self, job: &JobId, payload: &[u8], control: &dyn RunControl) -> Result<(), WorkError>;
}

/// A run ended without a result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WorkError {
    /// [`RunControl::cancelled`] was true.
    Cancelled,
    /// The same payload would fail again. The job fails with this reason.
    Failed(Bytes),
    /// This process cannot run the job, but another one may: for example, another version wrote the payload, or the
    /// store of results is not available. If other processes exist, the job returns to the queue for them. Otherwise,
    /// and after a hundred times, it fails with this reason.
    CannotRunHere(Bytes),
}

/// Connects a run with the queue.
pub trait RunControl: Sync {
    /// Reports the fraction of the work that is done, from 0 to 1. A value below an earlier one is ignored.
    fn progress(&self, fraction: f64);

    /// Whether the run must stop. Call it at least every 10 ms on each thread. It may block the thread for a while, in
    /// which a small job or another client's job runs.
    fn cancelled(&self) -> bool;
}
