//! Runs end: their jobs end too, or return to the queue.

use std::sync::Arc;

use super::Scheduler;
use crate::embedded::job_table::JobTable;
use crate::embedded::queue::QueuedJob;
use crate::embedded::records::record::Write;
use crate::execution::stop::RunEnd;
use crate::job::{Failure, Job, Outcome, cost_after_overrun};
use crate::job_id::JobKey;

impl Scheduler {
    /// Ends a job, or returns it to the queue, as its run has ended.
    pub(super) fn conclude(self: &Arc<Self>, table: &mut JobTable, key: JobKey, end: RunEnd) {
        let is_wanted = table.entry(key).is_some_and(|entry| entry.is_wanted());
        match end {
            RunEnd::Final(outcome) => self.end(table, key, outcome),
            // There is no other process.
            RunEnd::CannotRunHere(reason) => self.end(table, key, Outcome::Failed(Failure::Work(reason))),
            RunEnd::Split(_) => {}
            RunEnd::Overran(cost) if is_wanted => self.requeue_overrun(table, key, cost),
            RunEnd::Drained if is_wanted => drop(self.requeue(table, key, |_| ())),
            RunEnd::Drained | RunEnd::Overran(_) => self.end(table, key, Outcome::Cancelled),
        }
    }

    /// Ends a job that has not ended.
    pub(super) fn end(self: &Arc<Self>, table: &mut JobTable, key: JobKey, outcome: Outcome) {
        table.queue.remove(key.generation);
        self.set_deadline(table, key, None);
        let Some(entry) = table.entry(key).filter(|entry| !entry.job.state().is_final()) else {
            return;
        };
        entry.run = None;
        let job = entry.job.change(|job| job.finish(outcome));
        let parents = std::mem::take(&mut entry.parents);
        table.counts.count_end(job.state);
        let scheduler = Arc::clone(self);
        let reply = move |_| {
            let mut table = scheduler.table.lock();
            if table.entry(key).is_some() {
                table.jobs.remove(&key.id);
            }
        };
        self.writer.write_then(Write::Finish { generation: key.generation, job: job.clone() }, reply);
        self.release_subtasks(table, key);
        self.subtask_ended(table, parents, &job);
    }

    /// Queues a job again that has cost more than its estimate.
    fn requeue_overrun(&self, table: &mut JobTable, key: JobKey, cost: f64) {
        let Some(run) = table.entry(key).and_then(|entry| entry.run.clone()) else {
            return;
        };
        let small = self.config.small_cost;
        let requeued = self.requeue(table, key, |job| job.cost = cost_after_overrun(job.cost, cost, small));
        let Some(job) = requeued else {
            return;
        };
        tracing::info!(job = %key.id, cost = job.cost, "a job cost more than its estimate and is queued again");
        let queued = QueuedJob { client: run.client.clone(), ..self.queued_job(&job, None) };
        table.queue.push(key.generation, queued, None);
    }

    /// Records that a job has not run. The caller puts it into the queue, unless the process closes.
    fn requeue(&self, table: &mut JobTable, key: JobKey, change: impl FnOnce(&mut Job)) -> Option<Job> {
        let entry = table.entry(key)?;
        entry.run = None;
        let job = entry.job.change(|job| {
            change(job);
            job.requeue();
        });
        self.writer.write(Write::Requeue { generation: key.generation });
        Some(job)
    }
}
