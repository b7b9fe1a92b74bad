//! All records, as far as this process has heard of them.

mod board;
mod entry;

use parking_lot::{Mutex, MutexGuard};
use tokio::sync::{Notify, watch};

use super::record::Record;
use crate::feed::Feed;
use crate::{Job, JobId};

pub(super) use board::{Board, Fate};
pub(super) use entry::Signal;

#[derive(Default)]
pub(super) struct Mirror {
    board: Mutex<Board>,
    /// Notified when a job has ended.
    pub(super) ended: Notify,
}

impl Mirror {
    pub(super) fn lock(&self) -> MutexGuard<'_, Board> {
        self.board.lock()
    }

    /// Takes in what was written, unless something later is known.
    pub(super) fn apply(&self, record: Record, revision: u64) {
        let is_final = record.job.state.is_final();
        self.lock().apply(record, revision);
        if is_final {
            self.ended.notify_waiters();
        }
    }

    pub(super) fn progress(&self, id: JobId, life: u64, part: f64) {
        if let Some(entry) = self.lock().entries.get(&id).filter(|entry| entry.record.life == life) {
            entry.feeder.progress(part);
        }
    }

    pub(super) fn read(&self, id: JobId) -> Option<(Record, u64)> {
        self.lock().entries.get(&id).map(|entry| (entry.record.clone(), entry.revision))
    }

    pub(super) fn revision(&self, id: JobId) -> Option<u64> {
        self.lock().entries.get(&id).map(|entry| entry.revision)
    }

    /// Forgets a job, unless more has been heard of it since this revision.
    pub(super) fn remove(&self, id: JobId, revision: Option<u64>) {
        let mut board = self.lock();
        if board.entries.get(&id).map(|entry| entry.revision) == revision {
            board.remove(id);
        }
    }

    /// Forgets all if something later than this revision was heard of; whether it was.
    pub(super) fn begin_anew_after(&self, revision: u64) -> bool {
        let mut board = self.lock();
        let lost = board.highest > revision;
        if lost {
            board.begin_anew();
        }
        lost
    }

    pub(super) fn job(&self, id: JobId) -> Option<Job> {
        self.lock().entries.get(&id).map(|entry| entry.feeder.job())
    }

    /// Of this life of the job.
    pub(super) fn feed(&self, id: JobId, life: u64) -> Option<Feed> {
        let board = self.lock();
        let entry = board.entries.get(&id).filter(|entry| entry.record.life == life);
        entry.map(|entry| entry.feeder.subscribe())
    }

    pub(super) fn signal(&self, id: JobId) -> Option<watch::Receiver<Signal>> {
        self.lock().entries.get(&id).map(|entry| entry.signal.subscribe())
    }
}

#[cfg(test)]
mod tests {
    use super::{Fate, Mirror};
    use crate::jetstream::bus::Line;
    use crate::jetstream::record::{Claimant, Record};
    use crate::threads::run::Outcome;
    use crate::{JobId, State, Submission};

    fn record(life: u64) -> Record {
        let submission = Submission {
            id: JobId::from_bytes([1; 32]),
            client: String::new(),
            cost: 1.0,
            payload: bytes::Bytes::new(),
            deadline: None,
        };
        Record::new(life, submission, Line::Small, Claimant::Process(1), false)
    }

    /// Its end was written over by the next beginning before this process heard of it.
    #[test]
    fn a_life_whose_end_was_not_heard_of_goes_on_in_the_next() {
        let (mirror, id) = (Mirror::default(), JobId::from_bytes([1; 32]));
        let mut running = record(1);
        running.begin();
        mirror.apply(running.clone(), 1);
        let waiting = mirror.feed(id, 1).map(|feed| feed.job().state);
        assert_eq!(waiting, Some(State::Running));
        let feed = mirror.feed(id, 1);
        mirror.apply(record(2), 3);
        assert_eq!(feed.as_ref().map(|feed| feed.job().state), Some(State::Queued), "not cancelled");
        let mut ended = record(2);
        ended.end(Outcome::Succeeded);
        mirror.apply(ended, 4);
        assert_eq!(feed.map(|feed| feed.job().state), Some(State::Succeeded));
        assert_eq!(mirror.lock().counts.cancelled, 0);
    }

    #[test]
    fn what_is_not_heard_of_has_not_ended() {
        let mirror = Mirror::default();
        let fate = |life| mirror.lock().fate(JobId::from_bytes([1; 32]), life);
        assert_eq!(fate(2), Fate::Unheard);
        mirror.apply(record(1), 1);
        assert_eq!(fate(2), Fate::GoesOn, "its record is still to come");
        mirror.apply(record(2), 2);
        assert_eq!((fate(1), fate(2)), (Fate::Ended, Fate::GoesOn));
        let mut ended = record(2);
        ended.end(Outcome::Succeeded);
        mirror.apply(ended, 3);
        assert_eq!(fate(2), Fate::Ended);
    }
}
