//! The queues at the broker.

use serde::{Deserialize, Serialize};

/// Class of a job. Each class has a queue at the broker. The broker stores it: the order of the variants must not
/// change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum QueueClass {
    /// Small jobs, which the express slot takes too.
    Small,
    /// Subtasks of large jobs. No client waits for one of them alone, and subtasks of a job that has started must not
    /// wait behind large jobs that have not.
    Subtask,
    Large,
}

impl QueueClass {
    pub(super) const ALL: [Self; 3] = [Self::Small, Self::Subtask, Self::Large];

    /// The name in subjects at the broker.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Small => "small",
            Self::Subtask => "parts",
            Self::Large => "large",
        }
    }
}
