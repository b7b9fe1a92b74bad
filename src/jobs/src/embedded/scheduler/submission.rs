//! Jobs enter the queue.

use std::sync::Arc;
use std::time::{Duration, Instant};

use tokio::sync::watch;

use super::Scheduler;
use super::claims::EmbeddedClaim;
use crate::claim::Claim;
use crate::embedded::job_table::{Entry, JobTable, Recorded};
use crate::embedded::queue::QueuedJob;
use crate::embedded::records::record::{Record, Write};
use crate::embedded::waiting_parent::{SubtaskShare, SubtaskState};
use crate::error::SubmitError;
use crate::execution::stop::StopSignal;
use crate::job::{Job, Submission};
use crate::job_id::JobKey;
use crate::job_watch::JobSender;

impl Scheduler {
    /// Queues the jobs that an earlier process has left. They were accepted, so they are detached.
    pub(crate) fn resume(self: &Arc<Self>, records: Vec<Record>) {
        let mut table = self.table.lock();
        for record in records {
            let (_, recorded) = watch::channel(Some(Ok(())));
            let key = record.key();
            self.enter(&mut table, record, recorded, None);
            if let Some(entry) = table.entry(key) {
                entry.detached = !entry.is_only_subtask;
                if entry.is_only_subtask {
                    // It waits for its parent, which may be cancelled before it submits its subtasks again.
                    table.queue.remove(key.generation);
                }
            }
        }
        self.dispatch(&mut table);
    }

    /// Submits a job. The caller must not pass the claim on before the submission is durable.
    pub(crate) fn submit(self: &Arc<Self>, submission: Submission) -> Result<(Claim, Recorded), SubmitError> {
        let mut table = self.table.lock();
        if table.closed {
            return Err(SubmitError::Draining);
        }
        let id = submission.id;
        table.given_up.remove(&id);
        if let Some(key) = table.active(id) {
            self.join(&mut table, key, &submission, None);
        } else {
            self.check_room(&table, submission.payload.len())?;
            self.begin(&mut table, submission, None);
        }
        // The entry exists: it was joined or started.
        let entry = table.jobs.get_mut(&id).ok_or(SubmitError::Draining)?;
        entry.claims += 1;
        let guard = EmbeddedClaim::new(self, entry.key);
        let claim = Claim::new(entry.job.subscribe(), Box::new(guard));
        let recorded = entry.recorded.clone();
        self.dispatch(&mut table);
        Ok((claim, recorded))
    }

    /// An equal submission joins an active job. `share` is present if it is a subtask's.
    pub(super) fn join(
        &self,
        table: &mut JobTable,
        key: JobKey,
        submission: &Submission,
        share: Option<SubtaskShare>,
    ) {
        let (generation, client) = (key.generation, &submission.client);
        let start = share.map(|share| share.start);
        match table.entry(key) {
            Some(entry) if !entry.is_wanted() => {
                // A subtask that an earlier process has left, and that nobody has submitted since.
                let job = QueuedJob { client: client.clone(), ..self.queued_job(&entry.job.job(), share) };
                table.queue.push(generation, job, start);
            }
            _ => table.queue.join(generation, client, self.is_small(submission.cost, share), start),
        }
        if share.is_none() {
            if let Some(entry) = table.entry(key).filter(|entry| entry.is_only_subtask) {
                entry.is_only_subtask = false;
                self.writer.write(Write::List { generation });
            }
            self.change_clients(table, key, |clients| clients.add(client));
        }
        let Some(deadline) = table.entry(key).and_then(|entry| entry.deadline) else {
            return;
        };
        let later = submission.deadline.and_then(from_now);
        if later.is_none_or(|later| later > deadline) {
            self.set_deadline(table, key, later);
            self.writer.write(Write::SetDeadline { generation, deadline: submission.deadline });
        }
    }

    /// Starts a generation of a job.
    pub(super) fn begin(
        self: &Arc<Self>,
        table: &mut JobTable,
        submission: Submission,
        share: Option<SubtaskShare>,
    ) {
        let id = submission.id;
        // An earlier generation that was told to stop ends here, whenever its run stops.
        let stopping = table.jobs.get(&id).and_then(|entry| Some((entry.key, entry.stop_signal()?)));
        if let Some((key, signal)) = stopping {
            self.conclude(table, key, signal.into());
        }
        table.last_generation += 1;
        let (generation, deadline) = (table.last_generation, submission.deadline);
        let is_only_subtask = share.is_some();
        let job = Job::new(submission, is_only_subtask);
        let record = Record { generation, job, deadline, is_only_subtask };
        let (sender, recorded) = watch::channel(None);
        let scheduler = Arc::clone(self);
        let reply = move |result: Result<(), _>| {
            if result.is_err() {
                scheduler.revoke(JobKey { id, generation });
            }
            sender.send_replace(Some(result));
        };
        self.writer.write_then(Write::Submit(record.clone()), reply);
        self.enter(table, record, recorded, share);
    }

    fn check_room(&self, table: &JobTable, bytes: usize) -> Result<(), SubmitError> {
        let (jobs, queued) = (table.queue.len() + table.waiting, table.queue.bytes() + table.waiting_bytes);
        if jobs < self.config.queue.max(1) && queued.saturating_add(bytes) <= self.config.queue_bytes {
            return Ok(());
        }
        // About as long as the mean job takes, after which the queue has room for one.
        #[expect(clippy::cast_precision_loss, reason = "counts are small")]
        let seconds = table.queue.cost() / (jobs.max(1) * self.config.threads.max(1)) as f64;
        Err(SubmitError::Full { retry_after: Duration::from_secs_f64(seconds.clamp(1.0, 60.0)) })
    }

    fn enter(&self, table: &mut JobTable, record: Record, recorded: Recorded, share: Option<SubtaskShare>) {
        let key = record.key();
        let Record { job, deadline, is_only_subtask, .. } = record;
        let start = share.map(|share| share.start);
        table.queue.push(key.generation, self.queued_job(&job, share), start);
        let entry = Entry {
            key,
            job: JobSender::new(job),
            recorded,
            deadline: None,
            claims: 0,
            detached: false,
            parents: Vec::new(),
            is_only_subtask,
            subtasks: SubtaskState::Unknown,
            run: None,
        };
        table.jobs.insert(key.id, entry);
        self.set_deadline(table, key, deadline.and_then(from_now));
    }

    /// Removes a job whose submission could not be recorded. A subtask continues: a process that reads the records
    /// starts with its parent.
    fn revoke(&self, key: JobKey) {
        let mut table = self.table.lock();
        if table.entry(key).is_some_and(|entry| !entry.parents.is_empty()) {
            return;
        }
        table.queue.remove(key.generation);
        self.set_deadline(&mut table, key, None);
        if table.entry(key).is_some()
            && let Some(run) = table.jobs.remove(&key.id).and_then(|entry| entry.run)
        {
            run.stop(StopSignal::Cancelled);
        }
    }

    pub(super) fn queued_job(&self, job: &Job, share: Option<SubtaskShare>) -> QueuedJob {
        QueuedJob {
            id: job.id,
            client: job.client.clone(),
            cost: job.cost,
            bytes: job.payload.len(),
            is_small: self.is_small(job.cost, share),
            since: Instant::now(),
        }
    }

    pub(super) fn is_small(&self, cost: f64, share: Option<SubtaskShare>) -> bool {
        cost <= self.config.small_cost && share.is_none_or(|share| share.parent_is_small)
    }
}

fn from_now(limit: Duration) -> Option<Instant> {
    Instant::now().checked_add(limit)
}
