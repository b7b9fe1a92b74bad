use serde::{Deserialize, Serialize};

/// Who has asked for a job by itself, each once, in the order of their first submissions.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Clients(Vec<String>);

impl Clients {
    /// The first so many stay, as each is a write of the record. Who comes later shares the job and is not named.
    pub const MOST: usize = 64;

    pub(crate) fn of(client: &str) -> Self {
        Self(vec![client.to_owned()])
    }

    /// Whether this client is one of them.
    pub fn contains(&self, client: &str) -> bool {
        self.0.iter().any(|known| known == client)
    }

    /// Whether this client is the only one.
    pub(crate) fn is_only(&self, client: &str) -> bool {
        self.0.len() == 1 && self.contains(client)
    }

    /// Adds a client if there is room; whether that changes anything.
    pub(crate) fn join(&mut self, client: &str) -> bool {
        let joins = self.0.len() < Self::MOST && !self.contains(client);
        if joins {
            self.0.push(client.to_owned());
        }
        joins
    }

    /// Whether that changes anything.
    pub(crate) fn leave(&mut self, client: &str) -> bool {
        let before = self.0.len();
        self.0.retain(|known| known != client);
        self.0.len() < before
    }
}
