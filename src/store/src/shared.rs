//! A store that many processes read and write at once: no index, no count, nobody is evicted.

mod marker;
mod open;

pub(crate) use marker::Marker;

use std::hash::{BuildHasher, Hasher, RandomState};
use std::sync::Arc;
use std::time::Duration;

use object_store::Error;

use crate::health::Health;
use crate::objects::{Objects, Seen};
use crate::stats::Counts;
use crate::{Content, Key};

/// A store that does not take an object within this time is not healthy.
const ANSWERED: Duration = Duration::from_secs(5);

/// Who asks how the store is is answered within this time: a prober would not wait longer.
const PATIENCE: Duration = Duration::from_millis(500);

pub(crate) struct Shared {
    objects: Objects,
    /// The name under which this process tries whether an object can be written.
    probe: String,
    health: Health,
    counts: Arc<Counts>,
}

impl Shared {
    fn new(objects: Objects, counts: Arc<Counts>) -> Self {
        // A hasher's keys are random.
        let probe = format!("probe/{:016x}", RandomState::new().build_hasher().finish());
        Self { objects, probe, health: Health::default(), counts }
    }

    /// The objects.
    pub(crate) fn objects(&self) -> &Objects {
        &self.objects
    }

    /// Writes a content's object; answers whether others will find it.
    pub(crate) async fn write(self: &Arc<Self>, key: Key, content: &Content) -> bool {
        // A task of its own: where the caller goes away, parts of an upload would be left.
        let (shared, content) = (Arc::clone(self), content.clone());
        let written = tokio::spawn(async move { shared.objects.write(key, &content).await });
        match written.await.map_err(Error::from).flatten() {
            Ok(()) => true,
            Err(fault) => {
                self.counts.write_failures.add(1);
                tracing::error!(%key, %fault, "a result is not kept in the shared store");
                false
            }
        }
    }

    /// Removes a damaged object, unless it has been written anew since it was seen. One that another process
    /// writes between the two questions is lost, and computed again when it is asked for.
    pub(crate) async fn remove_damaged(self: &Arc<Self>, key: Key, seen: Seen) {
        let shared = Arc::clone(self);
        let removed = tokio::spawn(async move {
            if shared.objects.is_still(key, &seen).await? { shared.objects.delete(key).await } else { Ok(()) }
        });
        if let Err(fault) = removed.await.map_err(Error::from).flatten() {
            tracing::error!(%key, %fault, "a damaged object cannot be removed");
        }
    }

    /// Whether an object can be written now, or could a few seconds ago.
    pub(crate) async fn healthy(self: &Arc<Self>) -> Result<(), String> {
        let shared = Arc::clone(self);
        let probe = async move { shared.tried(ANSWERED).await.map_err(|fault| fault.to_string()) };
        self.health.ask(PATIENCE, probe).await
    }

    /// Writes and removes an object of this process's own.
    async fn tried(&self, within: Duration) -> Result<(), Error> {
        let answer = tokio::time::timeout(within, self.objects.probe(&self.probe)).await;
        answer.unwrap_or_else(|_| {
            let source = format!("no answer within {} s", within.as_secs()).into();
            Err(Error::Generic { store: "shared", source })
        })
    }
}
