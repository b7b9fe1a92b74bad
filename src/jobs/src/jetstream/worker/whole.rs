//! A job with its parts, if it has any.

use std::collections::HashSet;
use std::sync::Arc;
use std::time::Duration;

use futures_util::StreamExt;
use futures_util::stream::FuturesUnordered;
use tokio::sync::watch;

use super::Desk;
use super::attempt::{Call, call};
use crate::feed::{Feed, Feeder};
use crate::jetstream::bus::Line;
use crate::jetstream::record::{Claimant, Record};
use crate::job::told_apart;
use crate::threads::pools::Seat;
use crate::threads::run::{End, MERGE, Outcome, Told};
use crate::{Failure, Job, State, Submission, SubmitError};

/// Most parts of one job that are queued or run.
const AT_ONCE: usize = 256;

/// How often progress is looked at, and room for parts.
const LOOK: Duration = Duration::from_millis(100);

pub(super) async fn run(
    desk: &Arc<Desk>,
    record: &Record,
    seat: Seat,
    feeder: &Feeder,
    mut told: watch::Receiver<Option<Told>>,
) -> End {
    let parts = match call(desk, record, seat, feeder, told.clone(), Call::Begin).await {
        End::Split(parts) => parts,
        end => return end,
    };
    let waited = tokio::select! {
        waited = wait(desk, record, parts, feeder) => waited,
        told = told.wait_for(Option::is_some) => {
            return told.ok().and_then(|told| *told).map_or(End::Drained, Into::into);
        }
    };
    if let Err(outcome) = waited {
        return End::Final(outcome);
    }
    let config = &desk.client.bus.config;
    let seat = desk.seats.first(config.line(MERGE * record.job.cost)).await;
    call(desk, record, seat, feeder, told, Call::Merge).await
}

/// Submits the parts and returns when all have succeeded.
async fn wait(desk: &Desk, record: &Record, parts: Vec<Submission>, feeder: &Feeder) -> Result<(), Outcome> {
    let id = record.job.id;
    if parts.iter().any(|part| part.id == id) {
        return Err(Outcome::Failed(Failure::Panicked("the job is a part of itself".to_owned())));
    }
    mark(desk, record).await;
    let mut seen = HashSet::new();
    let mut pending: Vec<_> = parts.into_iter().filter(|part| seen.insert(part.id)).collect();
    pending.reverse();
    let total: f64 = pending.iter().map(|part| told_apart(part.cost)).sum();
    let mut done = 0.0;
    let mut open: Vec<(f64, Feed)> = Vec::new();
    let mut ends = FuturesUnordered::new();
    loop {
        while ends.len() < AT_ONCE
            && let Some(part) = pending.last()
            && let Some(feed) = submit(desk, record, part).await?
        {
            let cost = told_apart(part.cost);
            let finished = feed.clone();
            let part = part.clone();
            ends.push(async move { (part, finished.finished().await) });
            open.push((cost, feed));
            pending.pop();
        }
        if pending.is_empty() && ends.is_empty() {
            return Ok(());
        }
        tokio::select! {
            Some((part, end)) = ends.next() => {
                open.retain(|(_, feed)| feed.job().id != part.id);
                if end.state.is_final() {
                    succeeded(&end)?;
                    done += told_apart(part.cost);
                } else {
                    // The mirror has begun anew.
                    pending.push(part);
                }
            }
            () = tokio::time::sleep(LOOK) => {}
        }
        let under_way: f64 = open.iter().map(|(cost, feed)| cost * feed.job().progress).sum();
        feeder.progress((1.0 - MERGE) * (done + under_way) / total);
    }
}

fn succeeded(part: &Job) -> Result<(), Outcome> {
    match (part.state, &part.failure) {
        (State::Succeeded, _) => Ok(()),
        (State::Failed, Some(failure)) => Err(Outcome::Failed(failure.clone())),
        (state, _) => {
            tracing::info!(part = %part.id, ?state, "a part was cancelled, and its whole with it");
            Err(Outcome::Cancelled)
        }
    }
}

/// It counts as one that waits in the queue.
async fn mark(desk: &Desk, record: &Record) {
    let id = record.job.id;
    let _shard = desk.client.shard(id).await;
    let (life, attempts) = (record.life, record.job.attempts);
    let marked = desk.client.change(id, |record| {
        let ours = (record.life, record.job.attempts) == (life, attempts) && record.goes_on();
        record.split |= ours;
        ours
    });
    if let Err(fault) = marked.await {
        tracing::debug!(%fault, "a job that waits for its parts is not known to");
    }
}

/// `None`: there is no room now, or no broker.
async fn submit(desk: &Desk, record: &Record, part: &Submission) -> Result<Option<Feed>, Outcome> {
    let client = &desk.client;
    let _shard = client.shard(part.id).await;
    if let Some((known, _)) = client.mirror.read(part.id)
        && known.job.failure == Some(Failure::TooManyAttempts)
        && known.job.finished >= Some(record.job.created)
    {
        // Begun anew with each attempt at the whole it would bring down worker after worker.
        return Err(Outcome::Failed(Failure::TooManyAttempts));
    }
    let part = Submission { client: record.job.client.clone(), ..part.clone() };
    // Those of a small whole are small: somebody waits for it.
    let line = if record.line == Line::Small { client.bus.config.line(part.cost) } else { Line::Parts };
    match client.submit(&part, Claimant::Whole(record.job.id, record.life), line).await {
        Ok(begun) => Ok(client.mirror.feed(part.id, begun.life)),
        Err(SubmitError::Full { .. }) => Ok(None),
        Err(fault) => {
            tracing::warn!(%fault, "a part is not submitted yet");
            Ok(None)
        }
    }
}
