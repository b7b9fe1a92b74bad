//! How a long computation is watched and stopped.

use super::request::WorkspaceError;

/// Watches a computation from outside; called from the threads that compute, at least every few
/// milliseconds of work.
pub trait Observer: Sync {
    /// Part of the work that is done, from 0 to 1, never falling on one thread.
    fn progress(&self, part: f64);
    /// Whether to stop; the computation then returns [`WorkspaceError::Cancelled`].
    fn cancelled(&self) -> bool;
}

/// Nobody watches.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unobserved;

impl Observer for Unobserved {
    fn progress(&self, _part: f64) {}

    fn cancelled(&self) -> bool {
        false
    }
}

/// Short steps between two looks: each is far below a microsecond.
const STEPS: u32 = 4_096;

/// Counts the short steps of a loop and looks at the observer every so many.
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

    /// `count` copies of a value: the first touch of much memory takes its time.
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
