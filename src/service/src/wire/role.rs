//! The roles of API keys.

use std::fmt;

use clap::ValueEnum;
use serde::Deserialize;

/// The role of a key. Each role includes the ones before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Role {
    /// May send requests that need no job, and read machines, stored results, its own jobs and metrics.
    Read,
    /// May also start jobs and cancel its own jobs.
    Compute,
    /// May also read and cancel the jobs of all clients.
    Admin,
}

impl Role {
    /// Its lowercase name.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Compute => "compute",
            Self::Admin => "admin",
        }
    }
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
