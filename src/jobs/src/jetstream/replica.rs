//! This process's copy of all records.

mod entry;
pub(super) mod job_index;

use parking_lot::{Mutex, MutexGuard};
use tokio::sync::{Notify, watch};

use super::record::Record;
use crate::job::Job;
use crate::job_id::{JobId, JobKey};
use crate::job_watch::JobReceiver;
use entry::Entry;
use job_index::JobIndex;

pub(super) use entry::RunState;

#[derive(Default)]
pub(super) struct Replica {
    index: Mutex<JobIndex>,
    /// Notified when a job has ended.
    pub(super) ended: Notify,
}

impl Replica {
    pub(super) fn lock(&self) -> MutexGuard<'_, JobIndex> {
        self.index.lock()
    }

    /// Adds a record unless a later revision is known.
    pub(super) fn apply(&self, record: Record, revision: u64) {
        let is_final = record.job.state.is_final();
        self.lock().apply(record, revision);
        if is_final {
            self.ended.notify_waiters();
        }
    }

    pub(super) fn set_progress(&self, key: JobKey, fraction: f64) {
        if let Some(entry) = self.lock().entry(key) {
            entry.job.set_progress(fraction);
        }
    }

    pub(super) fn read(&self, id: JobId) -> Option<(Record, u64)> {
        self.map(id, |entry| (entry.record.clone(), entry.revision))
    }

    pub(super) fn revision(&self, id: JobId) -> Option<u64> {
        self.map(id, |entry| entry.revision)
    }

    pub(super) fn job(&self, id: JobId) -> Option<Job> {
        self.map(id, |entry| entry.job.job())
    }

    pub(super) fn subscribe(&self, id: JobId) -> Option<JobReceiver> {
        self.map(id, |entry| entry.job.subscribe())
    }

    pub(super) fn run_state(&self, id: JobId) -> Option<watch::Receiver<RunState>> {
        self.map(id, |entry| entry.run_state.subscribe())
    }

    /// Watches one generation of a job.
    pub(super) fn subscribe_to(&self, key: JobKey) -> Option<JobReceiver> {
        self.lock().entry(key).map(|entry| entry.job.subscribe())
    }

    fn map<T>(&self, id: JobId, map: impl FnOnce(&Entry) -> T) -> Option<T> {
        self.lock().entries.get(&id).map(map)
    }

    /// Removes a job if it still has this revision.
    pub(super) fn remove(&self, id: JobId, revision: Option<u64>) {
        let mut index = self.lock();
        if index.entries.get(&id).map(|entry| entry.revision) == revision {
            index.remove(id);
        }
    }

    /// Removes all jobs if a later revision than this is known. Returns whether it is.
    pub(super) fn clear_after(&self, revision: u64) -> bool {
        let mut index = self.lock();
        let is_lost = index.highest_revision > revision;
        if is_lost {
            index.clear();
        }
        is_lost
    }
}

#[cfg(test)]
mod tests {
    use super::Replica;
    use super::job_index::Liveness;
    use crate::jetstream::queue_class::QueueClass;
    use crate::jetstream::record::{Claimant, Record};
    use crate::job::{Outcome, State, Submission};
    use crate::job_id::{JobId, JobKey};

    const ID: JobId = JobId::from_bytes([1; 32]);

    fn record(generation: u64) -> Record {
        let (client, payload) = (String::new(), bytes::Bytes::new());
        let submission = Submission { id: ID, client, cost: 1.0, payload, deadline: None };
        Record::new(generation, submission, QueueClass::Small, Claimant::Process(1), false)
    }

    fn ended(generation: u64) -> Record {
        let mut record = record(generation);
        record.end(Outcome::Succeeded);
        record
    }

    /// The record of the next generation has replaced the end of the first before it arrived here.
    #[test]
    fn a_generation_whose_end_did_not_arrive_continues_in_the_next() {
        let replica = Replica::default();
        let mut running = record(1);
        running.start();
        replica.apply(running, 1);
        let job = replica.subscribe_to(JobKey { id: ID, generation: 1 });
        let state = || job.as_ref().map(|job| job.job().state);
        assert_eq!(state(), Some(State::Running));
        replica.apply(record(2), 3);
        assert_eq!(state(), Some(State::Queued), "not cancelled");
        replica.apply(ended(2), 4);
        assert_eq!(state(), Some(State::Succeeded));
        assert_eq!(replica.lock().counts.cancelled, 0);
    }

    #[test]
    fn a_job_whose_record_did_not_arrive_has_not_ended() {
        let replica = Replica::default();
        let liveness = |generation| replica.lock().liveness(JobKey { id: ID, generation });
        assert_eq!(liveness(2), Liveness::Unknown);
        replica.apply(record(1), 1);
        assert_eq!(liveness(2), Liveness::Active, "its record is still to come");
        replica.apply(record(2), 2);
        assert_eq!((liveness(1), liveness(2)), (Liveness::Ended, Liveness::Active));
        replica.apply(ended(2), 3);
        assert_eq!(liveness(2), Liveness::Ended);
    }
}
