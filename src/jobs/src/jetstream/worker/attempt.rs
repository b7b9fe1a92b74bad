//! One attempt at a job.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use tokio::sync::watch;
use tokio::time::timeout;

use super::completion::conclude;
use super::delivery::Delivery;
use super::parent_job;
use super::shared::{ActiveJob, Shared, Stage};
use crate::error::UnavailableError;
use crate::execution::slot::Slot;
use crate::execution::stop::{RunEnd, StopSignal};
use crate::jetstream::progress_message;
use crate::jetstream::record::Record;
use crate::job_id::JobKey;
use crate::job_watch::JobSender;

/// Least time between two messages on a job's progress.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(100);

/// Starts a job, runs it and records its end.
pub(super) async fn attempt(active: ActiveJob, delivery: Delivery, slot: Slot) {
    let shared = &active.0;
    let record = match start(shared, &delivery).await {
        Ok(Some(record)) => record,
        Ok(None) => {
            shared.slots.give_back(slot);
            return delivery.acknowledge().await;
        }
        Err(error) => {
            tracing::warn!(%error, "a job is not started; the broker will deliver it again");
            return shared.slots.give_back(slot);
        }
    };
    if delivery.is_redelivered() {
        shared.redelivered.fetch_add(1, Ordering::Relaxed);
    }
    let ended = async {
        let end = run(shared, &record, slot).await;
        conclude(shared, &delivery, record.job.attempts, end).await;
    };
    tokio::select! {
        () = ended => {}
        () = delivery.hold(shared.client.nats.config.ack_wait) => {}
    }
}

/// Records the start of an attempt. `None` if the job has ended.
async fn start(shared: &Shared, delivery: &Delivery) -> Result<Option<Record>, UnavailableError> {
    let (client, id) = (&shared.client, delivery.id());
    let _shard = client.shard(id).await;
    client.refresh(id).await?;
    let started = client.change(id, |record| {
        let starts = delivery.ticket.is_for(record);
        match record.stop_signal {
            // The worker that was told to stop is gone.
            Some(signal) if starts => record.end(signal.outcome()),
            None if starts => record.start(),
            _ => {}
        }
        starts
    });
    let started = started.await?;
    if started.as_ref().is_some_and(|record| delivery.is_newer_than(record)) {
        return Err(UnavailableError::new("the job's record is older than its message"));
    }
    Ok(started.filter(|record| delivery.ticket.is_for(record)))
}

async fn run(shared: &Arc<Shared>, record: &Record, slot: Slot) -> RunEnd {
    let job = JobSender::new(record.job.clone());
    let Some(mut run_state) = shared.client.replica.run_state(record.job.id) else {
        shared.slots.give_back(slot);
        return RunEnd::Drained;
    };
    let stop = watch::Sender::new(None);
    let watch_record = async {
        let is_over = run_state.wait_for(|state| {
            (state.generation, state.attempts) != (record.generation, record.job.attempts)
                || state.stop_signal.is_some()
        });
        let signal = match is_over.await.map(|state| state.stop_signal) {
            // Another attempt has replaced this one: it stops as if it were cancelled.
            Ok(signal) => signal.unwrap_or(StopSignal::Cancelled),
            // The replica was cleared. Nobody has cancelled the job.
            Err(_) => StopSignal::Drained,
        };
        stop.send_replace(Some(signal));
        std::future::pending::<()>().await;
    };
    let watch_stage = async {
        shared.reaches(Stage::Draining).await;
        stop.send_if_modified(|signal| signal.is_none() && signal.replace(StopSignal::Drained).is_none());
        shared.reaches(Stage::Closing).await;
    };
    let work = async {
        let end = parent_job::run(shared, record, slot, &job, stop.subscribe()).await;
        if matches!(end, RunEnd::CannotRunHere(_)) {
            // Meanwhile this worker requests no jobs. Otherwise it might get the same job again and again, and others
            // never.
            let _pause = shared.slots.pause();
            let mut signal = stop.subscribe();
            let stopped = signal.wait_for(Option::is_some);
            drop(timeout(shared.client.nats.config.return_delay, stopped).await);
        }
        end
    };
    tokio::select! {
        end = work => end,
        () = watch_record => RunEnd::Drained,
        () = send_progress(shared, record.key(), &job) => RunEnd::Drained,
        () = watch_stage => RunEnd::Drained,
    }
}

async fn send_progress(shared: &Shared, key: JobKey, job: &JobSender) {
    let mut last = 0.0;
    loop {
        tokio::time::sleep(PROGRESS_INTERVAL).await;
        let fraction = job.job().progress;
        if fraction > last {
            last = fraction;
            let message = progress_message::encode(key.generation, fraction);
            shared.client.nats.broadcast(&format!("progress.{}", key.id), message).await;
        }
    }
}
