//! Which jobs a worker asks the broker for.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use futures_util::future::BoxFuture;
use futures_util::stream::FuturesUnordered;
use futures_util::{FutureExt, StreamExt};
use tokio::task::JoinSet;
use tokio::time::sleep;

use super::delivery::{self, Delivery};
use super::{Active, Desk, Stage, attempt};
use crate::Unavailable;
use crate::jetstream::bus::Line;
use crate::threads::pools::Seat;

/// How long one question for a job waits for an answer.
const WAIT: Duration = Duration::from_secs(5);

/// How soon the broker is asked again when it could not be.
const RETRY: Duration = Duration::from_millis(500);

/// Most jobs that a worker puts behind others before it begins one.
pub(super) const MOST_PASSED: usize = 64;

/// An answer to the question for a job of a line.
type Answer = (Line, Result<Option<Delivery>, Unavailable>);

/// Takes small jobs while there is a seat for them.
pub(super) async fn small(desk: Arc<Desk>) {
    let mut jobs = JoinSet::new();
    while desk.is_open() {
        if desk.free_for(Line::Small).await {
            let delivered = desk.next(Line::Small).await;
            take(&desk, &mut jobs, (Line::Small, delivered)).await;
        }
    }
    while jobs.join_next().await.is_some() {}
}

/// Takes parts and large jobs in turn while there is a seat for them. What is in hand without a seat is kept from other
/// workers, so no line is asked while another has an answer, but for lines that were all empty.
pub(super) async fn main(desk: Arc<Desk>) {
    let mut jobs = JoinSet::new();
    // Those without a question under way, the next to be asked first.
    let mut lines = VecDeque::from([Line::Parts, Line::Large]);
    let mut questions: FuturesUnordered<BoxFuture<'_, Answer>> = FuturesUnordered::new();
    while desk.is_open() {
        tokio::select! {
            Some(answer) = questions.next() => {
                lines.push_back(answer.0);
                take(&desk, &mut jobs, answer).await;
            }
            free = desk.free_for(Line::Large), if !lines.is_empty() => {
                if !free {
                    break;
                }
                if let Some(answer) = at_once(&desk, &mut lines).await {
                    take(&desk, &mut jobs, answer).await;
                } else {
                    let desk = &desk;
                    let question = |line| async move { (line, desk.next(line).await) }.boxed();
                    questions.extend(lines.drain(..).map(question));
                }
            }
        }
    }
    while let Some(answer) = questions.next().await {
        take(&desk, &mut jobs, answer).await;
    }
    while jobs.join_next().await.is_some() {}
}

/// The answer of the first line that has something now, which is asked last then.
async fn at_once(desk: &Desk, lines: &mut VecDeque<Line>) -> Option<Answer> {
    for number in 0..lines.len() {
        let line = lines[number];
        let delivered = delivery::next(&desk.client, line, None).await;
        if !matches!(delivered, Ok(None)) {
            lines.remove(number);
            lines.push_back(line);
            return Some((line, delivered));
        }
    }
    None
}

async fn take(desk: &Arc<Desk>, jobs: &mut JoinSet<()>, (line, delivered): Answer) {
    while jobs.try_join_next().is_some() {}
    let delivery = match delivered {
        Ok(Some(delivery)) => delivery,
        Ok(None) => return,
        Err(fault) => {
            tracing::warn!(%fault, "no jobs are heard of now");
            return sleep(RETRY).await;
        }
    };
    if desk.put_behind(&delivery, line).await {
        return;
    }
    let active = Active::new(desk);
    match desk.seat_for(&delivery, line).await {
        Some(seat) => drop(jobs.spawn(attempt::attempt(active, delivery, seat))),
        None => attempt::hand_back(&active.0, delivery).await,
    }
}

impl Desk {
    /// Puts a job behind those of its line if one of them is of a client that has fewer jobs running. Whether it did: not
    /// when as many jobs as are allowed have been put behind since one was begun.
    async fn put_behind(&self, delivery: &Delivery, line: Line) -> bool {
        let behind = self.passed.load(Ordering::Relaxed) < MOST_PASSED
            && self.client.mirror.lock().gives_way(delivery.id, line)
            && delivery.put_behind(&self.client).await;
        let passed = if behind { self.passed.load(Ordering::Relaxed).saturating_add(1) } else { 0 };
        self.passed.store(passed, Ordering::Relaxed);
        behind
    }

    /// Returns when a queued job of a line could have a seat; whether the worker still takes jobs.
    async fn free_for(&self, line: Line) -> bool {
        tokio::select! {
            () = self.seats.free_for(line) => self.is_open(),
            () = self.reaches(Stage::Draining) => false,
        }
    }

    /// The next job of a line; `None`: none for a while, or no more.
    async fn next(&self, line: Line) -> Result<Option<Delivery>, Unavailable> {
        tokio::select! {
            biased;
            delivered = delivery::next(&self.client, line, Some(WAIT)) => delivered,
            () = self.reaches(Stage::Draining) => Ok(None),
        }
    }

    /// For a job in hand, which one of another line may have come before; `None` when the worker drains, or when others
    /// should have it because there is no seat for so long.
    async fn seat_for(&self, delivery: &Delivery, line: Line) -> Option<Seat> {
        if !self.is_open() {
            return None;
        }
        if let Some(seat) = self.seats.take(line) {
            return Some(seat);
        }
        let config = &self.client.bus.config;
        tokio::select! {
            seat = self.seats.first(line) => Some(seat),
            () = self.reaches(Stage::Draining) => None,
            () = delivery.in_hand(config.ack_wait) => None,
            () = sleep(config.handing_on), if line != Line::Small => None,
        }
    }
}
