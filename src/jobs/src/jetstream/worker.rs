//! The half that runs jobs.

mod attempt;
mod delivery;
mod guest;
mod intake;
mod seats;
mod whole;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::time::Duration;

use parking_lot::Mutex;
use tokio::sync::watch;
use tokio::task::JoinSet;
use tokio::time::timeout;

use super::client::Client;
use super::{ConnectError, JetStream, WorkerConfig};
use crate::Work;
use crate::threads::pools::{self, Lane};
use crate::threads::turn::Turn;
use seats::Seats;

/// How long handing jobs back may take.
const CLOSING: Duration = Duration::from_secs(5);

/// Runs jobs in this process. Dropped without a [drain](Worker::drain) it is as if the process had died: its jobs come
/// to others after a while.
#[must_use = "it stops when it is dropped"]
pub struct Worker {
    desk: Arc<Desk>,
    tasks: JoinSet<()>,
}

/// What the tasks of a worker share.
struct Desk {
    client: Arc<Client>,
    work: Arc<dyn Work>,
    turn: Arc<Turn>,
    seats: Seats,
    /// The clients of the jobs on the main lane.
    held: Mutex<Vec<String>>,
    /// How many jobs of the main lane run at once.
    main: usize,
    /// Jobs that were put behind others since one was begun.
    passed: AtomicUsize,
    redelivered: AtomicU64,
    handed_back: AtomicU64,
    stage: watch::Sender<Stage>,
    active: watch::Sender<usize>,
}

/// How busy a worker is, and what has come to it twice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Occupancy {
    /// Where jobs run.
    pub seats: crate::Seats,
    /// Jobs that the broker had given to a worker before, which was lost or stopped answering.
    pub redelivered: u64,
    /// Jobs that this worker gave back to the queue unfinished.
    pub handed_back: u64,
}

/// How far a worker is in its own life.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Stage {
    Open,
    /// Takes no jobs, and has told its runs to stop.
    Draining,
    /// Does not wait for them any more.
    Closing,
}

impl Worker {
    /// Sets to work on what is queued.
    pub fn start(
        backend: &JetStream,
        config: WorkerConfig,
        work: Arc<dyn Work>,
    ) -> Result<Self, ConnectError> {
        let seats = pools::seats(config.threads, config.slots, 0)
            .map_err(|fault| ConnectError::Threads(fault.to_string()))?;
        let client = Arc::clone(&backend.client);
        let desk = Arc::new(Desk {
            work,
            turn: Arc::default(),
            client,
            held: Mutex::default(),
            main: seats.iter().filter(|seat| seat.lane == Lane::Main).count(),
            passed: AtomicUsize::new(0),
            seats: Seats::new(seats),
            redelivered: AtomicU64::new(0),
            handed_back: AtomicU64::new(0),
            stage: watch::Sender::new(Stage::Open),
            active: watch::Sender::new(0),
        });
        let mut tasks = JoinSet::new();
        tasks.spawn(intake::small(Arc::clone(&desk)));
        tasks.spawn(intake::main(Arc::clone(&desk)));
        tasks.spawn(guest::intake(Arc::clone(&desk)));
        Ok(Self { desk, tasks })
    }

    /// Tells how busy it is whenever it is asked, also after the worker's end.
    pub fn occupancy(&self) -> impl Fn() -> Occupancy + Send + Sync + 'static {
        let desk = Arc::clone(&self.desk);
        move || Occupancy {
            seats: crate::Seats { all: desk.seats.all(), busy: desk.seats.busy() },
            redelivered: desk.redelivered.load(Ordering::Relaxed),
            handed_back: desk.handed_back.load(Ordering::Relaxed),
        }
    }

    /// Takes no more jobs, tells those that run to stop and hands them back to the queue. Returns when all have been, at
    /// the latest shortly after `limit`.
    pub async fn drain(mut self, limit: Duration) {
        self.desk.stage.send_replace(Stage::Draining);
        let mut active = self.desk.active.subscribe();
        if timeout(limit, active.wait_for(|jobs| *jobs == 0)).await.is_err() {
            self.desk.stage.send_replace(Stage::Closing);
            drop(timeout(CLOSING, active.wait_for(|jobs| *jobs == 0)).await);
        }
        self.tasks.shutdown().await;
    }
}

/// One job of the worker's, counted.
struct Active(Arc<Desk>);

impl Active {
    fn new(desk: &Arc<Desk>) -> Self {
        desk.active.send_modify(|jobs| *jobs += 1);
        Self(Arc::clone(desk))
    }
}

impl Drop for Active {
    fn drop(&mut self) {
        self.0.active.send_modify(|jobs| *jobs -= 1);
    }
}

/// One job on the main lane.
struct Held {
    desk: Arc<Desk>,
    client: String,
}

impl Held {
    fn new(desk: &Arc<Desk>, client: String) -> Self {
        desk.held.lock().push(client.clone());
        Self { desk: Arc::clone(desk), client }
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        let mut held = self.desk.held.lock();
        if let Some(place) = held.iter().position(|client| *client == self.client) {
            held.swap_remove(place);
        }
    }
}

impl Desk {
    fn is_open(&self) -> bool {
        *self.stage.borrow() == Stage::Open
    }

    /// Returns when the worker has come so far.
    async fn reaches(&self, stage: Stage) {
        // The sender is this desk's.
        drop(self.stage.subscribe().wait_for(|now| *now >= stage).await);
    }
}
