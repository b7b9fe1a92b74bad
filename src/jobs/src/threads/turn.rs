//! How long jobs let small ones pass.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use parking_lot::{Condvar, Mutex};

/// While a small job runs on the express lane, one thread of the main lane rests, so that no more cores are busy
/// than there are threads in the main lane.
#[derive(Default)]
pub(crate) struct Turn {
    /// Read at each look of each thread, without the lock.
    express: AtomicBool,
    resting: Mutex<bool>,
    changed: Condvar,
}

impl Turn {
    /// A small job runs as long as the guard lives.
    pub(crate) fn express(&self) -> Passing<'_> {
        self.express.store(true, Ordering::Release);
        Passing(self)
    }

    pub(crate) fn is_express(&self) -> bool {
        self.express.load(Ordering::Acquire)
    }

    /// Rests for `longest`, until the small job has ended or until the thread's own job is told to stop. Not when another
    /// thread rests already.
    pub(crate) fn rest(&self, longest: Duration, told: impl Fn() -> bool) -> bool {
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
    pub(crate) fn wake(&self) {
        let _resting = self.resting.lock();
        self.changed.notify_all();
    }
}

/// A small job that runs.
pub(crate) struct Passing<'a>(&'a Turn);

impl Drop for Passing<'_> {
    fn drop(&mut self) {
        self.0.express.store(false, Ordering::Release);
        self.0.wake();
    }
}

#[cfg(test)]
mod tests {
    use std::thread;

    use super::*;

    const LONG: Duration = Duration::from_hours(1);

    #[test]
    fn a_thread_rests_until_the_small_job_has_ended() {
        let turn = Turn::default();
        let passing = turn.express();
        thread::scope(|scope| {
            let rest = scope.spawn(|| {
                let rested = turn.rest(LONG, || false);
                (rested, turn.is_express())
            });
            while !*turn.resting.lock() {
                thread::yield_now();
            }
            // One is enough.
            assert!(!turn.rest(LONG, || false));
            drop(passing);
            assert_eq!(rest.join().unwrap_or_default(), (true, false));
        });
    }

    #[test]
    fn a_rest_has_an_end() {
        let turn = Turn::default();
        let _passing = turn.express();
        assert!(turn.rest(Duration::from_millis(1), || false));
        assert!(turn.is_express());
        assert!(!*turn.resting.lock());
    }

    #[test]
    fn a_job_that_is_told_to_stop_does_not_rest() {
        let turn = Turn::default();
        let told = AtomicBool::new(false);
        let _passing = turn.express();
        thread::scope(|scope| {
            scope.spawn(|| turn.rest(LONG, || told.load(Ordering::Acquire)));
            while !*turn.resting.lock() {
                thread::yield_now();
            }
            told.store(true, Ordering::Release);
            turn.wake();
        });
        assert!(!*turn.resting.lock());
    }
}
