//! Progress and cancellation of long computations.

use super::request::WorkspaceError;

/// Receives the progress of a computation and can stop it. The computing threads call it at least every few
/// milliseconds.
pub trait Observer: Sync {
    /// Receives the fraction of the work that is done, from 0 to 1. On one thread it never decreases.
    fn progress(&self, part: f64);
    /// Whether the computation must stop. It then returns [`WorkspaceError::Cancelled`].
    fn cancelled(&self) -> bool;
}

/// An observer that ignores the progress and never stops the computation.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unobserved;

impl Observer for Unobserved {
    fn progress(&self, _part: f64) {}

    fn cancelled(&self) -> bool {
        false
    }
}

/// Steps of a loop between two calls of the observer. Each step takes far less than a microsecond.
const STEPS: u32 = 4_096;

/// Counts the steps of a loop and calls the observer after every [`STEPS`].
pub(super) struct Pace<'a> {
    pub(super) observer: &'a dyn Observer,
    left: u32,
}

impl<'a> Pace<'a> {
    pub(super) fn new(observer: &'a dyn Observer) -> Self {
        Self { observer, left: STEPS }
    }

    #[inline]
    pub(super) fn step(&mut self) -> Result<(), WorkspaceError> {
        self.left -= 1;
        if self.left == 0 {
            self.left = STEPS;
            go_on(self.observer)?;
        }
        Ok(())
    }

    /// Makes `count` copies of a value. It calls the observer in between, because the first write to new memory takes
    /// time.
    pub(super) fn filled<T: Clone>(&mut self, value: &T, count: usize) -> Result<Vec<T>, WorkspaceError> {
        let mut all = Vec::with_capacity(count);
        while all.len() < count {
            go_on(self.observer)?;
            all.resize(count.min(all.len() + STEPS as usize), value.clone());
        }
        Ok(all)
    }
}

pub(super) fn go_on(observer: &dyn Observer) -> Result<(), WorkspaceError> {
    if observer.cancelled() { Err(WorkspaceError::Cancelled) } else { Ok(()) }
}
