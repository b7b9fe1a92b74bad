use std::fmt;

use clap::ValueEnum;
use serde::Deserialize;

/// What a key is good for; each also for what the ones before it are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Role {
    /// Questions that are answered at once, machines, kept results, the key's own jobs, metrics.
    Read,
    /// What begins jobs, and the end of the key's own.
    Compute,
    /// The jobs of all.
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
