//! One attempt at a job.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use bytes::Bytes;
use serde::{Deserialize, Serialize};

use super::pools::{Lane, Seat};
use super::turn::Turn;
use crate::feed::Feeder;
use crate::{Failure, JobId, Stop, Submission, Watch, Work};

/// A job may hold the express lane for so many times as long as it was estimated at, seconds; of a shorter estimate than
/// the second number that is too little.
const OVERRUN: f64 = 5.0;
const SHORTEST: f64 = 0.2;

/// Part of a job's progress, and of its cost, that the merge of its parts has.
pub(crate) const MERGE: f64 = 0.05;

/// Why a run was told to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Told {
    Cancelled,
    DeadlinePassed,
    /// To be run again by whoever opens the back end next.
    Drained,
    /// It held the express lane for too long.
    Overran,
}

/// How a job ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    Succeeded,
    Failed(Failure),
    Cancelled,
}

/// How a run ended.
#[derive(Clone, Debug)]
pub(crate) enum End {
    /// With its job.
    Final(Outcome),
    /// Its job is to be merged from these.
    Split(Vec<Submission>),
    Drained,
    /// It is to be queued again as what it has shown itself to cost, seconds of one core.
    Overran(f64),
    /// It is left to others; the reason if nobody can do it.
    Elsewhere(Bytes),
}

impl From<Told> for End {
    fn from(told: Told) -> Self {
        match told {
            Told::Cancelled => Self::Final(Outcome::Cancelled),
            Told::DeadlinePassed => Self::Final(Outcome::Failed(Failure::DeadlinePassed)),
            // Only a run that has begun knows how long it took.
            Told::Drained | Told::Overran => Self::Drained,
        }
    }
}

pub(crate) struct Run {
    pub(crate) id: JobId,
    pub(crate) life: u64,
    /// The job's parts are there.
    pub(crate) merges: bool,
    /// To whom it is charged.
    pub(crate) client: String,
    pub(crate) seat: Seat,
    feeder: Feeder,
    turn: Arc<Turn>,
    told: OnceLock<Told>,
    began: Instant,
    /// How long it may hold the express lane.
    longest: Duration,
    /// When each thread last rested, nanoseconds after the beginning.
    rested: Box<[AtomicU64]>,
}

impl Run {
    pub(crate) fn new(
        job: (JobId, u64),
        merges: bool,
        client: String,
        seat: Seat,
        feeder: Feeder,
        turn: Arc<Turn>,
    ) -> Self {
        let (id, life) = job;
        let rested = (0..seat.pool.current_num_threads()).map(|_| AtomicU64::new(0)).collect();
        let (told, began) = (OnceLock::new(), Instant::now());
        let cost = feeder.job().cost * if merges { MERGE } else { 1.0 };
        let longest = Duration::try_from_secs_f64(OVERRUN * cost.max(SHORTEST)).unwrap_or(Duration::MAX);
        Self { id, life, merges, client, seat, feeder, turn, told, began, longest, rested }
    }

    /// The first to tell is heard.
    pub(crate) fn tell(&self, told: Told) {
        if self.told.set(told).is_ok() {
            self.turn.wake();
        }
    }

    pub(crate) fn told(&self) -> Option<Told> {
        self.told.get().copied()
    }

    /// Called on the seat's pool.
    pub(crate) fn parts(&self, work: &dyn Work, payload: &[u8]) -> Result<Vec<Submission>, End> {
        self.guarded(|| work.parts(&self.id, payload))
    }

    /// Called on the seat's pool. Calls `further` on any of its threads after progress that shows.
    pub(crate) fn run(&self, work: &dyn Work, payload: &[u8], further: &(dyn Fn() + Sync)) -> End {
        let threads = self.seat.pool.current_num_threads();
        let _beside = (self.seat.lane != Lane::Main).then(|| self.turn.beside(threads));
        let watched = Watched { run: self, further };
        match self.guarded(|| work.run(&self.id, payload, &watched)) {
            Ok(()) => End::Final(Outcome::Succeeded),
            Err(end) => end,
        }
    }

    fn guarded<T>(&self, call: impl FnOnce() -> Result<T, Stop>) -> Result<T, End> {
        let outcome = match (catch_unwind(AssertUnwindSafe(call)), self.told()) {
            (Ok(Ok(value)), _) => return Ok(value),
            (Err(panic), _) => Outcome::Failed(Failure::Panicked(message(panic.as_ref()))),
            (Ok(Err(_)), Some(Told::Overran)) => {
                return Err(End::Overran(self.began.elapsed().as_secs_f64()));
            }
            (Ok(Err(_)), Some(told)) => return Err(told.into()),
            (Ok(Err(Stop::Cancelled)), None) => Outcome::Cancelled,
            (Ok(Err(Stop::Failed(reason))), None) => Outcome::Failed(Failure::Work(reason)),
            (Ok(Err(Stop::Elsewhere(reason))), None) => return Err(End::Elsewhere(reason)),
        };
        Err(End::Final(outcome))
    }

    /// Whether to stop; a thread of the main lane may rest before it is told. A job that holds the express lane for too
    /// long is told to stop here.
    fn look(&self) -> bool {
        match self.seat.lane {
            Lane::Main if self.turn.is_shared() => self.let_pass(),
            Lane::Express if self.began.elapsed() > self.longest => self.tell(Told::Overran),
            Lane::Main | Lane::Express | Lane::Guest => {}
        }
        self.told().is_some()
    }

    /// A thread rests at most as long as it has worked since it last rested, so a job has at least half of its time.
    fn let_pass(&self) {
        let Some(rested) = rayon::current_thread_index().and_then(|thread| self.rested.get(thread)) else {
            return;
        };
        let worked =
            self.began.elapsed().saturating_sub(Duration::from_nanos(rested.load(Ordering::Relaxed)));
        if self.turn.rest(worked, || self.told().is_some()) {
            let now = u64::try_from(self.began.elapsed().as_nanos()).unwrap_or(u64::MAX);
            rested.store(now, Ordering::Relaxed);
        }
    }
}

/// What the work sees of its run.
struct Watched<'a> {
    run: &'a Run,
    further: &'a (dyn Fn() + Sync),
}

impl Watch for Watched<'_> {
    fn progress(&self, part: f64) {
        let whole = if self.run.merges { 1.0 - MERGE * (1.0 - part) } else { part };
        if self.run.feeder.progress(whole) {
            (self.further)();
        }
    }

    fn cancelled(&self) -> bool {
        self.run.look()
    }
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threads::pools::seats;
    use crate::{Job, State};

    fn run(lane: Lane, turn: &Arc<Turn>) -> Run {
        let id = JobId::from_bytes([0; 32]);
        let created = std::time::SystemTime::UNIX_EPOCH;
        let job = Job {
            id,
            client: String::new(),
            clients: crate::Clients::default(),
            cost: 1.0,
            payload: bytes::Bytes::new(),
            state: State::Running,
            progress: 0.0,
            created,
            started: Some(created),
            finished: None,
            attempts: 1,
            failure: None,
        };
        let seat = seats(1, 1, 0).into_iter().flatten().find(|seat| seat.lane == lane);
        #[expect(clippy::unwrap_used, reason = "test")]
        let seat = seat.unwrap();
        Run::new((id, 1), false, String::new(), seat, Feeder::new(job), Arc::clone(turn))
    }

    fn rests(run: &Run) -> bool {
        run.rested.iter().any(|rested| rested.load(Ordering::Relaxed) > 0)
    }

    #[test]
    fn a_long_job_rests_while_a_small_one_runs() {
        let turn = Arc::new(Turn::default());
        let (long, small) = (run(Lane::Main, &turn), run(Lane::Express, &turn));
        long.seat.pool.install(|| assert!(!long.look()));
        assert!(!rests(&long));
        let beside = turn.beside(1);
        long.seat.pool.install(|| assert!(!long.look()));
        assert!(rests(&long));
        small.seat.pool.install(|| assert!(!small.look()));
        assert!(!rests(&small));
        drop(beside);
    }
}
