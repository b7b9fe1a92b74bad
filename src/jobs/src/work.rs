use bytes::Bytes;

use crate::{JobId, Submission};

/// What jobs compute.
///
/// A run makes its result exist somewhere else, named by the job's id, and returns nothing. It must be idempotent: after
/// a crash, and rarely while an abandoned run still ends, the same job is run again.
pub trait Work: Send + Sync + 'static {
    /// The jobs whose results this one's run is merged from; none: it is run whole. Called before [`Work::run`], on such a
    /// thread; cheap, and the same at each call. What equals a job that is there already is shared with it; the part's
    /// client is not looked at, it is the job's. No job may come to have itself as a part, directly or through others.
    fn parts(&self, job: &JobId, payload: &[u8]) -> Result<Vec<Submission>, Stop> {
        let _ = (job, payload);
        Ok(Vec::new())
    }

    /// Makes the result; of a job with parts, when all of them have succeeded.
    ///
    /// Called on a thread of a rayon pool that is the job's own while it runs; may use rayon inside.
    fn run(&self, job: &JobId, payload: &[u8], watch: &dyn Watch) -> Result<(), Stop>;
}

/// Why a run ended without its result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stop {
    /// [`Watch::cancelled`] said so.
    Cancelled,
    /// For good: the same payload would fail again. The reason is kept as it is.
    Failed(Bytes),
    /// This process cannot do it, another may: the payload is another version's, the result cannot be put where it belongs.
    /// Where there are other processes the job is left to them, and comes back if they cannot either; else, and after a
    /// hundred times, it fails with this reason.
    Elsewhere(Bytes),
}

/// How a run is watched and stopped.
pub trait Watch: Sync {
    /// Tells the part of the work that is done, from 0 to 1. What falls behind an earlier call is ignored.
    fn progress(&self, part: f64);

    /// Whether to stop. To be asked at least every 10 ms on each thread of the work; may hold the thread for a while
    /// in which a small job or another client's job runs.
    fn cancelled(&self) -> bool;
}
