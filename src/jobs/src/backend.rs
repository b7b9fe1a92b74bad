use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use async_trait::async_trait;

use crate::{Claim, Job, JobId, State, Submission, Watcher};

/// Keeps jobs, and has them run.
#[async_trait]
pub trait Backend: Send + Sync {
    /// Takes a job; it is durable when this returns. One that is queued or running is joined; one that is finished begins a
    /// fresh life under its id, so whoever keeps results looks there first.
    async fn submit(&self, submission: Submission) -> Result<Claim, SubmitError>;

    /// `None`: never seen, or forgotten.
    async fn get(&self, id: JobId) -> Result<Option<Job>, Unavailable>;

    /// Newest first. Without jobs that have only ever been asked for as [parts](crate::Work::parts).
    async fn list(&self, filter: Filter) -> Result<Page, Unavailable>;

    /// The job as it stands, then at each change. It is no claim: it does not keep a job wanted.
    async fn watch(&self, id: JobId) -> Result<Option<Watcher>, Unavailable>;

    /// Cancels a job whoever wants it. A running one is told to stop and is [`State::Cancelled`] when it has; a finished one
    /// is left as it is. Returns the job as it stands after that.
    async fn cancel(&self, id: JobId) -> Result<Option<Job>, Unavailable>;

    /// One of the job's [clients](Job::clients) does not want it any more: it is one of them no longer. The last takes
    /// the job along: it is cancelled as by its name, unless it is a part of what others want, and the client stays named.
    /// Of a finished job, or for who is no client of it, all stays as it is. Returns the job as it stands after that.
    async fn leave(&self, id: JobId, client: &str) -> Result<Option<Job>, Unavailable>;

    /// Whether what keeps the records takes them, as far as is known without asking it, or by a question that costs little.
    async fn reachable(&self) -> Result<(), Unavailable>;

    /// Whether other processes have the same jobs.
    fn is_shared(&self) -> bool;

    /// Since this back end was opened.
    fn counts(&self) -> Counts;

    /// Takes no more jobs, neither from callers nor from the queue, and tells running ones to stop; those go back to the
    /// queue for the next to open the back end. Returns when all have stopped, at the latest shortly after `limit`; then the
    /// back end is closed. Who waits for a job that is not finished is given it as it stands.
    async fn drain(&self, limit: Duration);
}

/// Which jobs to list.
#[derive(Clone, Debug, Default)]
pub struct Filter {
    /// Only those in this state.
    pub state: Option<State>,
    /// Only those that this client has submitted.
    pub client: Option<String>,
    /// Only those behind this place of an earlier page.
    pub after: Option<Cursor>,
    /// How many at most; taken between 1 and [`Filter::MAX_LIMIT`].
    pub limit: usize,
}

impl Filter {
    /// Most jobs on a page.
    pub const MAX_LIMIT: usize = 100;
}

/// A piece of the list of jobs.
#[derive(Clone, Debug)]
pub struct Page {
    /// At most as many as asked for; fewer does not mean the last page.
    pub jobs: Vec<Job>,
    /// Where the next page begins; `None` on the last.
    pub next: Option<Cursor>,
}

/// A place in the list of jobs. A text to those who carry it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cursor(pub(crate) u64);

impl fmt::Display for Cursor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// A text is not one that a [`Cursor`] was written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotACursor;

impl FromStr for Cursor {
    type Err = NotACursor;

    fn from_str(text: &str) -> Result<Self, NotACursor> {
        text.parse().map(Self).map_err(|_| NotACursor)
    }
}

impl fmt::Display for NotACursor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("not a cursor of a page of jobs")
    }
}

impl std::error::Error for NotACursor {}

/// What became of jobs, parts among them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// At this moment.
    pub queued: usize,
    /// At this moment; without those that wait for their parts.
    pub running: usize,
    /// Calls of [`Work::run`](crate::Work::run).
    pub started: u64,
    /// Ends.
    pub succeeded: u64,
    /// Ends.
    pub failed: u64,
    /// Ends.
    pub cancelled: u64,
}

/// Where jobs run in this process, the express lane among them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Seats {
    /// There are so many.
    pub all: usize,
    /// In so many a job runs.
    pub busy: usize,
}

/// Why a job was not taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SubmitError {
    /// The queue is full.
    Full {
        /// When a place is likely to be free.
        retry_after: Duration,
    },
    /// This back end is closing.
    Draining,
    /// It could not be recorded.
    Unavailable(Unavailable),
}

/// The records cannot be read or written now.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unavailable(pub String);

impl From<Unavailable> for SubmitError {
    fn from(unavailable: Unavailable) -> Self {
        Self::Unavailable(unavailable)
    }
}

impl fmt::Display for SubmitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Full { retry_after } => {
                write!(f, "the queue is full; try again in {} s", retry_after.as_secs())
            }
            Self::Draining => f.write_str("no more jobs are taken: closing"),
            Self::Unavailable(unavailable) => unavailable.fmt(f),
        }
    }
}

impl fmt::Display for Unavailable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the records of jobs are not available: {}", self.0)
    }
}

impl std::error::Error for SubmitError {}

impl std::error::Error for Unavailable {}
