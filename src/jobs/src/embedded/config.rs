//! Settings of the embedded back end.

use std::path::PathBuf;
use std::time::Duration;

use crate::retention::Retention;

/// How the embedded back end stores and runs jobs.
#[derive(Clone, Debug)]
pub struct Config {
    /// Directory of the database; `None`: in memory, for this process only.
    pub directory: Option<PathBuf>,
    /// Number of cores that jobs use; at least one.
    pub threads: usize,
    /// Number of main slots, from one to `threads`. They share the threads.
    pub slots: usize,
    /// Most jobs in the queue; at least one.
    pub queue: usize,
    /// Most bytes of payload in the queue.
    pub queue_bytes: usize,
    /// Greatest cost of a small job, seconds of one core.
    pub small_cost: f64,
    /// A job that has waited longer goes before all jobs that have not.
    pub overdue_after: Duration,
    /// A job that was running at so many deaths of the process is not run again.
    pub max_attempts: u32,
    /// Limits on the records of ended jobs.
    pub retention: Retention,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            directory: None,
            threads: 1,
            slots: 1,
            queue: 10_000,
            queue_bytes: 256 << 20,
            small_cost: 2.0,
            overdue_after: Duration::from_mins(10),
            max_attempts: 5,
            retention: Retention::default(),
        }
    }
}

impl Config {
    /// The default with a database in `directory`.
    pub fn in_directory(directory: impl Into<PathBuf>) -> Self {
        Self { directory: Some(directory.into()), ..Self::default() }
    }
}

/// The back end cannot be opened.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OpenError {
    /// Another process runs the jobs of this directory.
    #[error("{}: another process runs these jobs", directory.display())]
    InUse {
        /// Directory of the database.
        directory: PathBuf,
    },
    /// A later version of this program wrote the database.
    #[error("{}: written by a later version (schema {version})", path.display())]
    Newer {
        /// The database.
        path: PathBuf,
        /// Its `user_version`.
        version: i64,
    },
    /// The file or directory cannot be written or read.
    #[error("{}: {reason}", path.display())]
    Unusable {
        /// The file or directory.
        path: PathBuf,
        /// Reason that the system or SQLite states.
        reason: String,
    },
    /// Threads cannot be started.
    #[error("threads for jobs cannot be started: {0}")]
    Threads(String),
}
