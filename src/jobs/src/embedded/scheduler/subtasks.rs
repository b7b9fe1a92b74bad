//! Parents submit their subtasks, wait for them and merge their results.

use std::sync::Arc;
use std::time::Instant;

use super::Scheduler;
use crate::embedded::job_table::JobTable;
use crate::embedded::queue::{DequeuedJob, QueuedJob};
use crate::embedded::records::record::Write;
use crate::embedded::waiting_parent::{SubtaskState, WaitingParent};
use crate::execution::stop::StopSignal;
use crate::job::{Failure, Job, Outcome, Submission};
use crate::job_id::{JobId, JobKey};
use crate::subtasks::{MERGE_FRACTION, Subtasks};

impl Scheduler {
    /// The job has left its slot. It waits until its subtasks have ended.
    pub(super) fn split(
        self: &Arc<Self>,
        table: &mut JobTable,
        key: JobKey,
        parent: &DequeuedJob,
        submissions: Vec<Submission>,
    ) {
        // A subtask that had too many attempts would kill process after process if each attempt of its parent started
        // it.
        let given_up = submissions.iter().any(|subtask| table.given_up.remove(&subtask.id));
        let subtasks = match Subtasks::new(key.id, submissions) {
            Ok(_) if given_up => Err(Failure::TooManyAttempts),
            subtasks => subtasks,
        };
        match subtasks {
            Err(failure) => self.end(table, key, Outcome::Failed(failure)),
            Ok(subtasks) if table.entry(key).is_some_and(|entry| !entry.job.state().is_final()) => {
                table.start_waiting(key, WaitingParent::new(subtasks, parent));
                self.writer.write(Write::Wait { generation: key.generation });
            }
            Ok(_) => {}
        }
    }

    /// Submits subtasks while the queue has room, those of the oldest job first. Jobs that wait for their subtasks take
    /// no room from them.
    pub(super) fn submit_subtasks(self: &Arc<Self>, table: &mut JobTable) {
        while table.queue.len() < self.config.queue.max(1)
            && table.queue.bytes() <= self.config.queue_bytes
            && let Some((generation, id)) = table.submitting.first_key_value().map(|(key, id)| (*key, *id))
        {
            let parent = JobKey { id, generation };
            let next = table.waiting_parent(parent).and_then(|waiting| waiting.subtasks.open_next());
            match next {
                Some(subtask) => self.submit_subtask(table, parent, subtask),
                None => drop(table.submitting.remove(&generation)),
            }
        }
    }

    fn submit_subtask(self: &Arc<Self>, table: &mut JobTable, parent: JobKey, mut subtask: Submission) {
        let Some(waiting) = table.waiting_parent(parent) else {
            return;
        };
        let id = subtask.id;
        subtask.client.clone_from(&waiting.client);
        let share = waiting.next_share(subtask.cost);
        match table.active(id) {
            Some(key) => self.join(table, key, &subtask, Some(share)),
            None => self.begin(table, subtask, Some(share)),
        }
        if let Some(entry) = table.jobs.get_mut(&id) {
            entry.parents.push(parent);
            let key = entry.key;
            table.propagate_progress(key);
        }
    }

    /// A subtask has ended: its parents continue or end.
    pub(super) fn subtask_ended(self: &Arc<Self>, table: &mut JobTable, parents: Vec<JobKey>, subtask: &Job) {
        for parent in parents {
            match subtask.parent_outcome() {
                None => self.subtask_succeeded(table, parent, subtask.id),
                Some(outcome) => self.end(table, parent, outcome),
            }
        }
    }

    fn subtask_succeeded(&self, table: &mut JobTable, parent: JobKey, subtask: JobId) {
        let Some(waiting) = table.waiting_parent(parent) else {
            return;
        };
        let progress = waiting.subtasks.succeeded(subtask);
        let (has_pending, are_finished) = (waiting.subtasks.has_pending(), waiting.subtasks.are_finished());
        table.set_progress(parent, progress);
        if has_pending {
            table.submitting.insert(parent.generation, parent.id);
        } else if are_finished {
            self.queue_merge(table, parent);
        }
    }

    fn queue_merge(&self, table: &mut JobTable, key: JobKey) {
        let Some(WaitingParent { client, bytes, .. }) = table.stop_waiting(key, SubtaskState::Finished)
        else {
            return;
        };
        if let Some(entry) = table.entry(key) {
            let cost = MERGE_FRACTION * entry.job.job().cost;
            let (is_small, since) = (self.is_small(cost, None), Instant::now());
            let job = QueuedJob { id: key.id, client, cost, bytes, is_small, since };
            table.queue.push_front(key.generation, job);
        }
    }

    /// The job has ended: its open subtasks end too, unless others want them.
    pub(super) fn release_subtasks(self: &Arc<Self>, table: &mut JobTable, parent: JobKey) {
        let Some(waiting) = table.stop_waiting(parent, SubtaskState::Unknown) else {
            return;
        };
        for subtask in waiting.subtasks.into_open() {
            let Some(entry) = table.jobs.get_mut(&subtask) else {
                continue;
            };
            entry.parents.retain(|other| *other != parent);
            let (key, is_wanted) = (entry.key, entry.is_wanted());
            if !is_wanted {
                self.stop(table, key, StopSignal::Cancelled);
            }
        }
    }
}
