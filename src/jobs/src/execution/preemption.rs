//! Pauses threads of the main slots while jobs run in the express and the guest slot.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use parking_lot::{Condvar, Mutex};

/// Pauses as many threads of the main slots as the jobs in the express and the guest slot have, so that no more cores
/// are busy than the main slots have threads.
#[derive(Default)]
pub(crate) struct Preemption {
    /// Threads of the jobs beside the main slots. Every thread reads it at every check, without the lock.
    needed: AtomicUsize,
    /// Threads of the main slots that pause.
    paused: Mutex<usize>,
    changed: Condvar,
}

impl Preemption {
    /// Registers a job beside the main slots, with so many threads, until the guard is dropped.
    pub(crate) fn start(&self, threads: usize) -> PreemptingJob<'_> {
        self.needed.fetch_add(threads, Ordering::AcqRel);
        PreemptingJob { preemption: self, threads }
    }

    /// Whether a job runs beside the main slots.
    pub(crate) fn is_active(&self) -> bool {
        self.needed() > 0
    }

    fn needed(&self) -> usize {
        self.needed.load(Ordering::Acquire)
    }

    /// Pauses this thread for `longest`, until fewer threads are needed than pause, or until the thread's own job must
    /// stop. Returns false at once if enough threads pause already.
    pub(crate) fn pause(&self, longest: Duration, must_stop: impl Fn() -> bool) -> bool {
        let end = Instant::now() + longest;
        let mut paused = self.paused.lock();
        if *paused >= self.needed() {
            return false;
        }
        *paused += 1;
        while *paused <= self.needed()
            && !must_stop()
            && !self.changed.wait_until(&mut paused, end).timed_out()
        {}
        *paused -= 1;
        true
    }

    /// Lets the paused threads check again.
    pub(crate) fn wake(&self) {
        let _paused = self.paused.lock();
        self.changed.notify_all();
    }
}

/// A job beside the main slots.
pub(crate) struct PreemptingJob<'a> {
    preemption: &'a Preemption,
    threads: usize,
}

impl Drop for PreemptingJob<'_> {
    fn drop(&mut self) {
        self.preemption.needed.fetch_sub(self.threads, Ordering::AcqRel);
        self.preemption.wake();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicBool;
    use std::thread;

    use super::*;

    const LONG: Duration = Duration::from_hours(1);

    fn wait_until_paused(preemption: &Preemption, threads: usize) {
        while *preemption.paused.lock() != threads {
            thread::yield_now();
        }
    }

    #[test]
    fn a_thread_pauses_until_the_small_job_has_ended() {
        let preemption = Preemption::default();
        let small_job = preemption.start(1);
        thread::scope(|scope| {
            let pause = scope.spawn(|| {
                let paused = preemption.pause(LONG, || false);
                (paused, preemption.is_active())
            });
            wait_until_paused(&preemption, 1);
            // One is enough.
            assert!(!preemption.pause(LONG, || false));
            drop(small_job);
            assert_eq!(pause.join().unwrap_or_default(), (true, false));
        });
    }

    #[test]
    fn as_many_threads_pause_as_other_jobs_have() {
        let preemption = Preemption::default();
        let [three, one] = [3, 1].map(|threads| preemption.start(threads));
        thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| preemption.pause(LONG, || false));
            }
            wait_until_paused(&preemption, 4);
            assert!(!preemption.pause(LONG, || false));
            drop(three);
            wait_until_paused(&preemption, 1);
            drop(one);
        });
        assert_eq!(*preemption.paused.lock(), 0);
    }

    #[test]
    fn a_pause_ends_though_the_other_job_continues() {
        let preemption = Preemption::default();
        let _job = preemption.start(1);
        assert!(preemption.pause(Duration::from_millis(1), || false));
        assert!(preemption.is_active());
        assert_eq!(*preemption.paused.lock(), 0);
    }

    #[test]
    fn a_thread_whose_job_must_stop_does_not_pause() {
        let preemption = Preemption::default();
        let must_stop = AtomicBool::new(false);
        let _job = preemption.start(1);
        thread::scope(|scope| {
            scope.spawn(|| preemption.pause(LONG, || must_stop.load(Ordering::Acquire)));
            wait_until_paused(&preemption, 1);
            must_stop.store(true, Ordering::Release);
            preemption.wake();
        });
        assert_eq!(*preemption.paused.lock(), 0);
    }
}
