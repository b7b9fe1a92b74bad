//! The clients of one job.

use serde::{Deserialize, Serialize};

/// Clients that have submitted a job, each once, in the order of their first submissions.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Clients(Vec<String>);

impl Clients {
    /// Most clients that a job names, since each new one is a write of the record. Later clients share the job,
    /// unnamed.
    pub const MAX: usize = 64;

    pub(crate) fn of(client: &str) -> Self {
        Self(vec![client.to_owned()])
    }

    /// Whether the job names this client.
    pub fn contains(&self, client: &str) -> bool {
        self.0.iter().any(|known| known == client)
    }

    /// Whether the job names this client and no other.
    pub(crate) fn is_only(&self, client: &str) -> bool {
        self.0.len() == 1 && self.contains(client)
    }

    /// Adds a client if there is room. Returns whether it was added.
    pub(crate) fn add(&mut self, client: &str) -> bool {
        let adds = self.0.len() < Self::MAX && !self.contains(client);
        if adds {
            self.0.push(client.to_owned());
        }
        adds
    }

    /// Removes a client. Returns whether it was there.
    pub(crate) fn remove(&mut self, client: &str) -> bool {
        let before = self.0.len();
        self.0.retain(|known| known != client);
        self.0.len() < before
    }
}
