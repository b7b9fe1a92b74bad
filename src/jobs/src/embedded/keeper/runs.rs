//! From the queue to the threads and back.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Instant;

use bytes::Bytes;

use super::Keeper;
use crate::embedded::board::Board;
use crate::embedded::moment::now;
use crate::embedded::pools::Seat;
use crate::embedded::records::Write;
use crate::embedded::run::{End, Run};
use crate::{JobId, State};

impl Keeper {
    /// Gives the free seats to the jobs that are next.
    pub(super) fn dispatch(self: &Arc<Self>, board: &mut Board) {
        while !board.draining
            && let Some((seat, life, id)) = board.next(Instant::now())
        {
            self.start(board, seat, life, id);
        }
    }

    fn start(self: &Arc<Self>, board: &mut Board, seat: Seat, life: u64, id: JobId) {
        let Some(entry) = board.live.get_mut(&id).filter(|entry| entry.life == life) else {
            // What is queued is live; if not, nobody is there to be told.
            board.free.push(seat);
            return;
        };
        let job = entry.feeder.change(|job| {
            job.state = State::Running;
            job.attempts = job.attempts.saturating_add(1);
            job.started = Some(now());
        });
        let run = Arc::new(Run::new(id, life, seat, entry.feeder.clone(), Arc::clone(&self.turn)));
        entry.run = Some(Arc::clone(&run));
        board.running.insert(life, Arc::clone(&run));
        let write = Write::Start { life, attempts: job.attempts, started: job.started.unwrap_or_else(now) };
        let keeper = Arc::clone(self);
        let reply = move |result: Result<(), _>| {
            if let Err(fault) = result {
                // It was promised; only a crash in it would not be counted.
                tracing::warn!(%fault, "the start of a job is not recorded");
            }
            keeper.launch(run, job.payload);
        };
        self.recorder.write(write, Box::new(reply));
    }

    /// Not before the start is recorded: a job that brings the process down at once must be known for it.
    fn launch(self: Arc<Self>, run: Arc<Run>, payload: Bytes) {
        let pool = Arc::clone(&run.seat.pool);
        pool.spawn(move || {
            let end = if let Some(told) = run.told() {
                told.into()
            } else {
                self.started.fetch_add(1, Ordering::Relaxed);
                run.run(self.work.as_ref(), &payload)
            };
            self.ended(&run, end);
        });
    }

    fn ended(self: &Arc<Self>, run: &Run, end: End) {
        let mut board = self.board.lock();
        board.running.remove(&run.life);
        board.free.push(run.seat.clone());
        self.conclude(&mut board, run.id, run.life, end);
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
