//! The part of every process: it knows the jobs and changes their records.

use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use tokio::sync::{Mutex, MutexGuard, mpsc};

use super::claims::{ClaimChange, Claims};
use super::nats::Nats;
use super::nats::records::WriteError;
use super::queue_class::QueueClass;
use super::record::{Claimant, Record};
use super::replica::Replica;
use crate::error::{SubmitError, UnavailableError};
use crate::execution::stop::StopSignal;
use crate::job::{Job, Submission};
use crate::job_id::{JobId, JobKey};

/// Most jobs whose records this process writes at the same time.
const SHARDS: usize = 256;

/// Most attempts to write a record that other processes write too.
const ATTEMPTS: usize = 50;

pub(super) struct Client {
    pub(super) nats: Nats,
    pub(super) replica: Replica,
    pub(super) claims: Claims,
    /// Random number of this process.
    pub(super) process: u64,
    pub(super) draining: AtomicBool,
    pub(super) closed: AtomicBool,
    shards: Vec<Mutex<()>>,
    last_generation: AtomicU64,
}

impl Client {
    pub(super) fn new(nats: Nats, changes: mpsc::UnboundedSender<ClaimChange>) -> Self {
        Self {
            nats,
            replica: Replica::default(),
            claims: Claims::new(changes),
            process: random(),
            draining: AtomicBool::new(false),
            closed: AtomicBool::new(false),
            shards: (0..SHARDS).map(|_| Mutex::new(())).collect(),
            last_generation: AtomicU64::new(0),
        }
    }

    /// Lock for writing the job's record.
    pub(super) async fn shard(&self, id: JobId) -> MutexGuard<'_, ()> {
        let [first, ..] = *id.as_bytes();
        self.shards[usize::from(first) % SHARDS].lock().await
    }

    /// Joins an active job for a claimant, or starts a generation of it. Returns its record.
    pub(super) async fn submit(
        &self,
        submission: &Submission,
        claimant: Claimant,
        class: QueueClass,
    ) -> Result<Record, SubmitError> {
        let mut known = self.replica.read(submission.id);
        for _ in 0..ATTEMPTS {
            if self.draining.load(Ordering::Acquire) {
                return Err(SubmitError::Draining);
            }
            let (record, revision, is_new) = match known {
                Some((mut record, revision)) if record.is_active() => {
                    if !record.join(submission, claimant) {
                        return Ok(record);
                    }
                    (record, Some(revision), false)
                }
                known => {
                    let before = known.as_ref().map(|(record, _)| record);
                    let record = self.new_record(submission, claimant, class, before)?;
                    (record, known.map(|(_, revision)| revision), true)
                }
            };
            match self.write(&record, revision).await {
                Ok(()) => {
                    if is_new && let Err(error) = self.nats.publish(&record).await {
                        tracing::warn!(%error, "a job is recorded and will be queued later");
                    }
                    return Ok(record);
                }
                Err(WriteError::Unavailable(error)) => {
                    // The record may have been written nevertheless, with a claim that nobody here has.
                    if matches!(claimant, Claimant::Process(_)) {
                        self.claims.change(record.key(), |_| ());
                    }
                    return Err(error.into());
                }
                Err(WriteError::Conflict) => known = self.refresh(submission.id).await?,
            }
        }
        Err(contended().into())
    }

    fn new_record(
        &self,
        submission: &Submission,
        claimant: Claimant,
        class: QueueClass,
        before: Option<&Record>,
    ) -> Result<Record, SubmitError> {
        let as_subtask = matches!(claimant, Claimant::Parent(_));
        self.check_room(submission.payload.len(), as_subtask)?;
        let is_only_subtask = as_subtask && before.is_none_or(|before| before.is_only_subtask);
        let generation = self.next_generation(before.map_or(0, |before| before.generation));
        Ok(Record::new(generation, submission.clone(), class, claimant, is_only_subtask))
    }

    /// Changes a record and returns it, or `None` if there is none. `change` returns whether it has changed the record.
    pub(super) async fn change(
        &self,
        id: JobId,
        change: impl Fn(&mut Record) -> bool,
    ) -> Result<Option<Record>, UnavailableError> {
        let mut known = match self.replica.read(id) {
            // The record may not have arrived here yet.
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
                Err(WriteError::Unavailable(error)) => return Err(error),
                Err(WriteError::Conflict) => known = self.refresh(id).await?,
            }
        }
        Err(contended())
    }

    async fn write(&self, record: &Record, revision: Option<u64>) -> Result<(), WriteError> {
        let revision = self.nats.write(record, revision).await?;
        self.replica.apply(record.clone(), revision);
        Ok(())
    }

    /// Reads a record from the broker into the replica.
    pub(super) async fn refresh(&self, id: JobId) -> Result<Option<(Record, u64)>, UnavailableError> {
        let before = self.replica.revision(id);
        let read = self.nats.read(id).await?;
        match &read {
            Some((record, revision)) => self.replica.apply(record.clone(), *revision),
            None => self.replica.remove(id, before),
        }
        Ok(read)
    }

    /// Cancels a job and returns it.
    pub(super) async fn cancel(&self, id: JobId) -> Result<Option<Job>, UnavailableError> {
        let _shard = self.shard(id).await;
        let cancelled = self.change(id, |record| {
            let is_active = record.is_active();
            if is_active {
                record.claimants.clear();
                record.is_detached = false;
                record.stop(StopSignal::Cancelled);
            }
            is_active
        });
        Ok(cancelled.await?.and(self.replica.job(id)))
    }

    /// Removes a client from a job and returns the job.
    pub(super) async fn leave(&self, id: JobId, client: &str) -> Result<Option<Job>, UnavailableError> {
        let _shard = self.shard(id).await;
        let left = self.change(id, |record| record.leave(client)).await?;
        Ok(left.and(self.replica.job(id)))
    }

    /// Changes one generation of a job if it is active.
    pub(super) async fn change_active(
        &self,
        key: JobKey,
        change: impl Fn(&mut Record),
    ) -> Result<(), UnavailableError> {
        let _shard = self.shard(key.id).await;
        let changed = self.change(key.id, |record| {
            let changes = record.key() == key && record.is_active();
            if changes {
                change(record);
            }
            changes
        });
        changed.await.map(drop)
    }

    fn check_room(&self, bytes: usize, as_subtask: bool) -> Result<(), SubmitError> {
        let config = &self.nats.config;
        let index = self.replica.lock();
        // Jobs that wait for their subtasks take no room from them.
        let waiting = if as_subtask { 0 } else { index.waiting };
        let fits = index.bytes.saturating_add(bytes) <= config.queue_bytes || as_subtask;
        if index.counts.queued + waiting < config.queue.max(1) && fits {
            return Ok(());
        }
        let mean = index.mean_cost_queued();
        Err(SubmitError::Full { retry_after: Duration::from_secs_f64(mean.clamp(1.0, 60.0)) })
    }

    fn next_generation(&self, before: u64) -> u64 {
        let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        let micros = u64::try_from(since.as_micros()).unwrap_or(u64::MAX >> 12);
        // Random low bits distinguish submissions of several processes in one microsecond.
        let now = (micros << 12) | (random() & 0xFFF);
        let after = |last: u64| now.max(last + 1).max(before + 1);
        let last =
            self.last_generation.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |last| Some(after(last)));
        after(last.unwrap_or_default())
    }
}

fn contended() -> UnavailableError {
    UnavailableError::new("too many processes write the record of one job")
}

fn random() -> u64 {
    RandomState::new().build_hasher().finish()
}
