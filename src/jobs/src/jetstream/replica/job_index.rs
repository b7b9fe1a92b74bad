//! The records of the replica with indexes and sums.

use std::collections::{BTreeSet, HashMap};
use std::time::{Duration, SystemTime};

use super::entry::Entry;
use crate::counts::Counts;
use crate::jetstream::queue_class::QueueClass;
use crate::jetstream::record::{Claimant, Record};
use crate::job::State;
use crate::job_id::{JobId, JobKey};
use crate::page::{Cursor, Filter, Page};
use crate::retention::Retention;

/// Most jobs whose messages are searched at once.
const MAX_SEARCHES: usize = 64;

/// Whether a generation of a job continues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Liveness {
    Active,
    Ended,
    /// The job does not exist, or its record has not arrived yet. The next record of a job replaces the one before at
    /// the broker; so a process that lags behind may receive a subtask's record before its parent's.
    Unknown,
}

/// The jobs of one client.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct ClientJobs {
    /// Queued jobs by class.
    queued: [usize; QueueClass::ALL.len()],
    /// Running jobs, without those that wait for their subtasks.
    running: usize,
}

#[derive(Default)]
pub(crate) struct JobIndex {
    pub(crate) entries: HashMap<JobId, Entry>,
    by_generation: BTreeSet<(u64, JobId)>,
    unfinished: BTreeSet<JobId>,
    pub(crate) counts: Counts,
    /// Jobs that wait for their subtasks.
    pub(crate) waiting: usize,
    /// Sum of the payloads of jobs that are queued or wait for subtasks.
    pub(crate) bytes: usize,
    /// Sum of the costs of queued jobs, seconds of one core.
    cost: f64,
    /// Clients with queued or running jobs.
    clients: HashMap<String, ClientJobs>,
    /// Ended jobs by time: those of clients, and those that were only subtasks.
    ended: [BTreeSet<(SystemTime, JobId)>; 2],
    pub(super) highest_revision: u64,
    /// All records that existed at the start have arrived. Later ones count.
    pub(crate) is_caught_up: bool,
}

impl JobIndex {
    pub(super) fn apply(&mut self, record: Record, revision: u64) {
        let id = record.job.id;
        let known = self.entries.get(&id);
        self.highest_revision = self.highest_revision.max(revision);
        if known.is_some_and(|entry| entry.revision >= revision) {
            return;
        }
        let old = known.map(|entry| entry.record.clone());
        if let Some(old) = &old {
            self.sum_up(old, false);
            self.by_generation.remove(&(old.generation, id));
        }
        self.sum_up(&record, true);
        if self.is_caught_up {
            self.count(old.as_ref(), &record);
        }
        if record.job.state.is_final() {
            self.unfinished.remove(&id);
        } else {
            self.unfinished.insert(id);
        }
        self.by_generation.insert((record.generation, id));
        match self.entries.get_mut(&id) {
            Some(entry) => entry.replace(record, revision),
            None => drop(self.entries.insert(id, Entry::new(record, revision))),
        }
    }

    /// Removes all jobs. Counts since the start stay.
    pub(super) fn clear(&mut self) {
        let counts = Counts { queued: 0, running: 0, ..self.counts };
        *self = Self { counts, is_caught_up: self.is_caught_up, ..Self::default() };
    }

    pub(crate) fn remove(&mut self, id: JobId) {
        if let Some(entry) = self.entries.remove(&id) {
            self.sum_up(&entry.record, false);
            self.by_generation.remove(&(entry.record.generation, id));
            self.unfinished.remove(&id);
        }
    }

    fn count(&mut self, old: Option<&Record>, new: &Record) {
        let same = old.filter(|old| old.generation == new.generation);
        let is_new = same.is_none();
        if old.is_some_and(|old| is_new && !old.job.state.is_final() && old.stop_signal.is_some()) {
            // The earlier generation, which was told to stop.
            self.counts.cancelled += 1;
        }
        let attempts = same.map_or(0, |old| old.job.attempts);
        self.counts.started += u64::from(new.job.attempts.saturating_sub(attempts));
        if same.is_none_or(|old| old.job.state != new.job.state) {
            self.counts.count_end(new.job.state);
        }
    }

    /// Adds a record to the sums, or subtracts it.
    fn sum_up(&mut self, record: &Record, adds: bool) {
        let sum = |sum: &mut usize, by: usize| *sum = if adds { *sum + by } else { sum.saturating_sub(by) };
        let job = &record.job;
        let client = self.clients.entry(job.client.clone()).or_default();
        match job.state {
            State::Queued => {
                sum(&mut self.counts.queued, 1);
                sum(&mut client.queued[record.class as usize], 1);
                self.cost += if adds { job.cost } else { -job.cost };
            }
            State::Running if record.is_waiting => sum(&mut self.waiting, 1),
            State::Running => {
                sum(&mut self.counts.running, 1);
                sum(&mut client.running, 1);
            }
            State::Succeeded | State::Failed | State::Cancelled => {}
        }
        if *client == ClientJobs::default() {
            self.clients.remove(&job.client);
        }
        if job.state == State::Queued || record.is_waiting {
            sum(&mut self.bytes, job.payload.len());
        }
        if let Some(finished) = job.finished {
            let ended = &mut self.ended[usize::from(record.is_only_subtask)];
            let position = (finished, job.id);
            if adds {
                ended.insert(position)
            } else {
                ended.remove(&position)
            };
        }
    }

    /// Whether another client has a job in a queue and fewer jobs running than the client of this job.
    pub(crate) fn must_yield(&self, id: JobId, class: QueueClass) -> bool {
        let Some(client) = self.entries.get(&id).map(|entry| &entry.record.job.client) else {
            return false;
        };
        let running = self.clients.get(client).map_or(0, |jobs| jobs.running);
        self.others(client, class).any(|jobs| jobs.running < running)
    }

    /// Whether another client than this one has a job in a queue.
    pub(crate) fn has_other(&self, client: &str, class: QueueClass) -> bool {
        self.others(client, class).next().is_some()
    }

    /// Other clients with jobs in a queue.
    fn others(&self, client: &str, class: QueueClass) -> impl Iterator<Item = &ClientJobs> {
        let others = self.clients.iter().filter(move |(other, _)| *other != client);
        others.map(|(_, jobs)| jobs).filter(move |jobs| jobs.queued[class as usize] > 0)
    }

    /// Mean cost of the queued jobs, seconds of one core.
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    pub(crate) fn mean_cost_queued(&self) -> f64 {
        self.cost / self.counts.queued.max(1) as f64
    }

    /// Removes the ended jobs that exceed the retention. Returns them and their revisions.
    pub(crate) fn forget(&mut self, retention: Retention) -> Vec<(JobId, u64)> {
        let oldest = SystemTime::now().checked_sub(retention.age);
        let mut old = Vec::new();
        for ended in &self.ended {
            let surplus = ended.len().saturating_sub(retention.count);
            let is_old =
                |(finished, _): &(SystemTime, JobId)| oldest.is_some_and(|oldest| *finished < oldest);
            let leave = ended.iter().enumerate().take_while(|(i, position)| *i < surplus || is_old(position));
            old.extend(leave.map(|(_, (_, id))| *id));
        }
        let revision = |id: &JobId| self.entries.get(id).map(|entry| (*id, entry.revision));
        let revisions = old.iter().filter_map(revision).collect();
        for id in old {
            self.remove(id);
        }
        revisions
    }

    pub(crate) fn page(&self, filter: &Filter) -> Page {
        let before = (filter.after.map_or(u64::MAX, |cursor| cursor.0), JobId::from_bytes([0; 32]));
        let newest = self.by_generation.range(..before).rev().filter_map(|(_, id)| self.entries.get(id));
        let mut found =
            newest.filter(|entry| !entry.record.is_only_subtask && filter.matches(&entry.record.job));
        let page: Vec<_> = found.by_ref().take(filter.page_size()).collect();
        let next = found.next().and(page.last()).map(|entry| Cursor(entry.record.generation));
        Page { jobs: page.into_iter().map(|entry| entry.job.job()).collect(), next }
    }

    /// Active jobs for which the condition holds.
    pub(crate) fn active(&self, condition: impl Fn(&Record) -> bool) -> Vec<Record> {
        let records = self.unfinished.iter().filter_map(|id| self.entries.get(id)).map(|entry| &entry.record);
        records.filter(|record| record.is_active() && condition(record)).cloned().collect()
    }

    /// Claimants of all jobs that have not ended.
    pub(crate) fn claimants(&self) -> impl Iterator<Item = &Claimant> {
        let unfinished = self.unfinished.iter().filter_map(|id| self.entries.get(id));
        unfinished.flat_map(|entry| &entry.record.claimants)
    }

    /// The entry of a job, if this is its latest generation.
    pub(super) fn entry(&self, key: JobKey) -> Option<&Entry> {
        self.entries.get(&key.id).filter(|entry| entry.record.generation == key.generation)
    }

    /// Whether a generation of a job continues.
    pub(crate) fn liveness(&self, key: JobKey) -> Liveness {
        match self.entries.get(&key.id).map(|entry| &entry.record) {
            None => Liveness::Unknown,
            // A process that lags behind misses records in between: an end, but not a start.
            Some(record) if record.generation < key.generation => Liveness::Active,
            Some(record) if record.key() == key && !record.job.state.is_final() => Liveness::Active,
            Some(_) => Liveness::Ended,
        }
    }

    /// Some unfinished jobs whose messages are to be searched now, because their records are older than `age`.
    pub(crate) fn take_unseen(&mut self, age: Duration) -> Vec<Record> {
        let mut unseen = Vec::new();
        for id in &self.unfinished {
            let Some(entry) = self.entries.get_mut(id) else { continue };
            if entry.take_unseen(age) {
                unseen.push(entry.record.clone());
                if unseen.len() == MAX_SEARCHES {
                    break;
                }
            }
        }
        unseen
    }
}
