//! The backing store that many processes read and write: it has no index, no size and no eviction.

mod open;

use std::hash::{BuildHasher, Hasher, RandomState};
use std::sync::Arc;
use std::time::Duration;

use object_store::Error;

use crate::content::Content;
use crate::error::BackingStoreError;
use crate::health::Health;
use crate::key::Key;
use crate::object_io::{ObjectIo, ObjectVersion};

/// A store that does not accept an object within this time is unhealthy.
const PROBE_TIMEOUT: Duration = Duration::from_secs(5);

/// A health check is answered within this time: a prober would not wait longer.
const HEALTH_TIMEOUT: Duration = Duration::from_millis(500);

pub(crate) struct Shared {
    io: ObjectIo,
    /// The name of the file with which this process tests whether the store is writable.
    probe: String,
    health: Health,
}

impl Shared {
    fn new(io: ObjectIo) -> Self {
        // The keys of a hasher are random.
        let probe = format!("probe/{:016x}", RandomState::new().build_hasher().finish());
        Self { io, probe, health: Health::default() }
    }

    /// Access to the objects.
    pub(crate) fn io(&self) -> &ObjectIo {
        &self.io
    }

    /// Writes the object of a content. Must not be cancelled.
    pub(crate) async fn write(&self, key: Key, content: &Content) -> Result<(), BackingStoreError> {
        Ok(self.io.write(key, content).await?)
    }

    /// Removes a damaged object, unless a later version of it has been written. A version that another process writes
    /// between the check and the removal is lost, and computed again when it is requested. Must not be cancelled.
    pub(crate) async fn remove_damaged(
        &self,
        key: Key,
        version: &ObjectVersion,
    ) -> Result<(), BackingStoreError> {
        if self.io.is_current(key, version).await? { Ok(self.io.delete(key).await?) } else { Ok(()) }
    }

    /// Whether an object can be written now, or could a few seconds ago.
    pub(crate) async fn healthy(self: &Arc<Self>) -> Result<(), String> {
        let shared = Arc::clone(self);
        let probe = async move { shared.probe(PROBE_TIMEOUT).await.map_err(|error| error.to_string()) };
        self.health.check(HEALTH_TIMEOUT, probe).await
    }

    /// Writes and removes a file of this process.
    async fn probe(&self, limit: Duration) -> Result<(), Error> {
        tokio::time::timeout(limit, self.io.probe(&self.probe)).await.unwrap_or_else(|_| {
            let source = format!("no answer within {} s", limit.as_secs()).into();
            Err(Error::Generic { store: "shared", source })
        })
    }
}
