//! The claims of this process.

use std::collections::BTreeMap;

use parking_lot::Mutex;
use tokio::sync::{mpsc, oneshot};

use crate::job_id::JobKey;

/// A request to the task that records claims.
pub(super) enum ClaimChange {
    /// The claims on this job have changed.
    Changed(JobKey),
    /// Dropped when all earlier changes are recorded.
    Barrier(oneshot::Sender<()>),
}

/// The claims of this process. A task writes their changes into the records.
pub(super) struct Claims {
    by_job: Mutex<BTreeMap<JobKey, JobClaims>>,
    changes: mpsc::UnboundedSender<ClaimChange>,
}

/// The claims of this process on one job.
#[derive(Clone, Copy, Default)]
pub(super) struct JobClaims {
    pub(super) count: usize,
    pub(super) detached: bool,
}

impl Claims {
    pub(super) fn new(changes: mpsc::UnboundedSender<ClaimChange>) -> Self {
        Self { by_job: Mutex::default(), changes }
    }

    /// Adds a claim that is in the job's record already.
    pub(super) fn add(&self, key: JobKey) {
        self.by_job.lock().entry(key).or_default().count += 1;
    }

    /// Waits until all earlier changes are recorded, or were tried.
    pub(super) async fn recorded(&self) {
        let (sender, receiver) = oneshot::channel();
        if self.changes.send(ClaimChange::Barrier(sender)).is_ok() {
            drop(receiver.await);
        }
    }

    /// Detaches all jobs on which this process has claims.
    pub(super) fn detach_all(&self) {
        for (key, claims) in self.by_job.lock().iter_mut() {
            claims.detached = true;
            drop(self.changes.send(ClaimChange::Changed(*key)));
        }
    }

    /// Changes the claims on a job, and requests that the record is adapted.
    pub(super) fn change(&self, key: JobKey, change: impl FnOnce(&mut JobClaims)) {
        change(self.by_job.lock().entry(key).or_default());
        drop(self.changes.send(ClaimChange::Changed(key)));
    }

    pub(super) fn get(&self, key: JobKey) -> Option<JobClaims> {
        self.by_job.lock().get(&key).copied()
    }

    /// Removes the job if no claim is left.
    pub(super) fn remove_unclaimed(&self, key: JobKey) {
        let mut all = self.by_job.lock();
        if all.get(&key).is_some_and(|claims| claims.count == 0) {
            all.remove(&key);
        }
    }
}
