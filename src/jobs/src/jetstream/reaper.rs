//! Maintenance that any process does for all: it ends jobs without claims and late jobs, queues jobs that are missing
//! in their queue, and deletes old records.

use std::collections::HashSet;
use std::sync::Arc;
use std::time::Duration;

use futures_util::{StreamExt, stream};

use super::client::Client;
use super::heartbeat::Heartbeats;
use super::record::{Claimant, Record};
use super::replica::job_index::{JobIndex, Liveness};
use crate::error::UnavailableError;
use crate::execution::stop::StopSignal;
use crate::job::State;
use crate::job_id::JobId;
use crate::timestamp::now;

/// Time between two rounds.
const INTERVAL: Duration = Duration::from_millis(250);

/// Most records that are written at the same time.
const CONCURRENT: usize = 32;

pub(super) async fn run_maintenance(client: Arc<Client>) {
    let mut heartbeats = Heartbeats::new(client.process, client.nats.config.lease);
    let mut tick = tokio::time::interval(INTERVAL);
    tick.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Delay);
    let subject = format!("{}.alive", client.nats.config.name);
    let Ok(mut alive) = client.nats.client.subscribe(subject).await else {
        return;
    };
    loop {
        tokio::select! {
            _ = tick.tick() => run_round(&client, &mut heartbeats).await,
            () = client.replica.ended.notified() => release_claims(&client, |_| false).await,
            Some(message) = alive.next() => {
                if let Some(process) = message.payload.first_chunk() {
                    heartbeats.receive(u64::from_be_bytes(*process));
                }
            }
        }
    }
}

async fn run_round(client: &Client, heartbeats: &mut Heartbeats) {
    heartbeats.update(client.replica.lock().claimants());
    let is_late = |record: &Record| record.deadline.is_some_and(|deadline| deadline <= now());
    let late = client.replica.lock().active(is_late);
    for record in late {
        change(client, &record, |record| record.stop(StopSignal::DeadlinePassed)).await;
    }
    release_claims(client, |process| heartbeats.is_gone(process)).await;
    queue_missing(client).await;
    forget(client).await;
}

/// Ends the claims of processes that are gone and of parents that have ended.
async fn release_claims(client: &Client, is_gone: impl Fn(u64) -> bool) {
    let missing = missing_parents(client).await;
    let has_ended = |index: &JobIndex, claimant: &Claimant| match claimant {
        Claimant::Process(process) => is_gone(*process),
        Claimant::Parent(parent) => match index.liveness(*parent) {
            Liveness::Active => false,
            Liveness::Ended => true,
            Liveness::Unknown => missing.contains(&parent.id),
        },
    };
    let affected = {
        let index = client.replica.lock();
        index.active(|record| record.claimants.iter().any(|claimant| has_ended(&index, claimant)))
    };
    // Running jobs first: others wait for their cores.
    let (running, queued): (Vec<_>, Vec<_>) =
        affected.into_iter().partition(|record| record.job.state == State::Running);
    let released = stream::iter(running.into_iter().chain(queued)).map(|record| async move {
        change(client, &record, |record| {
            let index = client.replica.lock();
            record.claimants.retain(|claimant| !has_ended(&index, claimant));
            if !record.is_wanted() {
                tracing::debug!(job = %record.job.id, "all claimants are gone: cancelled");
                record.stop(StopSignal::Cancelled);
            }
        })
        .await;
    });
    released.buffer_unordered(CONCURRENT).collect::<()>().await;
}

/// Parents of active subtasks that the broker does not have.
async fn missing_parents(client: &Client) -> HashSet<JobId> {
    let unknown: HashSet<JobId> = {
        let index = client.replica.lock();
        let claimants = index.claimants().filter_map(|claimant| match claimant {
            Claimant::Parent(parent) => Some(*parent),
            Claimant::Process(_) => None,
        });
        claimants
            .filter(|parent| index.liveness(*parent) == Liveness::Unknown)
            .map(|parent| parent.id)
            .collect()
    };
    let mut missing = HashSet::new();
    for id in unknown {
        if matches!(client.refresh(id).await, Ok(None)) {
            missing.insert(id);
        }
    }
    missing
}

async fn change(client: &Client, record: &Record, change: impl Fn(&mut Record)) {
    if let Err(error) = client.change_active(record.key(), change).await {
        tracing::warn!(%error, "a job without claims, or a late one, is not ended yet");
    }
}

/// Queues jobs that are recorded and not in their queue: the process died between the two writes, or the broker has
/// lost the message.
async fn queue_missing(client: &Client) {
    let unseen = client.replica.lock().take_unseen(client.nats.config.requeue_after);
    for record in unseen {
        if matches!(client.nats.is_published(&record).await, Ok(false))
            && let Err(error) = queue_again(client, record.job.id).await
        {
            tracing::debug!(%error, "a job that is not in its queue is not queued yet");
        }
    }
}

/// Counts as a requeue: the broker would drop a message with the same count as a repetition.
async fn queue_again(client: &Client, id: JobId) -> Result<(), UnavailableError> {
    let _shard = client.shard(id).await;
    let Some((seen, _)) = client.refresh(id).await? else {
        return Ok(());
    };
    if seen.job.state.is_final() || client.nats.is_published(&seen).await? {
        return Ok(());
    }
    let queued = client.change(id, |record| {
        let is_lost = record.key() == seen.key() && record.requeues == seen.requeues && record.is_active();
        if is_lost {
            record.requeue();
        }
        is_lost
    });
    let is_requeued = |record: &Record| record.key() == seen.key() && record.requeues == seen.requeues + 1;
    if let Some(record) = queued.await?.filter(is_requeued) {
        tracing::warn!(job = %id, "a recorded job was not in its queue; it is queued now");
        client.nats.publish(&record).await?;
    }
    Ok(())
}

/// Each process deletes old records by the same rule, from its replica and at the broker.
async fn forget(client: &Client) {
    let forgotten = client.replica.lock().forget(client.nats.config.retention);
    let forgotten = stream::iter(forgotten).map(|(id, revision)| client.nats.forget(id, revision));
    forgotten.buffer_unordered(CONCURRENT).collect::<()>().await;
}
