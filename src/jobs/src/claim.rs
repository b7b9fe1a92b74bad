use std::fmt;

use crate::feed::Feed;
use crate::{Job, Watcher};

/// Somebody's interest in a job.
///
/// When the last claim on a queued or running job is dropped and nobody has [kept](Claim::keep) it, the job is cancelled.
/// May be dropped on any thread, in a runtime or not.
pub struct Claim {
    feed: Feed,
    interest: Box<dyn Interest>,
}

/// A back end's side of a claim; the interest ends when this is dropped.
pub(crate) trait Interest: Send + Sync {
    fn keep(&self);
}

impl Claim {
    pub(crate) fn new(feed: Feed, interest: Box<dyn Interest>) -> Self {
        Self { feed, interest }
    }

    /// The job as it stands.
    pub fn job(&self) -> Job {
        self.feed.job()
    }

    /// The job at its end; as it stands, if the back end closes before.
    pub async fn finished(&self) -> Job {
        self.feed.finished().await
    }

    /// The job as it stands, then at each change.
    pub fn watch(&self) -> Watcher {
        Watcher::new(self.feed.clone())
    }

    /// From now on the job is wanted whoever waits for it.
    pub fn keep(&self) {
        self.interest.keep();
    }
}

impl fmt::Debug for Claim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Claim").field(&self.job()).finish()
    }
}
