//! How long ended jobs stay.

use std::time::Duration;

/// Limits on the records of ended jobs. The oldest records beyond a limit are deleted.
#[derive(Clone, Copy, Debug)]
pub struct Retention {
    /// Most jobs that clients have submitted, and as many jobs that were only subtasks.
    pub count: usize,
    /// Longest time since a job's end.
    pub age: Duration,
}

impl Default for Retention {
    fn default() -> Self {
        Self { count: 10_000, age: Duration::from_hours(7 * 24) }
    }
}
