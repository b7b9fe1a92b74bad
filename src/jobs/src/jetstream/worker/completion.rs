//! Records the end of an attempt, and returns jobs to the queue.

use std::sync::atomic::Ordering;
use std::time::Duration;

use super::delivery::Delivery;
use super::shared::Shared;
use crate::error::UnavailableError;
use crate::execution::stop::{RunEnd, StopSignal};
use crate::jetstream::config::Config;
use crate::jetstream::record::Record;
use crate::job::{Failure, Outcome, State, cost_after_overrun};

/// Time after which a failed write is tried again.
const RETRY: Duration = Duration::from_secs(1);

/// A job that no worker could run in so many attempts fails.
const MAX_REQUEUES: u32 = 100;

/// Records the end of an attempt, however long that takes, and acknowledges its message.
pub(super) async fn conclude(shared: &Shared, delivery: &Delivery, attempt: u32, end: RunEnd) {
    loop {
        match record_end(shared, delivery, attempt, &end).await {
            Ok(true) => return delivery.acknowledge().await,
            Ok(false) => return,
            Err(error) => {
                tracing::warn!(%error, "the end of a job is not recorded yet");
                tokio::time::sleep(RETRY).await;
            }
        }
    }
}

/// Records the end of an attempt. Returns false if another worker has the same message.
async fn record_end(
    shared: &Shared,
    delivery: &Delivery,
    attempt: u32,
    end: &RunEnd,
) -> Result<bool, UnavailableError> {
    let (client, id) = (&shared.client, delivery.id());
    let _shard = client.shard(id).await;
    let progress = client.replica.job(id).map_or(0.0, |job| job.progress);
    let ended = client.change(id, |record| {
        let ends = delivery.ticket.is_for(record) && record.job.attempts == attempt;
        if ends {
            record.job.progress = progress;
            apply_end(record, end, &client.nats.config);
        }
        ends
    });
    let Some(record) = ended.await? else {
        return Ok(true);
    };
    if delivery.ticket.is_for(&record) {
        return Ok(false);
    }
    if record.key() == delivery.ticket.key && record.job.state == State::Queued {
        // Queued again before this message is acknowledged.
        shared.handed_back.fetch_add(1, Ordering::Relaxed);
        client.nats.publish(&record).await?;
    }
    Ok(true)
}

/// Ends a job, or requeues it, as its run has ended.
fn apply_end(record: &mut Record, end: &RunEnd, config: &Config) {
    let may_requeue = record.stop_signal.is_none() && record.is_wanted();
    match end {
        RunEnd::Final(outcome) => record.end(outcome.clone()),
        RunEnd::CannotRunHere(reason) if record.requeues >= MAX_REQUEUES => {
            record.end(Outcome::Failed(Failure::Work(reason.clone())));
        }
        RunEnd::Overran(cost) if may_requeue => {
            record.job.cost = cost_after_overrun(record.job.cost, *cost, config.small_cost);
            record.class = config.class(record.job.cost);
            record.requeue();
        }
        RunEnd::Drained | RunEnd::CannotRunHere(_) if may_requeue => record.requeue(),
        RunEnd::Drained | RunEnd::CannotRunHere(_) | RunEnd::Overran(_) | RunEnd::Split(_) => {
            record.end(record.stop_signal.unwrap_or(StopSignal::Cancelled).outcome());
        }
    }
}

/// Returns a job that was not started to its queue.
pub(super) async fn hand_back(shared: &Shared, delivery: Delivery) {
    match shared.client.refresh(delivery.id()).await {
        Ok(Some((record, _))) => conclude(shared, &delivery, record.job.attempts, RunEnd::Drained).await,
        Ok(None) => delivery.acknowledge().await,
        Err(error) => {
            tracing::warn!(%error, "a job is not returned to its queue; the broker will deliver it again");
        }
    }
}
