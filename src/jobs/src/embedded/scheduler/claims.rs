//! Claims on jobs, and the clients that leave them.

use std::sync::{Arc, Weak};

use super::Scheduler;
use crate::claim::ClaimGuard;
use crate::clients::Clients;
use crate::embedded::job_table::JobTable;
use crate::embedded::records::record::Write;
use crate::execution::stop::StopSignal;
use crate::job::Job;
use crate::job_id::{JobId, JobKey};

/// A claim on one generation of a job. It does not keep the back end open.
pub(super) struct EmbeddedClaim {
    scheduler: Weak<Scheduler>,
    key: JobKey,
}

impl EmbeddedClaim {
    pub(super) fn new(scheduler: &Arc<Scheduler>, key: JobKey) -> Self {
        Self { scheduler: Arc::downgrade(scheduler), key }
    }
}

impl ClaimGuard for EmbeddedClaim {
    fn detach(&self) {
        if let Some(scheduler) = self.scheduler.upgrade()
            && let Some(entry) = scheduler.table.lock().entry(self.key)
        {
            entry.detached = true;
        }
    }
}

impl Drop for EmbeddedClaim {
    fn drop(&mut self) {
        if let Some(scheduler) = self.scheduler.upgrade() {
            scheduler.release(self.key);
        }
    }
}

impl Scheduler {
    fn release(self: &Arc<Self>, key: JobKey) {
        let mut table = self.table.lock();
        let Some(entry) = table.entry(key) else {
            return;
        };
        entry.claims = entry.claims.saturating_sub(1);
        if !entry.is_wanted() {
            self.stop(&mut table, key, StopSignal::Cancelled);
        }
    }

    /// Cancels a job and returns it; `None` if it is not in the table.
    pub(crate) fn cancel(self: &Arc<Self>, id: JobId) -> Option<Job> {
        let mut table = self.table.lock();
        let entry = table.jobs.get_mut(&id)?;
        (entry.claims, entry.detached) = (0, false);
        let (key, job) = (entry.key, entry.job.clone());
        self.stop(&mut table, key, StopSignal::Cancelled);
        Some(job.job())
    }

    /// Removes a client from a job and returns the job; `None` if it is not in the table.
    pub(crate) fn leave(self: &Arc<Self>, id: JobId, client: &str) -> Option<Job> {
        let mut table = self.table.lock();
        let entry = table.jobs.get_mut(&id)?;
        let (key, sender) = (entry.key, entry.job.clone());
        let job = sender.job();
        if job.state.is_final() || !job.clients.contains(client) {
            return Some(job);
        }
        let is_last = job.clients.is_only(client);
        if is_last {
            (entry.claims, entry.detached) = (0, false);
        }
        if is_last && !entry.is_wanted() {
            self.stop(&mut table, key, StopSignal::Cancelled);
        } else {
            self.change_clients(&mut table, key, |clients| clients.remove(client));
        }
        Some(sender.job())
    }

    /// Changes a job's clients in memory and in its record.
    pub(super) fn change_clients(
        &self,
        table: &mut JobTable,
        key: JobKey,
        change: impl FnOnce(&mut Clients) -> bool,
    ) {
        if let Some(entry) = table.entry(key)
            && entry.job.change_clients(change)
        {
            let clients = entry.job.job().clients;
            self.writer.write(Write::SetClients { generation: key.generation, clients });
        }
    }

    /// Ends a queued job, or tells the run of a running one to stop.
    pub(super) fn stop(self: &Arc<Self>, table: &mut JobTable, key: JobKey, signal: StopSignal) {
        match table.entry(key).and_then(|entry| entry.run.clone()) {
            Some(run) => run.stop(signal),
            None => self.conclude(table, key, signal.into()),
        }
    }
}
