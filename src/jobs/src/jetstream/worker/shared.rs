//! The state that the tasks of a worker share.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize};

use parking_lot::Mutex;
use tokio::sync::watch;

use super::slots::SlotPool;
use crate::execution::preemption::Preemption;
use crate::jetstream::client::Client;
use crate::work::Work;

pub(super) struct Shared {
    pub(super) client: Arc<Client>,
    pub(super) work: Arc<dyn Work>,
    pub(super) preemption: Arc<Preemption>,
    pub(super) slots: SlotPool,
    /// Number of main slots.
    pub(super) main_slots: usize,
    /// Clients of the jobs in the main slots.
    pub(super) main_clients: Mutex<Vec<String>>,
    /// Jobs that were moved to the end of their queue since one was started.
    pub(super) moved_back: AtomicUsize,
    pub(super) redelivered: AtomicU64,
    pub(super) handed_back: AtomicU64,
    pub(super) stage: watch::Sender<Stage>,
    /// Jobs that this worker has.
    pub(super) active: watch::Sender<usize>,
}

/// How far the worker's own end is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Stage {
    Open,
    /// The worker takes no jobs, and has told its runs to stop.
    Draining,
    /// The worker does not wait for its runs any more.
    Closing,
}

impl Shared {
    pub(super) fn is_open(&self) -> bool {
        *self.stage.borrow() == Stage::Open
    }

    /// Waits until the worker has reached this stage.
    pub(super) async fn reaches(&self, stage: Stage) {
        // There is no error: the sender is in `self`.
        drop(self.stage.subscribe().wait_for(|now| *now >= stage).await);
    }
}

/// One of the worker's jobs; counted until it is dropped.
pub(super) struct ActiveJob(pub(super) Arc<Shared>);

impl ActiveJob {
    pub(super) fn new(shared: &Arc<Shared>) -> Self {
        shared.active.send_modify(|jobs| *jobs += 1);
        Self(Arc::clone(shared))
    }
}

impl Drop for ActiveJob {
    fn drop(&mut self) {
        self.0.active.send_modify(|jobs| *jobs -= 1);
    }
}
