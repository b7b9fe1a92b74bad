//! What a job that waits for its parts knows of them.

use std::collections::{HashMap, HashSet, VecDeque};

use super::queue::{Tag, Taken};
use crate::threads::run::MERGE;
use crate::{JobId, Submission};

/// Most parts of one job that are queued or run.
const AT_ONCE: usize = 256;

/// Where a job stands with its parts.
pub(super) enum Parts {
    /// It has not been asked whether it has any.
    Unknown,
    Waiting(Split),
    /// All have succeeded: it is to merge.
    Done,
}

/// A job that waits for its parts.
pub(super) struct Split {
    pub(super) client: String,
    /// Of its payload.
    pub(super) bytes: usize,
    /// Its parts are small if they are by themselves: somebody waits for it.
    pub(super) is_small: bool,
    /// Where the share of the next part begins.
    pub(super) after: Tag,
    pending: VecDeque<Submission>,
    open: HashMap<JobId, Open>,
    /// Cost of what is done, and of all.
    done: f64,
    total: f64,
}

/// A part that is queued or runs.
struct Open {
    cost: f64,
    progress: f64,
}

impl Split {
    /// Parts that are named twice are one. Their costs are ones that sum well.
    pub(super) fn new(parts: Vec<Submission>, taken: &Taken) -> Self {
        let mut seen = HashSet::new();
        let pending: VecDeque<_> = parts.into_iter().filter(|part| seen.insert(part.id)).collect();
        let total = pending.iter().map(|part| part.cost).sum();
        let (client, bytes) = (taken.job.client.clone(), taken.job.bytes);
        let (is_small, after) = (taken.job.is_small, taken.start());
        Self { client, bytes, is_small, after, pending, open: HashMap::new(), done: 0.0, total }
    }

    /// The next part that may be submitted.
    pub(super) fn next(&mut self) -> Option<Submission> {
        if self.open.len() < AT_ONCE { self.pending.pop_front() } else { None }
    }

    pub(super) fn opened(&mut self, part: JobId, cost: f64) {
        self.open.insert(part, Open { cost, progress: 0.0 });
    }

    /// The job's progress after that of a part.
    pub(super) fn progressed(&mut self, part: JobId, progress: f64) -> f64 {
        if let Some(open) = self.open.get_mut(&part).filter(|open| open.progress < progress) {
            self.done += open.cost * (progress - open.progress);
            open.progress = progress;
        }
        (1.0 - MERGE) * self.done / self.total
    }

    /// One part is no longer open, or none is: what is to follow.
    pub(super) fn closed(&mut self, part: JobId) -> Next {
        self.open.remove(&part);
        match (self.pending.is_empty(), self.open.is_empty()) {
            (false, _) => Next::Submit,
            (true, false) => Next::Wait,
            (true, true) => Next::Merge,
        }
    }

    pub(super) fn into_open(self) -> impl Iterator<Item = JobId> {
        self.open.into_keys()
    }
}

/// What follows the end of a part.
pub(super) enum Next {
    Submit,
    Wait,
    Merge,
}
