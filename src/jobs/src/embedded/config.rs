use std::fmt;
use std::path::PathBuf;
use std::time::Duration;

use super::records::Retention;

/// How the embedded back end keeps and runs jobs.
#[derive(Clone, Debug)]
pub struct Config {
    /// Where the database is; `None`: in memory, for this process only.
    pub directory: Option<PathBuf>,
    /// How many cores jobs keep busy; at least one.
    pub threads: usize,
    /// How many jobs run at once in the main lane; between one and `threads`, which are dealt out among them.
    pub slots: usize,
    /// Most jobs in the queue; at least one.
    pub queue: usize,
    /// Most bytes of payload in the queue.
    pub queue_bytes: usize,
    /// Greatest cost that the express lane takes, seconds of one core.
    pub small: f64,
    /// A job that has waited longer goes before all that have not.
    pub overdue: Duration,
    /// A job that was running when the process died so many times is not run again.
    pub max_attempts: u32,
    /// What is kept of finished jobs.
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
            small: 2.0,
            overdue: Duration::from_mins(10),
            max_attempts: 5,
            retention: Retention { count: 10_000, age: Duration::from_hours(7 * 24) },
        }
    }
}

impl Config {
    /// The default with a database in `directory`.
    pub fn in_directory(directory: impl Into<PathBuf>) -> Self {
        Self { directory: Some(directory.into()), ..Self::default() }
    }
}

/// Why the back end cannot be opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OpenError {
    /// Another process runs the jobs of this directory.
    InUse {
        /// Where the database is.
        directory: PathBuf,
    },
    /// A later version of this program wrote the database.
    Newer {
        /// The database.
        path: PathBuf,
        /// Its `user_version`.
        version: i64,
    },
    /// The file or directory cannot be written or read.
    Unusable {
        /// The file or directory.
        path: PathBuf,
        /// What the system or SQLite says.
        reason: String,
    },
    /// Threads cannot be started.
    Threads(String),
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::InUse { directory } => {
                write!(f, "{}: another process runs these jobs", directory.display())
            }
            Self::Newer { path, version } => {
                write!(f, "{}: written by a later version (schema {version})", path.display())
            }
            Self::Unusable { path, reason } => write!(f, "{}: {reason}", path.display()),
            Self::Threads(reason) => write!(f, "threads for jobs cannot be started: {reason}"),
        }
    }
}

impl std::error::Error for OpenError {}
