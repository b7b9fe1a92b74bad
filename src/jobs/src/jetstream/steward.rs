//! What any process does for all: ends what nobody wants any more or comes too late, mends what a crash has left
//! half done, and forgets what is old.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;
use std::time::{Duration, Instant};

use futures_util::{StreamExt, stream};

use super::client::Client;
use super::mirror::{Board, Fate};
use super::record::{Claimant, Record};
use crate::moment::now;
use crate::threads::run::Told;
use crate::{JobId, State, Unavailable};

/// How often it looks.
const TICK: Duration = Duration::from_millis(250);

/// Records that are written at the same time.
const AT_ONCE: usize = 32;

/// Who has been heard of.
struct Heard {
    processes: HashMap<u64, Instant>,
    /// Since when the broker has been there, and this process's own signs of life have come back.
    since: Instant,
}

pub(super) async fn keep_house(client: Arc<Client>) {
    let lease = client.bus.config.lease;
    let mut heard = Heard { processes: HashMap::new(), since: Instant::now() };
    let mut tick = tokio::time::interval(TICK);
    tick.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Delay);
    let subject = format!("{}.alive", client.bus.config.name);
    let Ok(mut alive) = client.bus.client.subscribe(subject).await else {
        return;
    };
    loop {
        tokio::select! {
            _ = tick.tick() => look(&client, &mut heard).await,
            () = client.mirror.ended.notified() => release(&client, |_| false).await,
            Some(message) = alive.next() => {
                if let Some(process) = message.payload.first_chunk() {
                    heard.hear(u64::from_be_bytes(*process), client.process, lease);
                }
            }
        }
    }
}

/// Tells the others that this process is there, whatever else it waits for.
pub(super) async fn show_life(client: Arc<Client>) {
    let mut beat = tokio::time::interval(client.bus.config.lease / 4);
    beat.set_missed_tick_behavior(tokio::time::MissedTickBehavior::Delay);
    loop {
        beat.tick().await;
        client.bus.tell("alive", client.process.to_be_bytes().to_vec()).await;
    }
}

impl Heard {
    fn hear(&mut self, process: u64, own: u64, lease: Duration) {
        let last = self.processes.insert(process, Instant::now());
        if process == own && last.is_none_or(|last| last.elapsed() > lease / 2) {
            self.since = Instant::now();
        }
    }

    /// Whose claims are seen for the first time has been heard of then.
    fn meet(&mut self, board: &Board) {
        for claimant in board.claimants() {
            if let Claimant::Process(process) = claimant {
                self.processes.entry(*process).or_insert_with(Instant::now);
            }
        }
    }

    /// Whether a process would have been heard of if it were there.
    fn misses(&self, process: u64, own: u64, lease: Duration) -> bool {
        let silent = |process: u64, limit: Duration| {
            self.processes.get(&process).is_none_or(|last| last.elapsed() > limit)
        };
        process != own && self.since.elapsed() > lease && !silent(own, lease / 2) && silent(process, lease)
    }
}

async fn look(client: &Client, heard: &mut Heard) {
    let lease = client.bus.config.lease;
    heard.meet(&client.mirror.lock());
    let missed = |process: u64| heard.misses(process, client.process, lease);
    let late = client.mirror.lock().live(is_late);
    for record in late {
        tidy(client, &record, |record| record.stop(Told::DeadlinePassed)).await;
    }
    release(client, missed).await;
    heard.processes.retain(|_, last| last.elapsed() < 2 * lease);
    mend(client).await;
    forget(client).await;
}

fn is_late(record: &Record) -> bool {
    record.deadline.is_some_and(|deadline| deadline <= now())
}

/// Ends claims of those that are gone: processes, and wholes that have ended.
async fn release(client: &Client, missed: impl Fn(u64) -> bool) {
    let absent = absent_wholes(client).await;
    let gone = |board: &Board, claimant: &Claimant| match claimant {
        Claimant::Process(process) => missed(*process),
        Claimant::Whole(id, life) => match board.fate(*id, *life) {
            Fate::GoesOn => false,
            Fate::Ended => true,
            Fate::Unheard => absent.contains(id),
        },
    };
    let released = {
        let board = client.mirror.lock();
        board.live(|record| record.claimants.iter().any(|claimant| gone(&board, claimant)))
    };
    // Those that run first: their cores are waited for.
    let (running, queued): (Vec<_>, Vec<_>) =
        released.into_iter().partition(|record| record.job.state == State::Running);
    let released = stream::iter(running.into_iter().chain(queued)).map(|record| async move {
        tidy(client, &record, |record| {
            let board = client.mirror.lock();
            record.claimants.retain(|claimant| !gone(&board, claimant));
            if !record.is_wanted() {
                tracing::debug!(job = %record.job.id, "who wanted it is gone: cancelled");
                record.stop(Told::Cancelled);
            }
        })
        .await;
    });
    released.buffer_unordered(AT_ONCE).collect::<()>().await;
}

/// The wholes of live parts that the broker does not have.
async fn absent_wholes(client: &Client) -> HashSet<JobId> {
    let unheard: HashSet<JobId> = {
        let board = client.mirror.lock();
        let unheard = |claimant: &Claimant| match claimant {
            Claimant::Whole(id, life) => (board.fate(*id, *life) == Fate::Unheard).then_some(*id),
            Claimant::Process(_) => None,
        };
        let parts = board.live(|record| record.claimants.iter().any(|claimant| unheard(claimant).is_some()));
        parts.iter().flat_map(|record| &record.claimants).filter_map(unheard).collect()
    };
    let mut absent = HashSet::new();
    for id in unheard {
        if matches!(client.refresh(id).await, Ok(None)) {
            absent.insert(id);
        }
    }
    absent
}

/// Changes a record if it is still that life of the job.
async fn tidy(client: &Client, record: &Record, change: impl Fn(&mut Record)) {
    let (id, life) = (record.job.id, record.life);
    let _shard = client.shard(id).await;
    let tidied = client.change(id, |record| {
        let tidies = record.life == life && record.goes_on();
        if tidies {
            change(record);
        }
        tidies
    });
    if let Err(fault) = tidied.await {
        tracing::warn!(%fault, "a job that nobody wants is not cancelled yet");
    }
}

/// Queues what was recorded and is not in its line: the process died between the two, or the broker lost it.
async fn mend(client: &Client) {
    let unseen = client.mirror.lock().unseen(client.bus.config.mend_after);
    for record in unseen {
        if matches!(client.bus.is_published(&record).await, Ok(false))
            && let Err(fault) = queue_again(client, record.job.id).await
        {
            tracing::debug!(%fault, "a job that was not queued is not queued yet");
        }
    }
}

/// In a turn of its own: the broker would take the message of a turn that it has seen for a repetition.
async fn queue_again(client: &Client, id: JobId) -> Result<(), Unavailable> {
    let _shard = client.shard(id).await;
    let Some((record, _)) = client.refresh(id).await? else {
        return Ok(());
    };
    if record.job.state.is_final() || client.bus.is_published(&record).await? {
        return Ok(());
    }
    let seen = (record.life, record.turn);
    let queued = client.change(id, |record| {
        let lost = (record.life, record.turn) == seen && record.goes_on();
        if lost {
            record.requeue();
        }
        lost
    });
    if let Some(record) = queued.await?.filter(|record| (record.life, record.turn) == (seen.0, seen.1 + 1)) {
        tracing::warn!(job = %id, "a recorded job was not queued; it is now");
        client.bus.publish(&record).await?;
    }
    Ok(())
}

/// Each process forgets by the same rule, and has the broker forget: nobody is told that another has.
async fn forget(client: &Client) {
    let forgotten = client.mirror.lock().forget(client.bus.config.retention);
    let forgotten = stream::iter(forgotten).map(|(id, revision)| client.bus.forget(id, revision));
    forgotten.buffer_unordered(AT_ONCE).collect::<()>().await;
}
