//! Objects where they lie: read with the checks of their format, written whole or not at all.

mod opened;
mod upload;

use std::sync::Arc;
use std::time::Duration;

use bytes::Bytes;
use object_store::path::Path;
use object_store::{Error, ObjectStore, ObjectStoreExt};
use tokio::time::Instant;

pub(crate) use self::opened::{Fault, Object, Seen};
use crate::shared::Marker;
use crate::{Content, Key};

/// The first pause before what was refused is asked again; each further one is twice as long.
const PAUSE: Duration = Duration::from_millis(50);

/// Whoever probes wants to know what the store says, and not to wait until it says something else.
const PROBED: Duration = Duration::from_secs(2);

/// Objects of more bytes are sent in parts of so many, some at once.
const PART: usize = 8 << 20;

/// A place of objects.
#[derive(Clone)]
pub(crate) struct Objects {
    store: Arc<dyn ObjectStore>,
    /// For so long what is refused is asked again.
    patience: Duration,
    /// Objects of more bytes are sent in parts.
    part: usize,
    /// Without it the place is not the one that was opened.
    marker: Option<Marker>,
}

impl Objects {
    /// Objects on a disk: what it refuses now it will refuse in a second, and parts gain nothing.
    pub(crate) fn on_disk(store: Arc<dyn ObjectStore>) -> Self {
        Self { store, patience: Duration::ZERO, part: usize::MAX, marker: None }
    }

    /// Objects in a directory that others write to. While its marker is missing every question is refused.
    pub(crate) fn in_shared_directory(
        store: Arc<dyn ObjectStore>,
        patience: Duration,
        marker: Marker,
    ) -> Self {
        Self { store, patience, part: usize::MAX, marker: Some(marker) }
    }

    /// Objects that are reached by a network.
    pub(crate) fn far_away(store: Arc<dyn ObjectStore>, patience: Duration) -> Self {
        Self { store, patience, part: PART, marker: None }
    }

    /// The store that has them.
    pub(crate) fn store(&self) -> &dyn ObjectStore {
        &*self.store
    }

    /// The object of a key with a sound header, if there is one.
    pub(crate) async fn open(&self, key: Key) -> Result<Option<Object>, Fault> {
        Object::open(self.clone(), key).await
    }

    /// The first bytes of a file where the object of a key may lie.
    pub(crate) async fn start(&self, key: Key, length: u64) -> Result<Bytes, Error> {
        // An empty range is an error.
        if length == 0 { Ok(Bytes::new()) } else { self.store.get_range(&key.location(), 0..length).await }
    }

    /// Whether the object of a key is the one that was seen, and not one that was written later.
    pub(crate) async fn is_still(&self, key: Key, seen: &Seen) -> Result<bool, Error> {
        match self.patiently(|| async { self.store.head(&key.location()).await }).await {
            Ok(now) => Ok(Seen::from(&now) == *seen),
            Err(Error::NotFound { .. }) => Ok(false),
            Err(fault) => Err(fault),
        }
    }

    /// Writes the object of a content in place of what was there. It is seen whole or not at all.
    pub(crate) async fn write(&self, key: Key, content: &Content) -> Result<(), Error> {
        let object = upload::Pieces::of(&key, content).await;
        self.patiently(|| upload::send(self.store(), key.location(), object.clone(), self.part)).await
    }

    /// Removes the object of a key. That it has gone already is no error.
    pub(crate) async fn delete(&self, key: Key) -> Result<(), Error> {
        let deleted = self.patiently(|| async { self.store.delete(&key.location()).await });
        match deleted.await {
            Err(Error::NotFound { .. }) => Ok(()),
            deleted => deleted,
        }
    }

    /// Writes and removes something under a name.
    pub(crate) async fn probe(&self, name: &str) -> Result<(), Error> {
        let location = Path::from(name);
        let hasty = Self { patience: self.patience.min(PROBED), ..self.clone() };
        hasty.patiently(|| self.store.put(&location, Bytes::from_static(b"probe").into())).await?;
        match hasty.patiently(|| async { self.store.delete(&location).await }).await {
            Err(Error::NotFound { .. }) => Ok(()),
            deleted => deleted,
        }
    }

    /// Asks again what was refused while there is patience, unless it will be refused for ever.
    async fn patiently<T, F: Future<Output = Result<T, Error>>>(
        &self,
        ask: impl Fn() -> F,
    ) -> Result<T, Error> {
        let (end, mut pause) = (Instant::now() + self.patience, PAUSE);
        loop {
            match self.asked(&ask).await {
                Err(fault) if may_pass(&fault) && Instant::now() + pause < end => {
                    tracing::warn!(%fault, "the store of results refuses: asked again");
                    tokio::time::sleep(pause).await;
                    pause *= 2;
                }
                answer => return answer,
            }
        }
    }

    /// Asks, where the marker is there before: nothing is written to the directory below a mount that is gone. And
    /// after: else the mount may have gone meanwhile.
    async fn asked<T, F: Future<Output = Result<T, Error>>>(&self, ask: impl Fn() -> F) -> Result<T, Error> {
        let Some(marker) = &self.marker else { return ask().await };
        marker.check().await?;
        let answer = ask().await;
        marker.check().await?;
        answer
    }
}

/// Whether the same question may have another answer later.
fn may_pass(fault: &Error) -> bool {
    matches!(fault, Error::Generic { .. })
}
