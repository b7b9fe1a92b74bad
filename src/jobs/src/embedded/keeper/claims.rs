//! Who wants a job.

use std::sync::{Arc, Weak};

use super::Keeper;
use crate::claim::Interest;
use crate::embedded::board::Board;
use crate::embedded::records::Write;
use crate::threads::run::Told;
use crate::{Clients, Job, JobId};

/// One claim on one life of a job. Does not keep the back end open.
pub(super) struct Stake {
    keeper: Weak<Keeper>,
    id: JobId,
    life: u64,
}

impl Stake {
    pub(super) fn new(keeper: &Arc<Keeper>, id: JobId, life: u64) -> Self {
        Self { keeper: Arc::downgrade(keeper), id, life }
    }
}

impl Interest for Stake {
    fn keep(&self) {
        if let Some(keeper) = self.keeper.upgrade()
            && let Some(entry) = keeper.board.lock().entry(self.id, self.life)
        {
            entry.kept = true;
        }
    }
}

impl Drop for Stake {
    fn drop(&mut self) {
        if let Some(keeper) = self.keeper.upgrade() {
            keeper.release(self.id, self.life);
        }
    }
}

impl Keeper {
    fn release(self: &Arc<Self>, id: JobId, life: u64) {
        let mut board = self.board.lock();
        let Some(entry) = board.entry(id, life) else {
            return;
        };
        entry.claims = entry.claims.saturating_sub(1);
        if !entry.is_wanted() {
            self.stop(&mut board, id, life, Told::Cancelled);
        }
    }

    /// The job after that; `None`: it is not here.
    pub(in crate::embedded) fn cancel(self: &Arc<Self>, id: JobId) -> Option<Job> {
        let mut board = self.board.lock();
        let entry = board.live.get_mut(&id)?;
        (entry.claims, entry.kept) = (0, false);
        let (life, feeder) = (entry.life, entry.feeder.clone());
        self.stop(&mut board, id, life, Told::Cancelled);
        Some(feeder.job())
    }

    /// The job after that; `None`: it is not here.
    pub(in crate::embedded) fn leave(self: &Arc<Self>, id: JobId, client: &str) -> Option<Job> {
        let mut board = self.board.lock();
        let entry = board.live.get_mut(&id)?;
        let (life, feeder) = (entry.life, entry.feeder.clone());
        let job = feeder.job();
        if job.state.is_final() || !job.clients.contains(client) {
            return Some(job);
        }
        let is_last = job.clients.is_only(client);
        if is_last {
            (entry.claims, entry.kept) = (0, false);
        }
        if is_last && !entry.is_wanted() {
            self.stop(&mut board, id, life, Told::Cancelled);
        } else {
            self.change_clients(&mut board, id, life, |clients| clients.leave(client));
        }
        Some(feeder.job())
    }

    /// In memory and in the records.
    pub(super) fn change_clients(
        &self,
        board: &mut Board,
        id: JobId,
        life: u64,
        change: impl FnOnce(&mut Clients) -> bool,
    ) {
        if let Some(entry) = board.entry(id, life)
            && entry.feeder.change_clients(change)
        {
            let clients = entry.feeder.job().clients;
            self.recorder.write(Write::Clients { life, clients }, Box::new(drop));
        }
    }

    /// A queued job ends, a running one is told to.
    pub(super) fn stop(self: &Arc<Self>, board: &mut Board, id: JobId, life: u64, told: Told) {
        match board.entry(id, life).and_then(|entry| entry.run.clone()) {
            Some(run) => run.tell(told),
            None => self.conclude(board, id, life, told.into()),
        }
    }
}
