//! Progress and cancellation of long computations.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::request::WorkspaceError;

/// Receives the progress of a computation and can stop it. The computing threads call it at least every few
/// milliseconds.
pub trait Observer: Sync {
    /// Receives the fraction of the work that is done, from 0 to 1. On one thread it never decreases.
    fn progress(&self, fraction: f64);
    /// Whether the computation must stop. It then returns [`WorkspaceError::Cancelled`].
    fn cancelled(&self) -> bool;
}

/// An observer that ignores the progress and never stops the computation.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unobserved;

impl Observer for Unobserved {
    fn progress(&self, _fraction: f64) {}

    fn cancelled(&self) -> bool {
        false
    }
}

/// The observer of one of several computations, which reports its progress as a portion of the whole.
pub struct Subprogress<'a> {
    observer: &'a dyn Observer,
    start: f64,
    end: f64,
}

impl<'a> Subprogress<'a> {
    /// Maps the computation's progress to the range from `start` to `end`, within 0 to 1.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::workspace::{Observer, Subprogress, Unobserved};
    ///
    /// let second_half = Subprogress::new(&Unobserved, 0.5, 1.0);
    /// second_half.progress(0.2); // `Unobserved` receives 0.6
    /// assert!(!second_half.cancelled());
    /// ```
    pub fn new(observer: &'a dyn Observer, start: f64, end: f64) -> Self {
        Self { observer, start, end }
    }
}

impl Observer for Subprogress<'_> {
    fn progress(&self, fraction: f64) {
        self.observer.progress(self.start + fraction * (self.end - self.start));
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}

/// Counts the finished units of a computation on several threads and reports them to the observer.
pub(crate) struct ProgressCounter<'a> {
    observer: &'a dyn Observer,
    done: AtomicUsize,
    total: usize,
}

impl<'a> ProgressCounter<'a> {
    pub(crate) fn new(observer: &'a dyn Observer, total: usize) -> Self {
        Self { observer, done: AtomicUsize::new(0), total }
    }

    pub(crate) fn finished(&self, units: usize) {
        let done = self.done.fetch_add(units, Ordering::Relaxed) + units;
        self.observer.progress(count(done) / count(self.total.max(1)));
    }
}

/// A number of items for arithmetic; from 2^32 on it is too low.
pub(super) fn count(items: usize) -> f64 {
    f64::from(u32::try_from(items).unwrap_or(u32::MAX))
}

/// Steps of a loop between two calls of the observer. Each step takes far less than a microsecond.
const STEPS: u32 = 4_096;

/// Counts the steps of a loop and asks the observer after every [`STEPS`] whether to stop.
pub(super) struct StepCounter<'a> {
    pub(super) observer: &'a dyn Observer,
    left: u32,
}

impl<'a> StepCounter<'a> {
    pub(super) fn new(observer: &'a dyn Observer) -> Self {
        Self { observer, left: STEPS }
    }

    #[inline]
    pub(super) fn step(&mut self) -> Result<(), WorkspaceError> {
        self.left -= 1;
        if self.left == 0 {
            self.left = STEPS;
            check_cancelled(self.observer)?;
        }
        Ok(())
    }

    /// Makes `count` copies of a value. It asks the observer in between, because the first write to new memory takes
    /// time.
    pub(super) fn filled<T: Clone>(&mut self, value: &T, count: usize) -> Result<Vec<T>, WorkspaceError> {
        let mut all = Vec::with_capacity(count);
        while all.len() < count {
            check_cancelled(self.observer)?;
            all.resize(count.min(all.len() + STEPS as usize), value.clone());
        }
        Ok(all)
    }
}

pub(crate) fn check_cancelled(observer: &dyn Observer) -> Result<(), WorkspaceError> {
    if observer.cancelled() { Err(WorkspaceError::Cancelled) } else { Ok(()) }
}
