//! One job's record in the replica, and its watchers.

use std::time::{Duration, Instant};

use tokio::sync::watch;

use crate::execution::stop::StopSignal;
use crate::jetstream::record::Record;
use crate::job::{Outcome, State};
use crate::job_watch::JobSender;

/// The fields of its job's record that a run needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RunState {
    pub(crate) generation: u64,
    pub(crate) attempts: u32,
    pub(crate) stop_signal: Option<StopSignal>,
}

impl RunState {
    fn of(record: &Record) -> Self {
        let Record { generation, job, stop_signal, .. } = record;
        Self { generation: *generation, attempts: job.attempts, stop_signal: *stop_signal }
    }
}

/// The time between two searches for a job's message doubles so often.
const MAX_DOUBLINGS: u32 = 6;

pub(crate) struct Entry {
    pub(crate) revision: u64,
    pub(crate) record: Record,
    pub(crate) job: JobSender,
    pub(super) run_state: watch::Sender<RunState>,
    /// When the record was last written, or its message last searched.
    seen: Instant,
    /// Number of searches since the record was written.
    searches: u32,
}

impl Entry {
    pub(super) fn new(record: Record, revision: u64) -> Self {
        let job = JobSender::new(record.job.clone());
        let run_state = watch::Sender::new(RunState::of(&record));
        Self { revision, record, job, run_state, seen: Instant::now(), searches: 0 }
    }

    pub(super) fn replace(&mut self, record: Record, revision: u64) {
        let has_ended = self.job.state().is_final();
        if record.generation == self.record.generation || (self.record.stop_signal.is_none() && !has_ended) {
            // Watchers of a generation whose end did not arrive, because the next one has replaced it, see the next:
            // both make the same result.
            self.job.change(|job| {
                let progress = if record.job.state == State::Running { job.progress } else { 0.0 };
                *job = record.job.clone();
                job.progress = job.progress.max(progress);
            });
        } else {
            // The earlier generation was told to stop.
            if !has_ended {
                self.job.change(|job| job.finish(Outcome::Cancelled));
            }
            self.job = JobSender::new(record.job.clone());
        }
        self.run_state.send_replace(RunState::of(&record));
        (self.record, self.revision) = (record, revision);
        (self.seen, self.searches) = (Instant::now(), 0);
    }

    /// Whether the record was not written, and its message not searched, for a time that starts at `age` and doubles
    /// with each search. If so, the caller searches the message now.
    pub(super) fn take_unseen(&mut self, age: Duration) -> bool {
        let is_unseen = self.seen.elapsed() > age * (1 << self.searches);
        if is_unseen {
            (self.seen, self.searches) = (Instant::now(), (self.searches + 1).min(MAX_DOUBLINGS));
        }
        is_unseen
    }
}
