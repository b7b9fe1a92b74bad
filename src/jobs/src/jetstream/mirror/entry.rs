//! One job's record, and who is told of it.

use std::time::{Duration, Instant};

use tokio::sync::watch;

use crate::State;
use crate::feed::Feeder;
use crate::jetstream::record::Record;
use crate::job::finish;
use crate::threads::run::{Outcome, Told};

/// What concerns who runs a job: its life, its attempt and what it was told.
pub(in crate::jetstream) type Signal = (u64, u32, Option<Told>);

/// A job is looked for after doubling times, so often; then at the last.
const MOST_LOOKS: u32 = 6;

pub(in crate::jetstream) struct Entry {
    pub(in crate::jetstream) revision: u64,
    pub(in crate::jetstream) record: Record,
    pub(in crate::jetstream) feeder: Feeder,
    pub(super) signal: watch::Sender<Signal>,
    /// When it was last written, or looked for in its line.
    seen: Instant,
    /// How often it was looked for since it was written.
    looks: u32,
}

impl Entry {
    pub(super) fn new(record: Record, revision: u64) -> Self {
        let feeder = Feeder::new(record.job.clone());
        let signal = watch::Sender::new((record.life, record.job.attempts, record.told));
        Self { revision, record, feeder, signal, seen: Instant::now(), looks: 0 }
    }

    pub(super) fn replace(&mut self, record: Record, revision: u64) {
        let told = self.record.told.is_some();
        if record.life == self.record.life || (!told && !self.feeder.state().is_final()) {
            // Of a life whose end was not heard of, because the next life's beginning was written over it, the next makes
            // the same.
            self.feeder.change(|job| {
                let progress = if record.job.state == State::Running { job.progress } else { 0.0 };
                *job = record.job.clone();
                job.progress = job.progress.max(progress);
            });
        } else {
            // The life before has been told to stop.
            if !self.feeder.state().is_final() {
                self.feeder.change(|job| finish(job, Outcome::Cancelled));
            }
            self.feeder = Feeder::new(record.job.clone());
        }
        self.signal.send_replace((record.life, record.job.attempts, record.told));
        (self.record, self.revision) = (record, revision);
        (self.seen, self.looks) = (Instant::now(), 0);
    }

    /// Whether it has not been written, or looked for, since `age`: it is looked for now, and ever less often.
    pub(super) fn is_unseen(&mut self, age: Duration) -> bool {
        let unseen = self.seen.elapsed() > age * (1 << self.looks);
        if unseen {
            (self.seen, self.looks) = (Instant::now(), (self.looks + 1).min(MOST_LOOKS));
        }
        unseen
    }
}
