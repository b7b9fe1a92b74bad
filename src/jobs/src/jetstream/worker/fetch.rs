//! Fetches jobs from the broker.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use futures_util::future::BoxFuture;
use futures_util::stream::FuturesUnordered;
use futures_util::{FutureExt, StreamExt};
use tokio::task::JoinSet;
use tokio::time::sleep;

use super::attempt::attempt;
use super::completion::hand_back;
use super::delivery::{self, Delivery};
use super::shared::{ActiveJob, Shared, Stage};
use crate::error::UnavailableError;
use crate::execution::slot::Slot;
use crate::jetstream::queue_class::QueueClass;

/// Longest time of one request for a job.
const FETCH_TIMEOUT: Duration = Duration::from_secs(5);

/// Time after which a failed request is tried again.
const RETRY: Duration = Duration::from_millis(500);

/// Most jobs that a worker moves to the end of their queue before it starts one.
pub(super) const MAX_MOVED_BACK: usize = 64;

/// The answer to a request for a job of a queue.
type Answer = (QueueClass, Result<Option<Delivery>, UnavailableError>);

/// Fetches small jobs while they can have a slot.
pub(super) async fn fetch_small(shared: Arc<Shared>) {
    let mut jobs = JoinSet::new();
    while shared.is_open() {
        if shared.wait_for_slot(QueueClass::Small).await {
            let delivered = shared.next(QueueClass::Small).await;
            start(&shared, &mut jobs, (QueueClass::Small, delivered)).await;
        }
    }
    while jobs.join_next().await.is_some() {}
}

/// Fetches subtasks and large jobs in turn while they can have a slot. A job that a worker has without a slot is kept
/// from other workers. So the worker waits for more than one queue only if all were empty.
pub(super) async fn fetch_large(shared: Arc<Shared>) {
    let mut jobs = JoinSet::new();
    // Queues without a request, the next first.
    let mut queues = VecDeque::from([QueueClass::Subtask, QueueClass::Large]);
    let mut requests: FuturesUnordered<BoxFuture<'_, Answer>> = FuturesUnordered::new();
    while shared.is_open() {
        tokio::select! {
            Some(answer) = requests.next() => {
                queues.push_back(answer.0);
                start(&shared, &mut jobs, answer).await;
            }
            is_open = shared.wait_for_slot(QueueClass::Large), if !queues.is_empty() => {
                if !is_open {
                    break;
                }
                if let Some(answer) = fetch_without_waiting(&shared, &mut queues).await {
                    start(&shared, &mut jobs, answer).await;
                } else {
                    let shared = &shared;
                    let request = |class| async move { (class, shared.next(class).await) }.boxed();
                    requests.extend(queues.drain(..).map(request));
                }
            }
        }
    }
    while let Some(answer) = requests.next().await {
        start(&shared, &mut jobs, answer).await;
    }
    while jobs.join_next().await.is_some() {}
}

/// The answer of the first queue that has a job now. This queue is the last then.
async fn fetch_without_waiting(shared: &Shared, queues: &mut VecDeque<QueueClass>) -> Option<Answer> {
    for number in 0..queues.len() {
        let class = queues[number];
        let delivered = delivery::next(&shared.client, class, None).await;
        if !matches!(delivered, Ok(None)) {
            queues.remove(number);
            queues.push_back(class);
            return Some((class, delivered));
        }
    }
    None
}

/// Starts the job of an answer, or moves it to the end of its queue, or returns it.
async fn start(shared: &Arc<Shared>, jobs: &mut JoinSet<()>, (class, delivered): Answer) {
    while jobs.try_join_next().is_some() {}
    let delivery = match delivered {
        Ok(Some(delivery)) => delivery,
        Ok(None) => return,
        Err(error) => {
            tracing::warn!(%error, "no jobs arrive now");
            return sleep(RETRY).await;
        }
    };
    if shared.move_back(&delivery, class).await {
        return;
    }
    let active = ActiveJob::new(shared);
    match shared.slot_for(&delivery, class).await {
        Some(slot) => drop(jobs.spawn(attempt(active, delivery, slot))),
        None => hand_back(shared, delivery).await,
    }
}

impl Shared {
    /// Moves a job to the end of its queue if another client has a job there and fewer jobs running. Returns whether it
    /// did. The number of jobs that are moved before one is started is limited.
    async fn move_back(&self, delivery: &Delivery, class: QueueClass) -> bool {
        let moved = self.moved_back.load(Ordering::Relaxed) < MAX_MOVED_BACK
            && self.client.replica.lock().must_yield(delivery.id(), class)
            && delivery.move_back(&self.client).await;
        let count = if moved { self.moved_back.load(Ordering::Relaxed).saturating_add(1) } else { 0 };
        self.moved_back.store(count, Ordering::Relaxed);
        moved
    }

    /// Waits until a queued job could have a slot. Returns false if the worker takes no more jobs.
    async fn wait_for_slot(&self, class: QueueClass) -> bool {
        tokio::select! {
            () = self.slots.wait_for_slot(class) => self.is_open(),
            () = self.reaches(Stage::Draining) => false,
        }
    }

    /// Waits for the next job of a queue, until a time limit or the worker's end.
    async fn next(&self, class: QueueClass) -> Result<Option<Delivery>, UnavailableError> {
        tokio::select! {
            biased;
            delivered = delivery::next(&self.client, class, Some(FETCH_TIMEOUT)) => delivered,
            () = self.reaches(Stage::Draining) => Ok(None),
        }
    }

    /// A slot for a job that the worker has received; a job of another queue may have come before. `None` if the worker
    /// drains, or if there is no slot for so long that other workers should have the job.
    async fn slot_for(&self, delivery: &Delivery, class: QueueClass) -> Option<Slot> {
        if !self.is_open() {
            return None;
        }
        if let Some(slot) = self.slots.take(class) {
            return Some(slot);
        }
        let config = &self.client.nats.config;
        tokio::select! {
            slot = self.slots.take_first(class) => Some(slot),
            () = self.reaches(Stage::Draining) => None,
            () = delivery.hold(config.ack_wait) => None,
            () = sleep(config.return_delay), if class != QueueClass::Small => None,
        }
    }
}
