//! Runs jobs of a broker.

mod attempt;
mod completion;
mod delivery;
mod execution;
mod fairness_fetch;
mod fetch;
mod parent_job;
mod shared;
mod slots;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::time::Duration;

use parking_lot::Mutex;
use tokio::sync::watch;
use tokio::task::JoinSet;
use tokio::time::timeout;

use super::backend::JetStream;
use super::config::{ConnectError, WorkerConfig};
use crate::counts::Slots;
use crate::execution::slot::{self, SlotKind};
use crate::work::Work;
use shared::{Shared, Stage};
use slots::SlotPool;

/// Longest time to return jobs to the queue.
const CLOSE_TIMEOUT: Duration = Duration::from_secs(5);

/// Runs jobs in this process. If it is dropped without a [drain](Worker::drain), its jobs come to other workers after
/// [`ack_wait`](super::Config::ack_wait), as if the process had died.
#[must_use = "it stops when it is dropped"]
pub struct Worker {
    shared: Arc<Shared>,
    tasks: JoinSet<()>,
}

/// Load of a worker, and jobs that it has received or returned again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Occupancy {
    /// Slots of the worker.
    pub slots: Slots,
    /// Jobs that the broker had delivered before to a worker that was lost or did not answer.
    pub redelivered: u64,
    /// Jobs that this worker returned to the queue unfinished.
    pub handed_back: u64,
}

impl Worker {
    /// Starts to run queued jobs.
    ///
    /// # Errors
    ///
    /// [`ConnectError::Threads`] if threads cannot be started.
    pub fn start(
        backend: &JetStream,
        config: WorkerConfig,
        work: Arc<dyn Work>,
    ) -> Result<Self, ConnectError> {
        let slots = slot::slots(config.threads, config.slots, 0)
            .map_err(|error| ConnectError::Threads(error.to_string()))?;
        let shared = Arc::new(Shared {
            client: Arc::clone(&backend.client),
            work,
            preemption: Arc::default(),
            main_slots: slots.iter().filter(|slot| slot.kind == SlotKind::Main).count(),
            slots: SlotPool::new(slots),
            main_clients: Mutex::default(),
            moved_back: AtomicUsize::new(0),
            redelivered: AtomicU64::new(0),
            handed_back: AtomicU64::new(0),
            stage: watch::Sender::new(Stage::Open),
            active: watch::Sender::new(0),
        });
        let mut tasks = JoinSet::new();
        tasks.spawn(fetch::fetch_small(Arc::clone(&shared)));
        tasks.spawn(fetch::fetch_large(Arc::clone(&shared)));
        tasks.spawn(fairness_fetch::fetch_for_guests(Arc::clone(&shared)));
        Ok(Self { shared, tasks })
    }

    /// Returns a function that reports the load, also after the worker's end.
    pub fn occupancy(&self) -> impl Fn() -> Occupancy + Send + Sync + 'static {
        let shared = Arc::clone(&self.shared);
        move || Occupancy {
            slots: shared.slots.counts(),
            redelivered: shared.redelivered.load(Ordering::Relaxed),
            handed_back: shared.handed_back.load(Ordering::Relaxed),
        }
    }

    /// Takes no more jobs, tells the running ones to stop, and returns them to the queue. Returns when all are there,
    /// or shortly after `limit`.
    pub async fn drain(mut self, limit: Duration) {
        self.shared.stage.send_replace(Stage::Draining);
        let mut active = self.shared.active.subscribe();
        if timeout(limit, active.wait_for(|jobs| *jobs == 0)).await.is_err() {
            self.shared.stage.send_replace(Stage::Closing);
            drop(timeout(CLOSE_TIMEOUT, active.wait_for(|jobs| *jobs == 0)).await);
        }
        self.tasks.shutdown().await;
    }
}
