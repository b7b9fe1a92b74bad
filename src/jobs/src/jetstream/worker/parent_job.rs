//! Runs a job with its subtasks, if it has any.

use std::sync::Arc;
use std::time::Duration;

use futures_util::StreamExt;
use futures_util::stream::FuturesUnordered;
use tokio::sync::watch;

use super::execution::{Phase, execute};
use super::shared::Shared;
use crate::error::SubmitError;
use crate::execution::slot::Slot;
use crate::execution::stop::{RunEnd, StopSignal};
use crate::jetstream::queue_class::QueueClass;
use crate::jetstream::record::{Claimant, Record};
use crate::job::{Failure, Outcome, Submission};
use crate::job_watch::{JobReceiver, JobSender};
use crate::subtasks::{MERGE_FRACTION, Subtasks};

/// Time between two looks at the subtasks' progress and at the room in the queue.
const INTERVAL: Duration = Duration::from_millis(100);

pub(super) async fn run(
    shared: &Arc<Shared>,
    record: &Record,
    slot: Slot,
    job: &JobSender,
    mut signal: watch::Receiver<Option<StopSignal>>,
) -> RunEnd {
    let submissions = match execute(shared, record, slot, job, signal.clone(), Phase::Start).await {
        RunEnd::Split(submissions) => submissions,
        end => return end,
    };
    let waited = tokio::select! {
        waited = run_subtasks(shared, record, submissions, job) => waited,
        signal = signal.wait_for(Option::is_some) => {
            return signal.ok().and_then(|signal| *signal).map_or(RunEnd::Drained, Into::into);
        }
    };
    if let Some(outcome) = waited {
        return RunEnd::Final(outcome);
    }
    let class = shared.client.nats.config.class(MERGE_FRACTION * record.job.cost);
    let slot = shared.slots.take_first(class).await;
    execute(shared, record, slot, job, signal, Phase::Merge).await
}

/// Submits the subtasks and waits until all have succeeded. Returns the parent's outcome if one has not.
async fn run_subtasks(
    shared: &Shared,
    record: &Record,
    submissions: Vec<Submission>,
    job: &JobSender,
) -> Option<Outcome> {
    let mut subtasks = match Subtasks::new(record.job.id, submissions) {
        Ok(subtasks) => subtasks,
        Err(failure) => return Some(Outcome::Failed(failure)),
    };
    record_waiting(shared, record).await;
    let mut open: Vec<JobReceiver> = Vec::new();
    let mut ends = FuturesUnordered::new();
    while !subtasks.are_finished() {
        while let Some(subtask) = subtasks.next() {
            let submitted = match submit(shared, record, subtask).await {
                Ok(submitted) => submitted,
                Err(outcome) => return Some(outcome),
            };
            let Some(receiver) = submitted else {
                break;
            };
            let Some(subtask) = subtasks.open_next() else {
                break;
            };
            open.push(receiver.clone());
            ends.push(async move { (subtask, receiver.finished().await) });
        }
        tokio::select! {
            Some((subtask, end)) = ends.next() => {
                open.retain(|receiver| receiver.job().id != subtask.id);
                if !end.state.is_final() {
                    // The replica was cleared.
                    subtasks.lost(subtask);
                } else if let Some(outcome) = end.parent_outcome() {
                    tracing::info!(job = %record.job.id, subtask = %subtask.id, "a subtask has ended its parent");
                    return Some(outcome);
                } else {
                    job.set_progress(subtasks.succeeded(subtask.id));
                }
            }
            () = tokio::time::sleep(INTERVAL) => {}
        }
        for subtask in open.iter().map(JobReceiver::job) {
            job.set_progress(subtasks.set_progress(subtask.id, subtask.progress));
        }
    }
    None
}

/// Records that the job waits, so it counts as one in the queue.
async fn record_waiting(shared: &Shared, record: &Record) {
    let attempts = record.job.attempts;
    let recorded = shared.client.change_active(record.key(), |record| {
        record.is_waiting |= record.job.attempts == attempts;
    });
    if let Err(error) = recorded.await {
        tracing::debug!(%error, "it is not recorded that a job waits for its subtasks");
    }
}

/// Submits a subtask. Returns `None` if the queue has no room now or the broker does not answer, and the parent's
/// outcome as an error if the subtask must not run.
async fn submit(
    shared: &Shared,
    parent: &Record,
    subtask: &Submission,
) -> Result<Option<JobReceiver>, Outcome> {
    let client = &shared.client;
    let _shard = client.shard(subtask.id).await;
    if let Some((known, _)) = client.replica.read(subtask.id)
        && known.job.failure == Some(Failure::TooManyAttempts)
        && known.job.finished >= Some(parent.job.created)
    {
        // Otherwise each attempt of the parent would start it, and it would kill worker after worker.
        return Err(Outcome::Failed(Failure::TooManyAttempts));
    }
    let subtask = Submission { client: parent.job.client.clone(), ..subtask.clone() };
    // Subtasks of a small job are small: a client waits for it.
    let is_small = parent.class == QueueClass::Small;
    let class = if is_small { client.nats.config.class(subtask.cost) } else { QueueClass::Subtask };
    match client.submit(&subtask, Claimant::Parent(parent.key()), class).await {
        Ok(record) => Ok(client.replica.subscribe_to(record.key())),
        Err(SubmitError::Full { .. }) => Ok(None),
        Err(error) => {
            tracing::warn!(%error, "a subtask is not submitted yet");
            Ok(None)
        }
    }
}
