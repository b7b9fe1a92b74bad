//! All records, as far as this process has heard of them.

use std::collections::{BTreeSet, HashMap};
use std::time::{Duration, Instant, SystemTime};

use parking_lot::{Mutex, MutexGuard};
use tokio::sync::{Notify, watch};

use super::record::{Claimant, Record};
use crate::embedded::Retention;
use crate::feed::{Feed, Feeder};
use crate::threads::run::Told;
use crate::{Counts, Filter, Job, JobId, State};

/// What concerns who runs a job: its life, its attempt and what it was told.
pub(super) type Signal = (u64, u32, Option<Told>);

pub(super) struct Entry {
    pub(super) revision: u64,
    pub(super) record: Record,
    pub(super) feeder: Feeder,
    signal: watch::Sender<Signal>,
    /// When it was last written, or looked for in its line.
    seen: Instant,
    /// How often it was looked for since it was written.
    looks: u32,
}

/// A job is looked for after doubling times, so often; then at the last.
const MOST_LOOKS: u32 = 6;

/// Most jobs that are looked for at once.
const LOOKS_AT_ONCE: usize = 64;

/// What has become of a life of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fate {
    GoesOn,
    Ended,
    /// There is no such job, or it is still to be heard of. A record leaves the broker when the next is written in its place,
    /// so that who lags behind hears of a part before he hears of its whole.
    Unheard,
}

#[derive(Default)]
pub(super) struct Board {
    pub(super) entries: HashMap<JobId, Entry>,
    by_life: BTreeSet<(u64, JobId)>,
    /// Not finished.
    live: BTreeSet<JobId>,
    pub(super) counts: Counts,
    /// Jobs that wait for their parts.
    pub(super) split: usize,
    /// Of the payloads of what is queued or waits for parts.
    pub(super) bytes: usize,
    /// Of what is queued, seconds of one core.
    cost: f64,
    /// By the time of their end: jobs, and what were only parts.
    ended: [BTreeSet<(SystemTime, JobId)>; 2],
    /// The last revision that was heard of.
    highest: u64,
    /// What follows has happened while this process watched.
    pub(super) caught_up: bool,
}

#[derive(Default)]
pub(super) struct Mirror {
    board: Mutex<Board>,
    /// Notified when a job has ended.
    pub(super) ended: Notify,
}

impl Mirror {
    pub(super) fn lock(&self) -> MutexGuard<'_, Board> {
        self.board.lock()
    }

    /// Takes in what was written, unless something later is known.
    pub(super) fn apply(&self, record: Record, revision: u64) {
        let is_final = record.job.state.is_final();
        self.lock().apply(record, revision);
        if is_final {
            self.ended.notify_waiters();
        }
    }

    pub(super) fn progress(&self, id: JobId, life: u64, part: f64) {
        if let Some(entry) = self.lock().entries.get(&id).filter(|entry| entry.record.life == life) {
            entry.feeder.progress(part);
        }
    }

    pub(super) fn read(&self, id: JobId) -> Option<(Record, u64)> {
        self.lock().entries.get(&id).map(|entry| (entry.record.clone(), entry.revision))
    }

    pub(super) fn revision(&self, id: JobId) -> Option<u64> {
        self.lock().entries.get(&id).map(|entry| entry.revision)
    }

    /// Forgets a job, unless more has been heard of it since this revision.
    pub(super) fn remove(&self, id: JobId, revision: Option<u64>) {
        let mut board = self.lock();
        if board.entries.get(&id).map(|entry| entry.revision) == revision {
            board.remove(id);
        }
    }

    /// Forgets all if something later than this revision was heard of; whether it was.
    pub(super) fn begin_anew_after(&self, revision: u64) -> bool {
        let mut board = self.lock();
        let lost = board.highest > revision;
        if lost {
            let counts = Counts { queued: 0, running: 0, ..board.counts };
            *board = Board { counts, caught_up: board.caught_up, ..Board::default() };
        }
        lost
    }

    pub(super) fn job(&self, id: JobId) -> Option<Job> {
        self.lock().entries.get(&id).map(|entry| entry.feeder.job())
    }

    /// Of this life of the job.
    pub(super) fn feed(&self, id: JobId, life: u64) -> Option<Feed> {
        let board = self.lock();
        let entry = board.entries.get(&id).filter(|entry| entry.record.life == life);
        entry.map(|entry| entry.feeder.subscribe())
    }

    pub(super) fn signal(&self, id: JobId) -> Option<watch::Receiver<Signal>> {
        self.lock().entries.get(&id).map(|entry| entry.signal.subscribe())
    }
}

impl Board {
    fn apply(&mut self, record: Record, revision: u64) {
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

    pub(super) fn remove(&mut self, id: JobId) {
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

    /// Of the queue, seconds of one core.
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    pub(super) fn mean_cost_queued(&self) -> f64 {
        self.cost / self.counts.queued.max(1) as f64
    }

    /// Finished jobs beyond what is kept leave; they and their revisions.
    pub(super) fn forget(&mut self, retention: Retention) -> Vec<(JobId, u64)> {
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
    pub(super) fn page(&self, filter: &Filter) -> (Vec<Job>, Option<u64>) {
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
    pub(super) fn live(&self, holds: impl Fn(&Record) -> bool) -> Vec<Record> {
        let records = self.live.iter().filter_map(|id| self.entries.get(id)).map(|entry| &entry.record);
        records.filter(|record| record.told.is_none() && holds(record)).cloned().collect()
    }

    /// Of the jobs that are under way.
    pub(super) fn claimants(&self) -> impl Iterator<Item = &Claimant> {
        let live = self.live.iter().filter_map(|id| self.entries.get(id));
        live.flat_map(|entry| &entry.record.claimants)
    }

    /// What has become of a life of a job.
    pub(super) fn fate(&self, id: JobId, life: u64) -> Fate {
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
    pub(super) fn unseen(&mut self, age: Duration) -> Vec<Record> {
        let mut unseen = Vec::new();
        for id in &self.live {
            let Some(entry) = self.entries.get_mut(id) else { continue };
            if entry.seen.elapsed() > age * (1 << entry.looks) {
                (entry.seen, entry.looks) = (Instant::now(), (entry.looks + 1).min(MOST_LOOKS));
                unseen.push(entry.record.clone());
                if unseen.len() == LOOKS_AT_ONCE {
                    break;
                }
            }
        }
        unseen
    }
}

impl Entry {
    fn new(record: Record, revision: u64) -> Self {
        let feeder = Feeder::new(record.job.clone());
        let signal = watch::Sender::new((record.life, record.job.attempts, record.told));
        Self { revision, record, feeder, signal, seen: Instant::now(), looks: 0 }
    }

    fn replace(&mut self, record: Record, revision: u64) {
        let told = self.record.told.is_some();
        if record.life == self.record.life || (!told && !self.feeder.state().is_final()) {
            // Of a life whose end was not heard of, because the next life's beginning was written over it, the next makes
            // the same.
            self.feeder.change(|job| {
                let progress = if record.job.state == State::Running { job.progress } else { 0.0 };
                *job = record.job.clone();
                job.progress = job.progress.max(progress);
            });
        } else {
            // The life before has been told to stop.
            if !self.feeder.state().is_final() {
                self.feeder.change(|job| crate::job::finish(job, crate::threads::run::Outcome::Cancelled));
            }
            self.feeder = Feeder::new(record.job.clone());
        }
        self.signal.send_replace((record.life, record.job.attempts, record.told));
        (self.record, self.revision) = (record, revision);
        (self.seen, self.looks) = (Instant::now(), 0);
    }
}

#[cfg(test)]
mod tests {
    use super::{Fate, Mirror};
    use crate::jetstream::record::{Claimant, Record};
    use crate::threads::run::Outcome;
    use crate::{JobId, State, Submission};

    fn record(life: u64) -> Record {
        let submission = Submission {
            id: JobId::from_bytes([1; 32]),
            client: String::new(),
            cost: 1.0,
            payload: bytes::Bytes::new(),
            deadline: None,
        };
        Record::new(life, submission, Claimant::Process(1), false)
    }

    /// Its end was written over by the next beginning before this process heard of it.
    #[test]
    fn a_life_whose_end_was_not_heard_of_goes_on_in_the_next() {
        let (mirror, id) = (Mirror::default(), JobId::from_bytes([1; 32]));
        let mut running = record(1);
        running.begin();
        mirror.apply(running.clone(), 1);
        let waiting = mirror.feed(id, 1).map(|feed| feed.job().state);
        assert_eq!(waiting, Some(State::Running));
        let feed = mirror.feed(id, 1);
        mirror.apply(record(2), 3);
        assert_eq!(feed.as_ref().map(|feed| feed.job().state), Some(State::Queued), "not cancelled");
        let mut ended = record(2);
        ended.end(Outcome::Succeeded);
        mirror.apply(ended, 4);
        assert_eq!(feed.map(|feed| feed.job().state), Some(State::Succeeded));
        assert_eq!(mirror.lock().counts.cancelled, 0);
    }

    #[test]
    fn what_is_not_heard_of_has_not_ended() {
        let mirror = Mirror::default();
        let fate = |life| mirror.lock().fate(JobId::from_bytes([1; 32]), life);
        assert_eq!(fate(2), Fate::Unheard);
        mirror.apply(record(1), 1);
        assert_eq!(fate(2), Fate::GoesOn, "its record is still to come");
        mirror.apply(record(2), 2);
        assert_eq!((fate(1), fate(2)), (Fate::Ended, Fate::GoesOn));
        let mut ended = record(2);
        ended.end(Outcome::Succeeded);
        mirror.apply(ended, 3);
        assert_eq!(fate(2), Fate::Ended);
    }
}
