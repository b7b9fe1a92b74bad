//! Jobs leave the queue for a slot, and the slot when they have run.

use std::sync::Arc;
use std::time::Instant;

use bytes::Bytes;

use super::Scheduler;
use crate::embedded::job_table::JobTable;
use crate::embedded::queue::DequeuedJob;
use crate::embedded::records::record::Write;
use crate::embedded::waiting_parent::SubtaskState;
use crate::execution::run::Run;
use crate::execution::slot::Slot;
use crate::execution::stop::{RunEnd, StopSignal};
use crate::job::State;
use crate::job_id::JobKey;
use crate::timestamp::now;

impl Scheduler {
    /// Starts the next jobs in the free slots.
    pub(super) fn dispatch(self: &Arc<Self>, table: &mut JobTable) {
        while !table.closed {
            // Before each job: the queue has room again, and a subtask may be the next.
            self.submit_subtasks(table);
            let Some((slot, job)) = table.next(Instant::now()) else {
                return;
            };
            self.start(table, slot, job);
        }
    }

    fn start(self: &Arc<Self>, table: &mut JobTable, slot: Slot, dequeued: DequeuedJob) {
        let key = JobKey { id: dequeued.job.id, generation: dequeued.generation };
        let Some(entry) = table.entry(key) else {
            // Every queued job has an entry; without one nobody waits for it.
            table.free_slots.push(slot);
            return;
        };
        let merges = matches!(entry.subtasks, SubtaskState::Finished);
        let job = entry.job.change(|job| if merges { job.state = State::Running } else { job.start() });
        let (client, preemption) = (dequeued.job.client.clone(), Arc::clone(&self.preemption));
        let run = Arc::new(Run::new(key, merges, client, slot, entry.job.clone(), preemption));
        entry.run = Some(Arc::clone(&run));
        table.running.insert(key.generation, Arc::clone(&run));
        let (attempts, started) = (job.attempts, job.started.unwrap_or_else(now));
        let write = Write::Start { generation: key.generation, attempts, started };
        let scheduler = Arc::clone(self);
        self.writer.write_then(write, move |result| {
            if let Err(error) = result {
                // The job was accepted, so it runs. Without this record a crash in it would not count.
                tracing::warn!(%error, "the start of a job is not recorded");
            }
            scheduler.launch(run, dequeued, job.payload);
        });
    }

    /// Runs a job whose start is recorded. If the run kills the process at once, the record shows that it was running.
    fn launch(self: Arc<Self>, run: Arc<Run>, dequeued: DequeuedJob, payload: Bytes) {
        let pool = Arc::clone(&run.slot.pool);
        pool.spawn(move || {
            let before_run = || {
                let mut table = self.table.lock();
                table.queue.advance(dequeued.tag);
                table.counts.started += 1;
            };
            let on_progress = || self.table.lock().propagate_progress(run.key);
            let end = run.execute(self.work.as_ref(), &payload, before_run, &on_progress);
            self.run_ended(&run, &dequeued, end);
        });
    }

    fn run_ended(self: &Arc<Self>, run: &Run, dequeued: &DequeuedJob, end: RunEnd) {
        let mut table = self.table.lock();
        table.running.remove(&run.key.generation);
        table.free_slots.push(run.slot.clone());
        match (end, run.stop_signal()) {
            (RunEnd::Split(_), Some(signal)) => self.conclude(&mut table, run.key, signal.into()),
            (RunEnd::Split(subtasks), None) => self.split(&mut table, run.key, dequeued, subtasks),
            (end, _) => self.conclude(&mut table, run.key, end),
        }
        self.dispatch(&mut table);
        if table.running.is_empty() {
            self.idle.notify_waiters();
        }
    }

    /// Returns when no job runs.
    pub(crate) async fn wait_until_idle(&self) {
        loop {
            let idle = self.idle.notified();
            if self.table.lock().running.is_empty() {
                return;
            }
            idle.await;
        }
    }

    /// Accepts and starts no more jobs, and tells the running ones to stop.
    pub(crate) fn close(&self) {
        let mut table = self.table.lock();
        table.closed = true;
        self.deadlines.notify_one();
        table.running.values().for_each(|run| run.stop(StopSignal::Drained));
    }

    /// Records the jobs whose runs have not stopped as queued.
    pub(crate) fn requeue_running(self: &Arc<Self>) {
        let mut table = self.table.lock();
        for run in table.running.values().cloned().collect::<Vec<_>>() {
            self.conclude(&mut table, run.key, RunEnd::Drained);
        }
    }
}
