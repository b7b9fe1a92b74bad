//! What is known of the jobs that are not finished.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::sync::Arc;
use std::time::Instant;

use tokio::sync::watch;

use super::parts::Parts;
use super::queue::{Queue, Taken};
use crate::feed::Feeder;
use crate::threads::pools::{Lane, Seat};
use crate::threads::run::{Run, Told};
use crate::{JobId, State, Unavailable};

/// Whether the submission is durable; `None` until that is known.
pub(super) type Recorded = watch::Receiver<Option<Result<(), Unavailable>>>;

/// A job that is queued or runs, or whose end is not recorded yet.
pub(super) struct Entry {
    pub(super) life: u64,
    pub(super) feeder: Feeder,
    pub(super) recorded: Recorded,
    pub(super) deadline: Option<Instant>,
    pub(super) claims: usize,
    pub(super) kept: bool,
    /// Those that wait for it as a part of them: id and life.
    pub(super) parents: Vec<(JobId, u64)>,
    /// It has only been asked for as a part.
    pub(super) hidden: bool,
    pub(super) parts: Parts,
    /// The attempt under way.
    pub(super) run: Option<Arc<Run>>,
}

impl Entry {
    /// Whether a submission joins it; not what has ended, or has been told to.
    pub(super) fn goes_on(&self) -> bool {
        !self.feeder.state().is_final() && self.told().is_none()
    }

    pub(super) fn told(&self) -> Option<Told> {
        self.run.as_ref().and_then(|run| run.told())
    }

    pub(super) fn is_wanted(&self) -> bool {
        self.claims > 0 || self.kept || !self.parents.is_empty()
    }
}

pub(super) struct Board {
    pub(super) live: HashMap<JobId, Entry>,
    pub(super) queue: Queue,
    /// By life: also those that are not their job's life any more and have yet to stop.
    pub(super) running: HashMap<u64, Arc<Run>>,
    /// Seats without a run.
    pub(super) free: Vec<Seat>,
    /// Jobs that wait for their parts: number, and bytes of payload.
    pub(super) split: (usize, usize),
    /// Those of them that have parts to submit: id by life.
    pub(super) submitting: BTreeMap<u64, JobId>,
    /// Parts that were given up when the records were opened.
    pub(super) given_up: HashSet<JobId>,
    /// Of jobs that go on.
    pub(super) deadlines: BTreeSet<(Instant, u64, JobId)>,
    pub(super) last_life: u64,
    /// No job is taken any more.
    pub(super) draining: bool,
    /// Nothing is left to be done.
    pub(super) closed: bool,
    pub(super) tally: Tally,
}

/// Ends since the beginning.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    pub(super) succeeded: u64,
    pub(super) failed: u64,
    pub(super) cancelled: u64,
}

impl Tally {
    pub(super) fn count(&mut self, end: State) {
        match end {
            State::Succeeded => self.succeeded += 1,
            State::Failed => self.failed += 1,
            State::Cancelled => self.cancelled += 1,
            State::Queued | State::Running => {}
        }
    }
}

impl Board {
    pub(super) fn new(queue: Queue, free: Vec<Seat>, last_life: u64, given_up: HashSet<JobId>) -> Self {
        Self {
            live: HashMap::new(),
            queue,
            running: HashMap::new(),
            free,
            split: (0, 0),
            submitting: BTreeMap::new(),
            given_up,
            deadlines: BTreeSet::new(),
            last_life,
            draining: false,
            closed: false,
            tally: Tally::default(),
        }
    }

    /// The job's entry, if this life of it is its latest.
    pub(super) fn entry(&mut self, id: JobId, life: u64) -> Option<&mut Entry> {
        self.live.get_mut(&id).filter(|entry| entry.life == life)
    }

    /// A free seat and the job to take it. The other lanes are for when the main lane is taken.
    pub(super) fn next(&mut self, now: Instant) -> Option<(Seat, Taken)> {
        [Lane::Main, Lane::Express, Lane::Guest].into_iter().find_map(|lane| {
            let seat = self.free.iter().position(|seat| seat.lane == lane)?;
            let taken = self.next_for(lane, now)?;
            Some((self.free.swap_remove(seat), taken))
        })
    }

    /// One client's jobs never have all seats of the main and the guest lane while others wait: the last of these seats
    /// is for another client, and the guest lane for nobody else.
    fn next_for(&mut self, lane: Lane, now: Instant) -> Option<Taken> {
        let left = self.free.iter().filter(|seat| seat.lane != Lane::Express).count();
        let other = match self.only_client() {
            Some(client) if lane != Lane::Express && left == 1 => self.queue.take_other(&client, now),
            _ => None,
        };
        match lane {
            Lane::Guest => other,
            Lane::Main | Lane::Express => other.or_else(|| self.queue.take(lane, now)),
        }
    }

    /// The client of all jobs on the main and the guest lane, if it is one.
    fn only_client(&self) -> Option<String> {
        let mut runs = self.running.values().filter(|run| run.seat.lane != Lane::Express);
        let client = &runs.next()?.client;
        runs.all(|run| run.client == *client).then(|| client.clone())
    }

    pub(super) fn set_deadline(&mut self, id: JobId, life: u64, deadline: Option<Instant>) {
        let Some(entry) = self.live.get_mut(&id).filter(|entry| entry.life == life) else {
            return;
        };
        if let Some(old) = std::mem::replace(&mut entry.deadline, deadline) {
            self.deadlines.remove(&(old, life, id));
        }
        if let Some(new) = deadline {
            self.deadlines.insert((new, life, id));
        }
    }
}
