//! The records and what follows from them.

use std::collections::{BTreeSet, HashMap};
use std::time::{Duration, SystemTime};

use super::entry::Entry;
use crate::embedded::Retention;
use crate::jetstream::bus::Line;
use crate::jetstream::record::{Claimant, Record};
use crate::{Counts, Filter, Job, JobId, State};

/// Most jobs that are looked for at once.
const LOOKS_AT_ONCE: usize = 64;

/// What has become of a life of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::jetstream) enum Fate {
    GoesOn,
    Ended,
    /// There is no such job, or it is still to be heard of. A record leaves the broker when the next is written in its place,
    /// so that who lags behind hears of a part before he hears of its whole.
    Unheard,
}

/// What a client has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Share {
    /// Jobs that are queued, by their lines.
    queued: [usize; Line::ALL.len()],
    /// Jobs that run, without those that wait for their parts.
    running: usize,
}

#[derive(Default)]
pub(in crate::jetstream) struct Board {
    pub(in crate::jetstream) entries: HashMap<JobId, Entry>,
    by_life: BTreeSet<(u64, JobId)>,
    /// Not finished.
    live: BTreeSet<JobId>,
    pub(in crate::jetstream) counts: Counts,
    /// Jobs that wait for their parts.
    pub(in crate::jetstream) split: usize,
    /// Of the payloads of what is queued or waits for parts.
    pub(in crate::jetstream) bytes: usize,
    /// Of what is queued, seconds of one core.
    cost: f64,
    /// By client: of those that have jobs that are queued or run.
    shares: HashMap<String, Share>,
    /// By the time of their end: jobs, and what were only parts.
    ended: [BTreeSet<(SystemTime, JobId)>; 2],
    /// The last revision that was heard of.
    pub(super) highest: u64,
    /// What follows has happened while this process watched.
    pub(in crate::jetstream) caught_up: bool,
}

impl Board {
    pub(super) fn apply(&mut self, record: Record, revision: u64) {
        let id = record.job.id;
        let known = self.entries.get(&id);
        self.highest = self.highest.max(revision);
        if known.is_some_and(|entry| entry.revision >= revision) {
            return;
        }
        let old = known.map(|entry| entry.record.clone());
        self.count(old.as_ref(), &record);
        if record.job.state.is_final() {
            self.live.remove(&id);
        } else {
            self.live.insert(id);
        }
        if let Some(old) = &old {
            self.by_life.remove(&(old.life, id));
        }
        self.by_life.insert((record.life, id));
        match self.entries.get_mut(&id) {
            Some(entry) => entry.replace(record, revision),
            None => drop(self.entries.insert(id, Entry::new(record, revision))),
        }
    }

    pub(super) fn begin_anew(&mut self) {
        let counts = Counts { queued: 0, running: 0, ..self.counts };
        *self = Self { counts, caught_up: self.caught_up, ..Self::default() };
    }

    pub(in crate::jetstream) fn remove(&mut self, id: JobId) {
        if let Some(entry) = self.entries.remove(&id) {
            self.weigh(&entry.record, false);
            self.by_life.remove(&(entry.record.life, id));
            self.live.remove(&id);
        }
    }

    fn count(&mut self, old: Option<&Record>, new: &Record) {
        if let Some(old) = old {
            self.weigh(old, false);
        }
        self.weigh(new, true);
        if !self.caught_up {
            return;
        }
        let same = old.filter(|old| old.life == new.life);
        if old.is_some_and(|old| same.is_none() && !old.job.state.is_final() && old.told.is_some()) {
            // Its life before.
            self.counts.cancelled += 1;
        }
        let attempts = same.map_or(0, |old| old.job.attempts);
        self.counts.started += u64::from(new.job.attempts.saturating_sub(attempts));
        if same.is_none_or(|old| old.job.state != new.job.state) {
            match new.job.state {
                State::Succeeded => self.counts.succeeded += 1,
                State::Failed => self.counts.failed += 1,
                State::Cancelled => self.counts.cancelled += 1,
                State::Queued | State::Running => {}
            }
        }
    }

    /// Adds a record to the sums, or takes it out.
    fn weigh(&mut self, record: &Record, adds: bool) {
        let sum = |sum: &mut usize, by: usize| *sum = if adds { *sum + by } else { sum.saturating_sub(by) };
        let job = &record.job;
        match job.state {
            State::Queued => {
                sum(&mut self.counts.queued, 1);
                self.cost += if adds { job.cost } else { -job.cost };
            }
            State::Running if record.split => sum(&mut self.split, 1),
            State::Running => sum(&mut self.counts.running, 1),
            _ => {}
        }
        let share = self.shares.entry(job.client.clone()).or_default();
        match job.state {
            State::Queued => sum(&mut share.queued[record.line as usize], 1),
            State::Running if !record.split => sum(&mut share.running, 1),
            _ => {}
        }
        if *share == Share::default() {
            self.shares.remove(&job.client);
        }
        if job.state == State::Queued || record.split {
            sum(&mut self.bytes, job.payload.len());
        }
        if let Some(finished) = job.finished {
            let ended = &mut self.ended[usize::from(record.hidden)];
            let place = (finished, job.id);
            if adds {
                ended.insert(place)
            } else {
                ended.remove(&place)
            };
        }
    }

    /// Whether in a line a job of another client waits that has fewer jobs running than the client of this job.
    pub(in crate::jetstream) fn gives_way(&self, id: JobId, line: Line) -> bool {
        let Some(client) = self.entries.get(&id).map(|entry| &entry.record.job.client) else {
            return false;
        };
        let running = self.shares.get(client).map_or(0, |share| share.running);
        let waits = |share: &Share| share.queued[line as usize] > 0 && share.running < running;
        self.shares.iter().any(|(other, share)| other != client && waits(share))
    }

    /// Whether in a line a job of another client than this one waits.
    pub(in crate::jetstream) fn has_other(&self, client: &str, line: Line) -> bool {
        self.shares.iter().any(|(other, share)| other != client && share.queued[line as usize] > 0)
    }

    /// Of the queue, seconds of one core.
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    pub(in crate::jetstream) fn mean_cost_queued(&self) -> f64 {
        self.cost / self.counts.queued.max(1) as f64
    }

    /// Finished jobs beyond what is kept leave; they and their revisions.
    pub(in crate::jetstream) fn forget(&mut self, retention: Retention) -> Vec<(JobId, u64)> {
        let oldest = SystemTime::now().checked_sub(retention.age);
        let mut old = Vec::new();
        for ended in &self.ended {
            let surplus = ended.len().saturating_sub(retention.count);
            let late = |(finished, _): &(SystemTime, JobId)| oldest.is_some_and(|oldest| *finished < oldest);
            let leave = ended.iter().enumerate().take_while(|(i, place)| *i < surplus || late(place));
            old.extend(leave.map(|(_, (_, id))| *id));
        }
        let revision = |id: &JobId| self.entries.get(id).map(|entry| (*id, entry.revision));
        let revisions = old.iter().filter_map(revision).collect();
        for id in old {
            self.remove(id);
        }
        revisions
    }

    /// Newest first, and where the next page begins.
    pub(in crate::jetstream) fn page(&self, filter: &Filter) -> (Vec<Job>, Option<u64>) {
        let limit = filter.limit.clamp(1, Filter::MAX_LIMIT);
        let before = (filter.after.map_or(u64::MAX, |cursor| cursor.0), JobId::from_bytes([0; 32]));
        let newest = self.by_life.range(..before).rev().filter_map(|(_, id)| self.entries.get(id));
        let mut found = newest.filter(|entry| {
            let Record { job, hidden, .. } = &entry.record;
            !hidden
                && filter.state.is_none_or(|state| state == job.state)
                && filter.client.as_ref().is_none_or(|client| job.clients.contains(client))
        });
        let page: Vec<_> = found.by_ref().take(limit).collect();
        let next = found.next().and(page.last()).map(|entry| entry.record.life);
        (page.into_iter().map(|entry| entry.feeder.job()).collect(), next)
    }

    /// Unfinished jobs that have not been told to stop and of which this holds.
    pub(in crate::jetstream) fn live(&self, holds: impl Fn(&Record) -> bool) -> Vec<Record> {
        let records = self.live.iter().filter_map(|id| self.entries.get(id)).map(|entry| &entry.record);
        records.filter(|record| record.told.is_none() && holds(record)).cloned().collect()
    }

    /// Of the jobs that are under way.
    pub(in crate::jetstream) fn claimants(&self) -> impl Iterator<Item = &Claimant> {
        let live = self.live.iter().filter_map(|id| self.entries.get(id));
        live.flat_map(|entry| &entry.record.claimants)
    }

    /// What has become of a life of a job.
    pub(in crate::jetstream) fn fate(&self, id: JobId, life: u64) -> Fate {
        match self.entries.get(&id).map(|entry| &entry.record) {
            None => Fate::Unheard,
            // What was written in between is not heard by who comes late: its end, but neither its beginning.
            Some(record) if record.life < life => Fate::GoesOn,
            Some(record) if record.life == life && !record.job.state.is_final() => Fate::GoesOn,
            Some(_) => Fate::Ended,
        }
    }

    /// Some unfinished jobs that have not been written, or looked for, since `age`; they are looked for now, and
    /// ever less often.
    pub(in crate::jetstream) fn unseen(&mut self, age: Duration) -> Vec<Record> {
        let mut unseen = Vec::new();
        for id in &self.live {
            let Some(entry) = self.entries.get_mut(id) else { continue };
            if entry.is_unseen(age) {
                unseen.push(entry.record.clone());
                if unseen.len() == LOOKS_AT_ONCE {
                    break;
                }
            }
        }
        unseen
    }
}
