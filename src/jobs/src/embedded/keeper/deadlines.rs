//! Jobs whose answer comes too late for who asked.

use std::sync::Arc;
use std::time::Instant;

use super::Keeper;
use crate::JobId;
use crate::embedded::board::Board;
use crate::threads::run::Told;

impl Keeper {
    pub(super) fn set_deadline(&self, board: &mut Board, id: JobId, life: u64, deadline: Option<Instant>) {
        board.set_deadline(id, life, deadline);
        if deadline.is_some() {
            self.deadlines.notify_one();
        }
    }

    /// Stops what is too late, until the back end is closed. Has a thread of its own.
    pub(in crate::embedded) fn watch_deadlines(self: &Arc<Self>) {
        let mut board = self.board.lock();
        while !board.closed {
            match board.deadlines.first().copied() {
                Some((deadline, life, id)) if deadline <= Instant::now() => {
                    self.set_deadline(&mut board, id, life, None);
                    self.stop(&mut board, id, life, Told::DeadlinePassed);
                }
                Some((deadline, ..)) => drop(self.deadlines.wait_until(&mut board, deadline)),
                None => self.deadlines.wait(&mut board),
            }
        }
    }

    pub(in crate::embedded) fn close(&self, board: &mut Board) {
        board.draining = true;
        board.closed = true;
        self.deadlines.notify_one();
    }
}
