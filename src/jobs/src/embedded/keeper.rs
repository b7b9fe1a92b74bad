//! The life of each job. All that concerns one job is decided, and its record asked for, under one lock; so the records
//! are written in the order of what happened.

mod claims;
mod deadlines;
mod parts;
mod runs;

use std::sync::Arc;
use std::sync::atomic::AtomicU64;
use std::time::{Duration, Instant};

use parking_lot::{Condvar, Mutex};
use tokio::sync::{Notify, watch};

use super::Config;
use super::board::{Board, Entry, Recorded};
use super::parts::Parts;
use super::queue::{Tag, Waiting};
use super::recorder::Recorder;
use super::records::{Record, Write};
use crate::feed::Feeder;
use crate::job::{finish, queued};
use crate::threads::run::{End, Outcome, Told};
use crate::threads::turn::Turn;
use crate::{Claim, Failure, Job, JobId, Submission, SubmitError, Work};
use claims::Stake;

pub(super) struct Keeper {
    pub(super) board: Mutex<Board>,
    pub(super) recorder: Recorder,
    pub(super) config: Config,
    pub(super) started: AtomicU64,
    /// Notified when no run is left.
    pub(super) idle: Notify,
    work: Arc<dyn Work>,
    turn: Arc<Turn>,
    /// Notified when there is a deadline to look at.
    deadlines: Condvar,
}

/// What a part is of its whole.
#[derive(Clone, Copy)]
struct Portion {
    /// Where its share begins.
    begins: Tag,
    of_small: bool,
}

impl Keeper {
    pub(super) fn new(board: Board, recorder: Recorder, config: Config, work: Arc<dyn Work>) -> Self {
        Self {
            board: Mutex::new(board),
            recorder,
            config,
            started: AtomicU64::new(0),
            idle: Notify::new(),
            work,
            turn: Arc::default(),
            deadlines: Condvar::new(),
        }
    }

    /// Takes over jobs that an earlier process left. They were promised, so they are kept; of parts, the wholes will ask
    /// for them.
    pub(super) fn resume(self: &Arc<Self>, records: Vec<Record>) {
        let mut board = self.board.lock();
        for record in records {
            let (_, recorded) = watch::channel(Some(Ok(())));
            let (id, life) = (record.job.id, record.life);
            self.enter(&mut board, record, recorded, None);
            if let Some(entry) = board.entry(id, life) {
                entry.kept = !entry.hidden;
                if entry.hidden {
                    // Only a part: it waits for its whole, which may be cancelled before it asks for it again.
                    board.queue.remove(life);
                }
            }
        }
        self.dispatch(&mut board);
    }

    /// The claim, to be given away when the submission is durable.
    pub(super) fn submit(self: &Arc<Self>, submission: Submission) -> Result<(Claim, Recorded), SubmitError> {
        let mut board = self.board.lock();
        if board.draining {
            return Err(SubmitError::Draining);
        }
        let id = submission.id;
        board.given_up.remove(&id);
        match board.live.get(&id) {
            Some(entry) if entry.goes_on() => {
                let life = entry.life;
                self.join(&mut board, life, &submission, None);
            }
            _ => {
                self.check_room(&board, submission.payload.len())?;
                self.begin(&mut board, submission, None);
            }
        }
        // It is there, joined or begun.
        let entry = board.live.get_mut(&id).ok_or(SubmitError::Draining)?;
        entry.claims += 1;
        let stake = Stake::new(self, id, entry.life);
        let claim = Claim::new(entry.feeder.subscribe(), Box::new(stake));
        let recorded = entry.recorded.clone();
        self.dispatch(&mut board);
        Ok((claim, recorded))
    }

    /// `part`: as one.
    fn join(&self, board: &mut Board, life: u64, submission: &Submission, part: Option<Portion>) {
        let begins = part.map(|part| part.begins);
        if let Some(entry) = board.entry(submission.id, life).filter(|entry| !entry.is_wanted()) {
            // An earlier process left it, and nobody has asked for it since.
            let client = submission.client.clone();
            let waiting = Waiting { client, ..self.waiting(&entry.feeder.job(), part) };
            board.queue.push(life, waiting, begins);
        } else {
            board.queue.join(life, &submission.client, self.is_small(submission.cost, part), begins);
        }
        if let Some(entry) = board.entry(submission.id, life)
            && entry.hidden
            && part.is_none()
        {
            entry.hidden = false;
            self.recorder.write(Write::Show { life }, Box::new(drop));
        }
        if part.is_none() {
            self.change_clients(board, submission.id, life, |clients| clients.join(&submission.client));
        }
        let Some(deadline) = board.entry(submission.id, life).and_then(|entry| entry.deadline) else {
            return;
        };
        match submission.deadline.and_then(from_now) {
            Some(later) if later <= deadline => {}
            later => {
                self.set_deadline(board, submission.id, life, later);
                let write = Write::Postpone { life, deadline: submission.deadline };
                self.recorder.write(write, Box::new(drop));
            }
        }
    }

    fn begin(self: &Arc<Self>, board: &mut Board, submission: Submission, part: Option<Portion>) {
        let id = submission.id;
        // An earlier life that has been told to stop ends here, whenever its run does.
        if let Some((life, told)) =
            board.live.get(&id).and_then(|entry| entry.told().map(|told| (entry.life, told)))
        {
            self.conclude(board, id, life, told.into());
        }
        board.last_life += 1;
        let life = board.last_life;
        let hidden = part.is_some();
        let deadline = submission.deadline;
        let record = Record { life, deadline, hidden, job: queued(submission, hidden) };
        let (sender, recorded) = watch::channel(None);
        let keeper = Arc::clone(self);
        let reply = move |result: Result<(), _>| {
            if result.is_err() {
                keeper.refuse(id, life);
            }
            sender.send_replace(Some(result));
        };
        self.recorder.write(Write::Submit(record.clone()), Box::new(reply));
        self.enter(board, record, recorded, part);
    }

    fn check_room(&self, board: &Board, bytes: usize) -> Result<(), SubmitError> {
        let (jobs, queued) = (board.queue.len() + board.split.0, board.queue.bytes() + board.split.1);
        if jobs < self.config.queue.max(1) && queued.saturating_add(bytes) <= self.config.queue_bytes {
            return Ok(());
        }
        // About as long as the mean job takes, after which one place is free.
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        let seconds = board.queue.cost() / (jobs.max(1) * self.config.threads.max(1)) as f64;
        Err(SubmitError::Full { retry_after: Duration::from_secs_f64(seconds.clamp(1.0, 60.0)) })
    }

    /// Those that wait for their parts do not keep the parts from the queue.
    fn has_room_for_part(&self, board: &Board) -> bool {
        board.queue.len() < self.config.queue.max(1) && board.queue.bytes() <= self.config.queue_bytes
    }

    fn enter(&self, board: &mut Board, record: Record, recorded: Recorded, part: Option<Portion>) {
        let Record { life, job, deadline, hidden } = record;
        let id = job.id;
        board.queue.push(life, self.waiting(&job, part), part.map(|part| part.begins));
        let entry = Entry {
            life,
            feeder: Feeder::new(job),
            recorded,
            deadline: None,
            claims: 0,
            kept: false,
            parents: Vec::new(),
            hidden,
            parts: Parts::Unknown,
            run: None,
        };
        board.live.insert(id, entry);
        self.set_deadline(board, id, life, deadline.and_then(from_now));
    }

    /// The submission could not be recorded: it has never been. A part goes on: whoever reads the records begins with the
    /// whole.
    fn refuse(&self, id: JobId, life: u64) {
        let mut board = self.board.lock();
        if board.entry(id, life).is_some_and(|entry| !entry.parents.is_empty()) {
            return;
        }
        board.queue.remove(life);
        self.set_deadline(&mut board, id, life, None);
        if board.entry(id, life).is_some()
            && let Some(run) = board.live.remove(&id).and_then(|entry| entry.run)
        {
            run.tell(Told::Cancelled);
        }
    }

    fn waiting(&self, job: &Job, part: Option<Portion>) -> Waiting {
        let (id, client, cost, bytes) = (job.id, job.client.clone(), job.cost, job.payload.len());
        let is_small = self.is_small(cost, part);
        Waiting { id, client, cost, bytes, is_small, since: Instant::now() }
    }

    fn is_small(&self, cost: f64, part: Option<Portion>) -> bool {
        cost <= self.config.small && part.is_none_or(|part| part.of_small)
    }

    fn conclude(self: &Arc<Self>, board: &mut Board, id: JobId, life: u64, end: End) {
        match end {
            End::Final(outcome) => self.end(board, id, life, outcome),
            // There is no other process.
            End::Elsewhere(reason) => self.end(board, id, life, Outcome::Failed(Failure::Work(reason))),
            End::Split(_) => {}
            End::Overran(cost) if board.entry(id, life).is_some_and(|entry| entry.is_wanted()) => {
                self.put_back(board, id, life, cost);
            }
            End::Drained if board.entry(id, life).is_some_and(|entry| entry.is_wanted()) => {
                self.requeue(board, id, life);
            }
            End::Drained | End::Overran(_) => self.end(board, id, life, Outcome::Cancelled),
        }
    }

    /// Ends a life; an end that is there already stays.
    fn end(self: &Arc<Self>, board: &mut Board, id: JobId, life: u64, outcome: Outcome) {
        board.queue.remove(life);
        self.set_deadline(board, id, life, None);
        let Some(entry) = board.entry(id, life).filter(|entry| !entry.feeder.state().is_final()) else {
            return;
        };
        entry.run = None;
        let job = entry.feeder.change(|job| finish(job, outcome));
        let parents = std::mem::take(&mut entry.parents);
        board.tally.count(job.state);
        let keeper = Arc::clone(self);
        let reply = move |_: Result<(), _>| {
            let mut board = keeper.board.lock();
            if board.entry(id, life).is_some() {
                board.live.remove(&id);
            }
        };
        self.recorder.write(Write::Finish { life, job: job.clone() }, Box::new(reply));
        self.release_parts(board, id, life);
        self.part_ended(board, parents, &job);
    }
}

fn from_now(limit: Duration) -> Option<Instant> {
    Instant::now().checked_add(limit)
}
