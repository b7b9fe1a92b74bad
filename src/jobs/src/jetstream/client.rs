//! The half that every process has: what it knows of the jobs, and how it changes them.

use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use tokio::sync::{Mutex, MutexGuard, mpsc};

use super::bus::{Bus, Line, WriteError};
use super::claims::{Claims, Settle};
use super::mirror::Mirror;
use super::record::{Claimant, Record};
use crate::threads::run::Told;
use crate::{Job, JobId, Submission, SubmitError, Unavailable};

/// Jobs whose records this process writes at the same time; more wait.
const SHARDS: usize = 256;

/// How often a record is read again because others have written it meanwhile.
const ATTEMPTS: usize = 50;

pub(super) struct Client {
    pub(super) bus: Bus,
    pub(super) mirror: Mirror,
    pub(super) claims: Claims,
    /// Of this process, at random.
    pub(super) process: u64,
    pub(super) draining: AtomicBool,
    pub(super) closed: AtomicBool,
    shards: Vec<Mutex<()>>,
    last_life: AtomicU64,
}

impl Client {
    pub(super) fn new(bus: Bus, settle: mpsc::UnboundedSender<Settle>) -> Self {
        Self {
            bus,
            mirror: Mirror::default(),
            claims: Claims::new(settle),
            process: random(),
            draining: AtomicBool::new(false),
            closed: AtomicBool::new(false),
            shards: (0..SHARDS).map(|_| Mutex::new(())).collect(),
            last_life: AtomicU64::new(0),
        }
    }

    /// Held while this process writes the job's record.
    pub(super) async fn shard(&self, id: JobId) -> MutexGuard<'_, ()> {
        let [first, ..] = *id.as_bytes();
        self.shards[usize::from(first) % SHARDS].lock().await
    }

    /// Joins a job for a claimant, or begins it in a line; the life that it has.
    pub(super) async fn submit(
        &self,
        submission: &Submission,
        claimant: Claimant,
        line: Line,
    ) -> Result<Record, SubmitError> {
        let as_part = matches!(claimant, Claimant::Whole(..));
        let mut known = self.mirror.read(submission.id);
        for _ in 0..ATTEMPTS {
            if self.draining.load(Ordering::Acquire) {
                return Err(SubmitError::Draining);
            }
            let (record, revision, is_new) = match known {
                Some((mut record, revision)) if record.goes_on() => {
                    if !record.join(submission, claimant, as_part) {
                        return Ok(record);
                    }
                    (record, Some(revision), false)
                }
                known => {
                    self.check_room(submission.payload.len(), as_part)?;
                    let before = known.as_ref().map(|(record, _)| record);
                    let hidden = as_part && before.is_none_or(|before| before.hidden);
                    let life = self.next_life(before.map_or(0, |before| before.life));
                    let record = Record::new(life, submission.clone(), line, claimant, hidden);
                    (record, known.map(|(_, revision)| revision), true)
                }
            };
            match self.write(&record, revision).await {
                Ok(()) => {
                    if is_new && let Err(fault) = self.bus.publish(&record).await {
                        tracing::warn!(%fault, "a job is recorded and will be queued later");
                    }
                    return Ok(record);
                }
                Err(WriteError::Unavailable(unavailable)) => {
                    // It may have been written all the same, with a claim that nobody here has.
                    if matches!(claimant, Claimant::Process(_)) {
                        self.claims.look_at((submission.id, record.life));
                    }
                    return Err(unavailable.into());
                }
                Err(WriteError::Conflict) => known = self.refresh(submission.id).await?,
            }
        }
        Err(contended().into())
    }

    /// Changes a record unless `change` says no; the record after that. `None`: there is none.
    pub(super) async fn change(
        &self,
        id: JobId,
        change: impl Fn(&mut Record) -> bool,
    ) -> Result<Option<Record>, Unavailable> {
        let mut known = match self.mirror.read(id) {
            // Perhaps it has not been heard of yet.
            None => self.refresh(id).await?,
            known => known,
        };
        for _ in 0..ATTEMPTS {
            let Some((mut record, revision)) = known else {
                return Ok(None);
            };
            if !change(&mut record) {
                return Ok(Some(record));
            }
            match self.write(&record, Some(revision)).await {
                Ok(()) => return Ok(Some(record)),
                Err(WriteError::Unavailable(unavailable)) => return Err(unavailable),
                Err(WriteError::Conflict) => known = self.refresh(id).await?,
            }
        }
        Err(contended())
    }

    async fn write(&self, record: &Record, revision: Option<u64>) -> Result<(), WriteError> {
        let revision = self.bus.write(record, revision).await?;
        self.mirror.apply(record.clone(), revision);
        Ok(())
    }

    /// What the broker has, whatever has been heard of it.
    pub(super) async fn refresh(&self, id: JobId) -> Result<Option<(Record, u64)>, Unavailable> {
        let before = self.mirror.revision(id);
        let read = self.bus.read(id).await?;
        match &read {
            Some((record, revision)) => self.mirror.apply(record.clone(), *revision),
            None => self.mirror.remove(id, before),
        }
        Ok(read)
    }

    /// The job after that.
    pub(super) async fn cancel(&self, id: JobId) -> Result<Option<Job>, Unavailable> {
        let _shard = self.shard(id).await;
        let cancelled = self.change(id, |record| {
            let goes_on = record.goes_on();
            if goes_on {
                record.claimants.clear();
                record.kept = false;
                record.stop(Told::Cancelled);
            }
            goes_on
        });
        Ok(cancelled.await?.and(self.mirror.job(id)))
    }

    /// The job after that.
    pub(super) async fn leave(&self, id: JobId, client: &str) -> Result<Option<Job>, Unavailable> {
        let _shard = self.shard(id).await;
        let left = self.change(id, |record| record.leave(client)).await?;
        Ok(left.and(self.mirror.job(id)))
    }

    fn check_room(&self, bytes: usize, as_part: bool) -> Result<(), SubmitError> {
        let config = &self.bus.config;
        let board = self.mirror.lock();
        // Those that wait for their parts do not keep the parts from the queue.
        let waiting = if as_part { 0 } else { board.split };
        let fits = board.bytes.saturating_add(bytes) <= config.queue_bytes || as_part;
        if board.counts.queued + waiting < config.queue.max(1) && fits {
            return Ok(());
        }
        let mean = board.mean_cost_queued();
        Err(SubmitError::Full { retry_after: Duration::from_secs_f64(mean.clamp(1.0, 60.0)) })
    }

    fn next_life(&self, before: u64) -> u64 {
        let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        let micros = u64::try_from(since.as_micros()).unwrap_or(u64::MAX >> 12);
        // The last digits tell submissions of different processes in one microsecond apart.
        let now = (micros << 12) | (random() & 0xFFF);
        let after = |last: u64| now.max(last + 1).max(before + 1);
        let last =
            self.last_life.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |last| Some(after(last)));
        after(last.unwrap_or_default())
    }
}

fn contended() -> Unavailable {
    Unavailable("too many write the record of one job".to_owned())
}

fn random() -> u64 {
    RandomState::new().build_hasher().finish()
}
