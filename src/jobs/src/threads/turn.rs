//! How jobs of the main lane share their cores with those of the other lanes.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use parking_lot::{Condvar, Mutex};

/// While jobs run on the express and the guest lane, as many threads of the main lane rest as those jobs have, so that
/// no more cores are busy than there are threads in the main lane.
#[derive(Default)]
pub(crate) struct Turn {
    /// Threads of the jobs that run beside the main lane. Read at each look of each thread, without the lock.
    beside: AtomicUsize,
    /// Threads of the main lane that rest.
    resting: Mutex<usize>,
    changed: Condvar,
}

impl Turn {
    /// A job runs beside the main lane with so many threads, as long as the guard lives.
    pub(crate) fn beside(&self, threads: usize) -> Beside<'_> {
        self.beside.fetch_add(threads, Ordering::AcqRel);
        Beside { turn: self, threads }
    }

    /// Whether a job runs beside the main lane.
    pub(crate) fn is_shared(&self) -> bool {
        self.threads_beside() > 0
    }

    fn threads_beside(&self) -> usize {
        self.beside.load(Ordering::Acquire)
    }

    /// Rests for `longest`, until fewer threads run beside the main lane than rest or until the thread's own job is told
    /// to stop. Not when enough threads rest already.
    pub(crate) fn rest(&self, longest: Duration, told: impl Fn() -> bool) -> bool {
        let end = Instant::now() + longest;
        let mut resting = self.resting.lock();
        if *resting >= self.threads_beside() {
            return false;
        }
        *resting += 1;
        while *resting <= self.threads_beside()
            && !told()
            && !self.changed.wait_until(&mut resting, end).timed_out()
        {}
        *resting -= 1;
        true
    }

    /// Has a resting thread look again.
    pub(crate) fn wake(&self) {
        let _resting = self.resting.lock();
        self.changed.notify_all();
    }
}

/// A job that runs beside the main lane.
pub(crate) struct Beside<'a> {
    turn: &'a Turn,
    threads: usize,
}

impl Drop for Beside<'_> {
    fn drop(&mut self) {
        self.turn.beside.fetch_sub(self.threads, Ordering::AcqRel);
        self.turn.wake();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicBool;
    use std::thread;

    use super::*;

    const LONG: Duration = Duration::from_hours(1);

    #[test]
    fn a_thread_rests_until_the_small_job_has_ended() {
        let turn = Turn::default();
        let beside = turn.beside(1);
        thread::scope(|scope| {
            let rest = scope.spawn(|| {
                let rested = turn.rest(LONG, || false);
                (rested, turn.is_shared())
            });
            while *turn.resting.lock() == 0 {
                thread::yield_now();
            }
            // One is enough.
            assert!(!turn.rest(LONG, || false));
            drop(beside);
            assert_eq!(rest.join().unwrap_or_default(), (true, false));
        });
    }

    #[test]
    fn as_many_threads_rest_as_run_beside() {
        let turn = Turn::default();
        let [three, one] = [3, 1].map(|threads| turn.beside(threads));
        thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| turn.rest(LONG, || false));
            }
            while *turn.resting.lock() < 4 {
                thread::yield_now();
            }
            assert!(!turn.rest(LONG, || false));
            drop(three);
            while *turn.resting.lock() > 1 {
                thread::yield_now();
            }
            drop(one);
        });
        assert_eq!(*turn.resting.lock(), 0);
    }

    #[test]
    fn a_rest_has_an_end() {
        let turn = Turn::default();
        let _beside = turn.beside(1);
        assert!(turn.rest(Duration::from_millis(1), || false));
        assert!(turn.is_shared());
        assert_eq!(*turn.resting.lock(), 0);
    }

    #[test]
    fn a_job_that_is_told_to_stop_does_not_rest() {
        let turn = Turn::default();
        let told = AtomicBool::new(false);
        let _beside = turn.beside(1);
        thread::scope(|scope| {
            scope.spawn(|| turn.rest(LONG, || told.load(Ordering::Acquire)));
            while *turn.resting.lock() == 0 {
                thread::yield_now();
            }
            told.store(true, Ordering::Release);
            turn.wake();
        });
        assert_eq!(*turn.resting.lock(), 0);
    }
}
