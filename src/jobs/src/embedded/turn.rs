//! How long jobs let small ones pass.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use parking_lot::{Condvar, Mutex};

/// While a small job runs on the express lane, one thread of the main lane rests, so that no more cores are busy
/// than there are threads in the main lane.
#[derive(Default)]
pub(super) struct Turn {
    /// Read at each look of each thread, without the lock.
    express: AtomicBool,
    resting: Mutex<bool>,
    changed: Condvar,
}

impl Turn {
    /// A small job runs as long as the guard lives.
    pub(super) fn express(&self) -> Passing<'_> {
        self.express.store(true, Ordering::Release);
        Passing(self)
    }

    pub(super) fn is_express(&self) -> bool {
        self.express.load(Ordering::Acquire)
    }

    /// Rests for `longest`, until the small job has ended or until the thread's own job is told to stop. Not when another
    /// thread rests already.
    pub(super) fn rest(&self, longest: Duration, told: impl Fn() -> bool) -> bool {
        let end = Instant::now() + longest;
        let mut resting = self.resting.lock();
        if *resting {
            return false;
        }
        *resting = true;
        while self.is_express() && !told() && !self.changed.wait_until(&mut resting, end).timed_out() {}
        *resting = false;
        true
    }

    /// Has a resting thread look again.
    pub(super) fn wake(&self) {
        let _resting = self.resting.lock();
        self.changed.notify_all();
    }
}

/// A small job that runs.
pub(super) struct Passing<'a>(&'a Turn);

impl Drop for Passing<'_> {
    fn drop(&mut self) {
        self.0.express.store(false, Ordering::Release);
        self.0.wake();
    }
}
