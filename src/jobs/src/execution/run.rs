//! One run of a job in a slot.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use super::preemption::Preemption;
use super::slot::{Slot, SlotKind};
use super::stop::{RunEnd, StopSignal};
use crate::job::{Failure, Outcome};
use crate::job_id::JobKey;
use crate::job_watch::JobSender;
use crate::subtasks::MERGE_FRACTION;
use crate::work::{RunControl, Work, WorkError};

/// A job may occupy the express slot for so many times its estimated time.
const OVERRUN: f64 = 5.0;

/// Least estimate for that limit, seconds.
const MIN_ESTIMATE: f64 = 0.2;

pub(crate) struct Run {
    pub(crate) key: JobKey,
    /// The job's subtasks have succeeded: this run merges their results.
    merges: bool,
    /// The client for which the job counts.
    pub(crate) client: String,
    pub(crate) slot: Slot,
    job: JobSender,
    preemption: Arc<Preemption>,
    signal: OnceLock<StopSignal>,
    started: Instant,
    /// Longest time in the express slot.
    express_limit: Duration,
    /// End of each thread's last pause, nanoseconds after the start.
    paused: Box<[AtomicU64]>,
}

impl Run {
    pub(crate) fn new(
        key: JobKey,
        merges: bool,
        client: String,
        slot: Slot,
        job: JobSender,
        preemption: Arc<Preemption>,
    ) -> Self {
        let paused = (0..slot.pool.current_num_threads()).map(|_| AtomicU64::new(0)).collect();
        let (signal, started) = (OnceLock::new(), Instant::now());
        let cost = job.job().cost * if merges { MERGE_FRACTION } else { 1.0 };
        let seconds = OVERRUN * cost.max(MIN_ESTIMATE);
        let express_limit = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX);
        Self { key, merges, client, slot, job, preemption, signal, started, express_limit, paused }
    }

    /// Tells the run to stop. Only the first signal counts.
    pub(crate) fn stop(&self, signal: StopSignal) {
        if self.signal.set(signal).is_ok() {
            self.preemption.wake();
        }
    }

    pub(crate) fn stop_signal(&self) -> Option<StopSignal> {
        self.signal.get().copied()
    }

    /// Asks for the job's subtasks and, if there are none, runs the job. Called on the slot's pool. Calls `before_run`
    /// before the run, and `on_progress` on any thread of the pool when the progress has grown.
    pub(crate) fn execute(
        &self,
        work: &dyn Work,
        payload: &[u8],
        before_run: impl FnOnce(),
        on_progress: &(dyn Fn() + Sync),
    ) -> RunEnd {
        if let Some(signal) = self.stop_signal() {
            return signal.into();
        }
        if !self.merges {
            match self.guarded(|| work.subtasks(&self.key.id, payload)) {
                Ok(subtasks) if subtasks.is_empty() => {}
                Ok(subtasks) => return RunEnd::Split(subtasks),
                Err(end) => return end,
            }
        }
        before_run();
        let threads = self.slot.pool.current_num_threads();
        let _preempting = (self.slot.kind != SlotKind::Main).then(|| self.preemption.start(threads));
        let control = Control { run: self, on_progress };
        match self.guarded(|| work.run(&self.key.id, payload, &control)) {
            Ok(()) => RunEnd::Final(Outcome::Succeeded),
            Err(end) => end,
        }
    }

    /// Calls the work. A panic, an error or a stop signal ends the run.
    fn guarded<T>(&self, call: impl FnOnce() -> Result<T, WorkError>) -> Result<T, RunEnd> {
        let error = match catch_unwind(AssertUnwindSafe(call)) {
            Ok(Ok(value)) => return Ok(value),
            Ok(Err(error)) => error,
            Err(panic) => {
                let failure = Failure::Panicked(panic_message(panic.as_ref()));
                return Err(RunEnd::Final(Outcome::Failed(failure)));
            }
        };
        Err(match (self.stop_signal(), error) {
            (Some(StopSignal::Overran), _) => RunEnd::Overran(self.started.elapsed().as_secs_f64()),
            (Some(signal), _) => signal.into(),
            (None, WorkError::Cancelled) => RunEnd::Final(Outcome::Cancelled),
            (None, WorkError::Failed(reason)) => RunEnd::Final(Outcome::Failed(Failure::Work(reason))),
            (None, WorkError::CannotRunHere(reason)) => RunEnd::CannotRunHere(reason),
        })
    }

    /// Whether the run must stop. Pauses a thread of a main slot if another job needs its core, and stops a job that
    /// has occupied the express slot for too long.
    fn must_stop(&self) -> bool {
        match self.slot.kind {
            SlotKind::Main if self.preemption.is_active() => self.pause(),
            SlotKind::Express if self.started.elapsed() > self.express_limit => {
                self.stop(StopSignal::Overran);
            }
            SlotKind::Main | SlotKind::Express | SlotKind::Guest => {}
        }
        self.stop_signal().is_some()
    }

    /// Pauses a thread at most as long as it has worked since its last pause, so a job has at least half of its time.
    fn pause(&self) {
        let Some(paused) = rayon::current_thread_index().and_then(|thread| self.paused.get(thread)) else {
            return;
        };
        let last = Duration::from_nanos(paused.load(Ordering::Relaxed));
        let worked = self.started.elapsed().saturating_sub(last);
        if self.preemption.pause(worked, || self.stop_signal().is_some()) {
            let now = u64::try_from(self.started.elapsed().as_nanos()).unwrap_or(u64::MAX);
            paused.store(now, Ordering::Relaxed);
        }
    }
}

/// The work's view of its run.
struct Control<'a> {
    run: &'a Run,
    on_progress: &'a (dyn Fn() + Sync),
}

impl RunControl for Control<'_> {
    fn progress(&self, fraction: f64) {
        let of_job = if self.run.merges { 1.0 - MERGE_FRACTION * (1.0 - fraction) } else { fraction };
        if self.run.job.set_progress(of_job) {
            (self.on_progress)();
        }
    }

    fn cancelled(&self) -> bool {
        self.run.must_stop()
    }
}

fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("no message").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::execution::slot::slots;
    use crate::job::{Job, Submission};
    use crate::job_id::JobId;

    fn run(kind: SlotKind, preemption: &Arc<Preemption>) -> Run {
        let (id, payload) = (JobId::from_bytes([0; 32]), bytes::Bytes::new());
        let mut job =
            Job::new(Submission { id, client: String::new(), cost: 1.0, payload, deadline: None }, false);
        job.start();
        let slot = slots(1, 1, 0).into_iter().flatten().find(|slot| slot.kind == kind);
        #[expect(clippy::unwrap_used, reason = "test")]
        let slot = slot.unwrap();
        let key = JobKey { id, generation: 1 };
        Run::new(key, false, String::new(), slot, JobSender::new(job), Arc::clone(preemption))
    }

    fn has_paused(run: &Run) -> bool {
        run.paused.iter().any(|paused| paused.load(Ordering::Relaxed) > 0)
    }

    #[test]
    fn a_long_job_pauses_while_a_small_one_runs() {
        let preemption = Arc::new(Preemption::default());
        let (long, small) = (run(SlotKind::Main, &preemption), run(SlotKind::Express, &preemption));
        long.slot.pool.install(|| assert!(!long.must_stop()));
        assert!(!has_paused(&long));
        let _preempting = preemption.start(1);
        long.slot.pool.install(|| assert!(!long.must_stop()));
        assert!(has_paused(&long));
        small.slot.pool.install(|| assert!(!small.must_stop()));
        assert!(!has_paused(&small));
    }
}
