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

pub(super) fn go_on(observer: &dyn Observer) -> Result<(), WorkspaceError> {
    if observer.cancelled() { Err(WorkspaceError::Cancelled) } else { Ok(()) }
}
