//! Lists of jobs, page by page.

use std::fmt;
use std::str::FromStr;

use crate::job::{Job, State};

/// Selects the jobs to list.
#[derive(Clone, Debug, Default)]
pub struct Filter {
    /// Only jobs in this state.
    pub state: Option<State>,
    /// Only jobs that this client has submitted.
    pub client: Option<String>,
    /// Only jobs after this position.
    pub after: Option<Cursor>,
    /// Most jobs on the page; values outside of 1 to [`Filter::MAX_LIMIT`] are clamped.
    pub limit: usize,
}

impl Filter {
    /// Most jobs on a page.
    pub const MAX_LIMIT: usize = 100;

    /// The limit, clamped.
    pub(crate) fn page_size(&self) -> usize {
        self.limit.clamp(1, Self::MAX_LIMIT)
    }

    /// Whether a job has the selected state and client.
    pub(crate) fn matches(&self, job: &Job) -> bool {
        self.state.is_none_or(|state| state == job.state)
            && self.client.as_ref().is_none_or(|client| job.clients.contains(client))
    }
}

/// A page of the list of jobs.
#[derive(Clone, Debug)]
pub struct Page {
    /// At most as many as the limit. A page may have fewer jobs and not be the last.
    pub jobs: Vec<Job>,
    /// Position at which the next page begins; `None` on the last page.
    pub next: Option<Cursor>,
}

/// A position in the list of jobs. Clients carry it as text: it prints, and parses again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cursor(pub(crate) u64);

impl fmt::Display for Cursor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// A text is not a [`Cursor`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("not a cursor of a page of jobs")]
pub struct ParseCursorError;

impl FromStr for Cursor {
    type Err = ParseCursorError;

    fn from_str(text: &str) -> Result<Self, ParseCursorError> {
        text.parse().map(Self).map_err(|_| ParseCursorError)
    }
}
