//! One attempt at a job.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use bytes::Bytes;
use tokio::sync::{oneshot, watch};
use tokio::time::timeout;

use super::delivery::Delivery;
use super::{Active, Desk, Held, Stage, whole};
use crate::feed::Feeder;
use crate::jetstream::listen::write_progress;
use crate::jetstream::record::Record;
use crate::job::told_apart;
use crate::threads::pools::{Lane, Seat};
use crate::threads::run::{End, Outcome, Run, Told};
use crate::{Failure, JobId, State, Unavailable};

/// Least time between two tellings of how far a job is.
const PACE: Duration = Duration::from_millis(100);

/// How soon an end that could not be recorded is tried again.
const RETRY: Duration = Duration::from_secs(1);

/// A job that was handed on so often and can still not be done is given up.
const MOST_TURNS: u32 = 100;

/// Takes a job over, runs it and records its end.
pub(super) async fn attempt(active: Active, delivery: Delivery, seat: Seat) {
    let desk = &active.0;
    let record = match begin(desk, &delivery).await {
        Ok(Some(record)) => record,
        Ok(None) => {
            desk.seats.give(seat);
            return delivery.done().await;
        }
        Err(fault) => {
            tracing::warn!(%fault, "a job is left to come again");
            return desk.seats.give(seat);
        }
    };
    if delivery.is_redelivered() {
        desk.redelivered.fetch_add(1, Ordering::Relaxed);
    }
    let ended = async {
        let end = carry_out(desk, &record, seat).await;
        conclude(desk, &delivery, record.job.attempts, end).await;
    };
    tokio::select! {
        () = ended => {}
        () = delivery.in_hand(desk.client.bus.config.ack_wait) => {}
    }
}

/// `None`: there is nothing to be done any more.
async fn begin(desk: &Desk, delivery: &Delivery) -> Result<Option<Record>, Unavailable> {
    let client = &desk.client;
    let id = delivery.id;
    let _shard = client.shard(id).await;
    client.refresh(id).await?;
    let begun = client.change(id, |record| {
        let begins = delivery.is_for(record);
        match record.told {
            // It was told to stop, and who ran it is gone.
            Some(told) if begins => record.end_as(told),
            None if begins => record.begin(),
            _ => {}
        }
        begins
    });
    let begun = begun.await?;
    if begun.as_ref().is_some_and(|record| delivery.is_ahead_of(record)) {
        return Err(Unavailable("its record is older than its message".to_owned()));
    }
    Ok(begun.filter(|record| delivery.is_for(record)))
}

async fn carry_out(desk: &Arc<Desk>, record: &Record, seat: Seat) -> End {
    let (id, life, attempt) = (record.job.id, record.life, record.job.attempts);
    let feeder = Feeder::new(record.job.clone());
    let Some(mut signal) = desk.client.mirror.signal(id) else {
        desk.seats.give(seat);
        return End::Drained;
    };
    let told = watch::Sender::new(None);
    let heard = async {
        let news =
            signal.wait_for(|(now, attempts, told)| (*now, *attempts) != (life, attempt) || told.is_some());
        let what = match news.await.map(|news| news.2) {
            // What is another's now is stopped as what was cancelled.
            Ok(told) => told.unwrap_or(Told::Cancelled),
            // The mirror has begun anew: nobody has said that it should end.
            Err(_) => Told::Drained,
        };
        told.send_replace(Some(what));
        std::future::pending::<()>().await;
    };
    let drained = async {
        desk.reaches(Stage::Draining).await;
        told.send_if_modified(|told| told.is_none() && told.replace(Told::Drained).is_none());
        desk.reaches(Stage::Closing).await;
    };
    let work = async {
        let end = whole::run(desk, record, seat, &feeder, told.subscribe()).await;
        if matches!(end, End::Elsewhere(_)) {
            // Others take it meanwhile: this worker asks for nothing, or it might come back again and again.
            let _aside = desk.seats.stand_aside();
            let mut told = told.subscribe();
            let stopped = told.wait_for(Option::is_some);
            drop(timeout(desk.client.bus.config.handing_on, stopped).await);
        }
        end
    };
    tokio::select! {
        end = work => end,
        () = heard => End::Drained,
        () = tell_progress(desk, id, life, &feeder) => End::Drained,
        () = drained => End::Drained,
    }
}

async fn tell_progress(desk: &Desk, id: JobId, life: u64, feeder: &Feeder) {
    let mut last = 0.0;
    loop {
        tokio::time::sleep(PACE).await;
        let part = feeder.job().progress;
        if part > last {
            last = part;
            desk.client.bus.tell(&format!("progress.{id}"), write_progress(life, part)).await;
        }
    }
}

/// What a seat is wanted for.
pub(super) enum Call {
    /// To ask for the job's parts, and to run it if there are none.
    Begin,
    Merge,
}

/// Has a call made on a seat's threads.
pub(super) async fn call(
    desk: &Arc<Desk>,
    record: &Record,
    seat: Seat,
    feeder: &Feeder,
    mut told: watch::Receiver<Option<Told>>,
    what: Call,
) -> End {
    let merges = matches!(what, Call::Merge);
    let job = (record.job.id, record.life);
    let (client, turn) = (record.job.client.clone(), Arc::clone(&desk.turn));
    let held = (seat.lane == Lane::Main).then(|| Held::new(desk, client.clone()));
    let run = Arc::new(Run::new(job, merges, client, seat.clone(), feeder.clone(), turn));
    let (sender, receiver) = oneshot::channel();
    let (on_seat, payload, guard) =
        (Arc::clone(&run), record.job.payload.clone(), Seated(Arc::clone(desk), seat));
    let work = Arc::clone(&desk.work);
    run.seat.pool.spawn(move || {
        let end = on_seat.made(work.as_ref(), &payload);
        drop((held, guard));
        drop(sender.send(end));
    });
    let telling = Telling(Arc::clone(&run));
    let heard = async {
        if let Ok(told) = told.wait_for(Option::is_some).await
            && let Some(told) = *told
        {
            run.tell(told);
        }
        std::future::pending::<()>().await;
    };
    let lost = || End::Final(Outcome::Failed(Failure::Panicked("no message".to_owned())));
    let end = tokio::select! {
        end = receiver => end.unwrap_or_else(|_| lost()),
        () = heard => lost(),
    };
    drop(telling);
    end
}

/// A run whose task is dropped has nobody to report to.
struct Telling(Arc<Run>);

impl Drop for Telling {
    fn drop(&mut self) {
        self.0.tell(Told::Drained);
    }
}

/// Gives the seat back when its threads are free.
struct Seated(Arc<Desk>, Seat);

impl Drop for Seated {
    fn drop(&mut self) {
        self.0.seats.give(self.1.clone());
    }
}

impl Run {
    /// Called on the seat's pool.
    fn made(&self, work: &dyn crate::Work, payload: &Bytes) -> End {
        if let Some(told) = self.told() {
            return told.into();
        }
        if !self.merges {
            match self.parts(work, payload) {
                Ok(parts) if parts.is_empty() => {}
                Ok(parts) => return End::Split(parts),
                Err(end) => return end,
            }
        }
        self.run(work, payload, &|| ())
    }
}

/// Records the end of an attempt, however long that takes, and is done with its message.
async fn conclude(desk: &Desk, delivery: &Delivery, attempt: u32, end: End) {
    loop {
        match record_end(desk, delivery, attempt, &end).await {
            Ok(Ended::Over) => return delivery.done().await,
            Ok(Ended::Replaced) => return,
            Err(fault) => {
                tracing::warn!(%fault, "the end of a job is not recorded yet");
                tokio::time::sleep(RETRY).await;
            }
        }
    }
}

/// What has become of a delivery's turn.
enum Ended {
    Over,
    /// Another has the same message in hand.
    Replaced,
}

async fn record_end(desk: &Desk, delivery: &Delivery, attempt: u32, end: &End) -> Result<Ended, Unavailable> {
    let client = &desk.client;
    let _shard = client.shard(delivery.id).await;
    let progress = client.mirror.job(delivery.id).map_or(0.0, |job| job.progress);
    let ended = client.change(delivery.id, |record| {
        let ends = delivery.is_for(record) && record.job.attempts == attempt;
        if ends {
            record.job.progress = progress;
            match end {
                End::Final(outcome) => record.end(outcome.clone()),
                End::Elsewhere(reason) if record.turn >= MOST_TURNS => {
                    record.end(Outcome::Failed(Failure::Work(reason.clone())));
                }
                End::Overran(cost) if record.told.is_none() && record.is_wanted() => {
                    record.job.cost = told_apart(cost.max(record.job.cost));
                    record.line = client.bus.config.line(record.job.cost);
                    record.requeue();
                }
                End::Drained | End::Elsewhere(_) if record.told.is_none() && record.is_wanted() => {
                    record.requeue();
                }
                End::Drained | End::Elsewhere(_) | End::Overran(_) | End::Split(_) => {
                    record.end_as(record.told.unwrap_or(Told::Cancelled));
                }
            }
        }
        ends
    });
    let Some(record) = ended.await? else {
        return Ok(Ended::Over);
    };
    if delivery.is_for(&record) {
        return Ok(Ended::Replaced);
    }
    if record.life == delivery.life && record.job.state == State::Queued {
        // Into the line again before this message is done with.
        desk.handed_back.fetch_add(1, Ordering::Relaxed);
        client.bus.publish(&record).await?;
    }
    Ok(Ended::Over)
}

/// Puts a job that was not begun back into its line.
pub(super) async fn hand_back(desk: &Desk, delivery: Delivery) {
    match desk.client.refresh(delivery.id).await {
        Ok(Some((record, _))) => conclude(desk, &delivery, record.job.attempts, End::Drained).await,
        Ok(None) => delivery.done().await,
        Err(fault) => tracing::warn!(%fault, "a job is left to come again"),
    }
}
