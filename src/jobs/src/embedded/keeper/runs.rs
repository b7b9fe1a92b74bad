//! From the queue to the threads and back.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Instant;

use bytes::Bytes;

use super::Keeper;
use super::parts::progressed;
use crate::embedded::board::Board;
use crate::embedded::parts::Parts;
use crate::embedded::queue::{Tag, Taken, Waiting};
use crate::embedded::records::Write;
use crate::job::told_apart;
use crate::moment::now;
use crate::threads::pools::Seat;
use crate::threads::run::{End, Run};
use crate::{JobId, State};

impl Keeper {
    /// Gives the free seats to the jobs that are next.
    pub(super) fn dispatch(self: &Arc<Self>, board: &mut Board) {
        while !board.draining {
            // Before each: a place in the queue has become free, and a part may be the next.
            self.submit_parts(board);
            let Some((seat, taken)) = board.next(Instant::now()) else {
                return;
            };
            self.start(board, seat, taken);
        }
    }

    fn start(self: &Arc<Self>, board: &mut Board, seat: Seat, taken: Taken) {
        let (id, life) = (taken.job.id, taken.life);
        let Some(entry) = board.live.get_mut(&id).filter(|entry| entry.life == life) else {
            // What is queued is live; if not, nobody is there to be told.
            board.free.push(seat);
            return;
        };
        let merges = matches!(entry.parts, Parts::Done);
        let job = entry.feeder.change(|job| {
            job.state = State::Running;
            if !merges {
                job.attempts = job.attempts.saturating_add(1);
                job.started = Some(now());
            }
        });
        let (client, feeder, turn) = (taken.job.client.clone(), entry.feeder.clone(), Arc::clone(&self.turn));
        let run = Arc::new(Run::new((id, life), merges, client, seat, feeder, turn));
        entry.run = Some(Arc::clone(&run));
        board.running.insert(life, Arc::clone(&run));
        let write = Write::Start { life, attempts: job.attempts, started: job.started.unwrap_or_else(now) };
        let keeper = Arc::clone(self);
        let reply = move |result: Result<(), _>| {
            if let Err(fault) = result {
                // It was promised; only a crash in it would not be counted.
                tracing::warn!(%fault, "the start of a job is not recorded");
            }
            keeper.launch(run, taken, job.payload);
        };
        self.recorder.write(write, Box::new(reply));
    }

    /// Not before the start is recorded: a job that brings the process down at once must be known for it.
    fn launch(self: Arc<Self>, run: Arc<Run>, taken: Taken, payload: Bytes) {
        let pool = Arc::clone(&run.seat.pool);
        pool.spawn(move || {
            let end = self.attempt(&run, taken.tag, &payload);
            self.ended(&run, &taken, end);
        });
    }

    fn attempt(&self, run: &Run, tag: Tag, payload: &[u8]) -> End {
        if let Some(told) = run.told() {
            return told.into();
        }
        let work = self.work.as_ref();
        if !run.merges {
            match run.parts(work, payload) {
                Ok(parts) if parts.is_empty() => {}
                Ok(parts) => return End::Split(parts),
                Err(end) => return end,
            }
        }
        self.board.lock().queue.reached(tag);
        self.started.fetch_add(1, Ordering::Relaxed);
        run.run(work, payload, &|| progressed(&mut self.board.lock(), run.id, run.life))
    }

    fn ended(self: &Arc<Self>, run: &Run, taken: &Taken, end: End) {
        let mut board = self.board.lock();
        board.running.remove(&run.life);
        board.free.push(run.seat.clone());
        match (end, run.told()) {
            (End::Split(_), Some(told)) => self.conclude(&mut board, run.id, run.life, told.into()),
            (End::Split(parts), None) => self.split(&mut board, taken, parts),
            (end, _) => self.conclude(&mut board, run.id, run.life, end),
        }
        self.dispatch(&mut board);
        if board.running.is_empty() {
            self.idle.notify_waiters();
        }
    }

    /// Returns when no job runs.
    pub(in crate::embedded) async fn idle(&self) {
        loop {
            let idle = self.idle.notified();
            if self.board.lock().running.is_empty() {
                return;
            }
            idle.await;
        }
    }

    pub(in crate::embedded) fn requeue_all(self: &Arc<Self>) {
        let mut board = self.board.lock();
        for run in board.running.values().cloned().collect::<Vec<_>>() {
            self.conclude(&mut board, run.id, run.life, End::Drained);
        }
    }

    /// Queues a job again that has cost more than it was estimated at.
    pub(super) fn put_back(&self, board: &mut Board, id: JobId, life: u64, cost: f64) {
        let Some(entry) = board.entry(id, life) else {
            return;
        };
        let client = entry.run.as_ref().map(|run| run.client.clone());
        let job = entry.feeder.change(|job| job.cost = told_apart(cost.max(job.cost)));
        tracing::info!(job = %id, cost = job.cost, "a job has cost more than was estimated and is queued again");
        self.requeue(board, id, life);
        let waiting = self.waiting(&job, None);
        let client = client.unwrap_or_else(|| job.client.clone());
        board.queue.push(life, Waiting { client, ..waiting }, None);
    }

    /// As if it had not been begun; only the attempts stay.
    pub(super) fn requeue(&self, board: &mut Board, id: JobId, life: u64) {
        let Some(entry) = board.entry(id, life) else {
            return;
        };
        entry.run = None;
        entry.feeder.change(|job| {
            (job.state, job.progress, job.started) = (State::Queued, 0.0, None);
        });
        self.recorder.write(Write::Requeue { life }, Box::new(drop));
    }
}
