//! A caller's claim on a job.

use std::fmt;

use crate::job::Job;
use crate::job_watch::{JobReceiver, Watcher};

/// A caller's claim on a job.
///
/// If the last claim on a queued or running job is dropped and none was [detached](Claim::detach), the job is
/// cancelled. A claim may be dropped on any thread, inside or outside of a runtime.
pub struct Claim {
    job: JobReceiver,
    guard: Box<dyn ClaimGuard>,
}

/// A back end's side of a claim. Dropping it ends the claim.
pub(crate) trait ClaimGuard: Send + Sync {
    fn detach(&self);
}

impl Claim {
    pub(crate) fn new(job: JobReceiver, guard: Box<dyn ClaimGuard>) -> Self {
        Self { job, guard }
    }

    /// The job now.
    pub fn job(&self) -> Job {
        self.job.job()
    }

    /// Waits for the job's end and returns the job. If the back end closes before, returns the job's last state.
    pub async fn finished(&self) -> Job {
        self.job.finished().await
    }

    /// Watches the job.
    pub fn watch(&self) -> Watcher {
        Watcher::new(self.job.clone())
    }

    /// From now on the job continues even if all claims are dropped.
    pub fn detach(&self) {
        self.guard.detach();
    }
}

impl fmt::Debug for Claim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Claim").field(&self.job()).finish()
    }
}
