//! The half that runs jobs.

mod attempt;
mod delivery;
mod whole;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::time::Duration;

use parking_lot::Mutex;
use tokio::sync::{Notify, watch};
use tokio::task::JoinSet;
use tokio::time::timeout;

use super::bus::Line;
use super::client::Client;
use super::{ConnectError, JetStream, WorkerConfig};
use crate::Work;
use crate::threads::pools::{Lane, Seat, seats};
use crate::threads::turn::Turn;
use delivery::Delivery;

/// How long one question for a job waits for an answer.
const WAIT: Duration = Duration::from_secs(5);

/// How soon the broker is asked again when it could not be.
const RETRY: Duration = Duration::from_millis(500);

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
    free: Mutex<Vec<Seat>>,
    /// Notified when a seat is free, or wanted less.
    freed: Notify,
    /// Who waits for a seat before all that is queued: merges, and jobs in hand; and who lets other workers go first.
    first: AtomicUsize,
    seats: usize,
    redelivered: AtomicU64,
    handed_back: AtomicU64,
    stage: watch::Sender<Stage>,
    active: watch::Sender<usize>,
}

/// How busy a worker is, and what has come to it twice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Occupancy {
    /// Places for jobs, the express lane's among them.
    pub seats: usize,
    /// Those in which a job runs.
    pub busy: usize,
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
        let seats = seats(config.threads, config.slots, 0)
            .map_err(|fault| ConnectError::Threads(fault.to_string()))?;
        let desk = Arc::new(Desk {
            client: Arc::clone(&backend.client),
            work,
            turn: Arc::default(),
            freed: Notify::new(),
            first: AtomicUsize::new(0),
            seats: seats.len(),
            free: Mutex::new(seats),
            redelivered: AtomicU64::new(0),
            handed_back: AtomicU64::new(0),
            stage: watch::Sender::new(Stage::Open),
            active: watch::Sender::new(0),
        });
        let mut tasks = JoinSet::new();
        for line in Line::ALL {
            tasks.spawn(serve(Arc::clone(&desk), line));
        }
        Ok(Self { desk, tasks })
    }

    /// Tells how busy it is whenever it is asked, also after the worker's end.
    pub fn occupancy(&self) -> impl Fn() -> Occupancy + Send + Sync + 'static {
        let desk = Arc::clone(&self.desk);
        move || Occupancy {
            seats: desk.seats,
            busy: desk.seats.saturating_sub(desk.free.lock().len()),
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

/// Takes jobs from a line while there is a seat for them.
async fn serve(desk: Arc<Desk>, line: Line) {
    let mut jobs = JoinSet::new();
    while desk.is_open() {
        desk.seat_is_free(line).await;
        let delivered = match desk.next(line).await {
            Ok(delivered) => delivered,
            Err(fault) => {
                tracing::warn!(%fault, "no jobs are heard of now");
                tokio::time::sleep(RETRY).await;
                None
            }
        };
        while jobs.try_join_next().is_some() {}
        let Some(delivery) = delivered else { continue };
        let active = Active::new(&desk);
        match desk.seat_for(&delivery, line).await {
            Some(seat) => drop(jobs.spawn(attempt::attempt(active, delivery, seat))),
            None => attempt::hand_back(&active.0, delivery).await,
        }
    }
    while jobs.join_next().await.is_some() {}
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

/// One that waits before all that is queued.
struct First<'a>(&'a Desk);

impl<'a> First<'a> {
    fn new(desk: &'a Desk) -> Self {
        desk.first.fetch_add(1, Ordering::AcqRel);
        Self(desk)
    }
}

impl Drop for First<'_> {
    fn drop(&mut self) {
        self.0.first.fetch_sub(1, Ordering::AcqRel);
        self.0.freed.notify_waiters();
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

    /// The next job of a line; `None`: none for a while, or no more.
    async fn next(&self, line: Line) -> Result<Option<Delivery>, crate::Unavailable> {
        tokio::select! {
            delivered = delivery::next(&self.client, line, WAIT) => delivered,
            () = self.reaches(Stage::Draining) => Ok(None),
        }
    }

    async fn seat_is_free(&self, line: Line) {
        loop {
            let freed = self.freed.notified();
            if !self.is_open() || self.position(line).is_some() {
                return;
            }
            tokio::select! {
                () = freed => {}
                () = self.reaches(Stage::Draining) => return,
            }
        }
    }

    fn position(&self, line: Line) -> Option<usize> {
        let free = self.free.lock();
        (self.first.load(Ordering::Acquire) == 0).then(|| place(&free, line)).flatten()
    }

    fn take_seat(&self, line: Line) -> Option<Seat> {
        let mut free = self.free.lock();
        let position = (self.first.load(Ordering::Acquire) == 0).then(|| place(&free, line)).flatten()?;
        Some(free.swap_remove(position))
    }

    /// For a job in hand, which the other line's may have come before; `None` when the worker drains.
    async fn seat_for(&self, delivery: &Delivery, line: Line) -> Option<Seat> {
        if !self.is_open() {
            return None;
        }
        if let Some(seat) = self.take_seat(line) {
            return Some(seat);
        }
        tokio::select! {
            seat = self.first_seat(line) => Some(seat),
            () = self.reaches(Stage::Draining) => None,
            () = delivery.in_hand(self.client.bus.config.ack_wait) => None,
        }
    }

    /// A seat before all that is queued.
    async fn first_seat(&self, line: Line) -> Seat {
        let _first = First::new(self);
        loop {
            let freed = self.freed.notified();
            {
                let mut free = self.free.lock();
                if let Some(position) = place(&free, line) {
                    return free.swap_remove(position);
                }
            }
            freed.await;
        }
    }

    fn give_seat(&self, seat: Seat) {
        self.free.lock().push(seat);
        self.freed.notify_waiters();
    }
}

/// Small jobs take any seat, the main lane's before the other; all else the main lane's.
fn place(free: &[Seat], line: Line) -> Option<usize> {
    let main = free.iter().position(|seat| seat.lane == Lane::Main);
    match line {
        Line::Parts | Line::Large => main,
        Line::Small => main.or_else(|| free.len().checked_sub(1)),
    }
}
