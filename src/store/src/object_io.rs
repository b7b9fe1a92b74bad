//! Reads, writes and deletes objects. Repeats what an object store refuses, and checks the marker of a directory.

use std::sync::Arc;
use std::time::Duration;

use bytes::Bytes;
use object_store::path::Path;
use object_store::{Error, ObjectMeta, ObjectStore, ObjectStoreExt};
use tokio::time::Instant;

use crate::content::Content;
use crate::key::Key;
use crate::marker::Marker;
use crate::upload::{self, ObjectBytes};

/// The first pause before an operation is repeated; each further one is twice as long.
const FIRST_PAUSE: Duration = Duration::from_millis(50);

/// A probe asks whether the store accepts an object now: it is repeated for less time.
const PROBE_RETRY: Duration = Duration::from_secs(2);

/// Objects of more bytes are uploaded in parts of this size.
const PART_BYTES: usize = 8 << 20;

/// Distinguishes an object from one that is written later under the same key.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ObjectVersion {
    pub(crate) size: u64,
    tag: Option<String>,
    modified: i64,
}

impl From<&ObjectMeta> for ObjectVersion {
    fn from(meta: &ObjectMeta) -> Self {
        Self { size: meta.size, tag: meta.e_tag.clone(), modified: meta.last_modified.timestamp() }
    }
}

/// Access to the objects of a backing store.
#[derive(Clone)]
pub(crate) struct ObjectIo {
    store: Arc<dyn ObjectStore>,
    /// For how long an operation is repeated that the store refuses.
    retry: Duration,
    /// Objects of more bytes are uploaded in parts.
    part_bytes: usize,
    /// The file without which the directory is not the one that was opened.
    marker: Option<Marker>,
}

impl ObjectIo {
    /// Objects on a local disk: a repeated operation would fail again, and parts would gain nothing.
    pub(crate) fn on_disk(store: Arc<dyn ObjectStore>) -> Self {
        Self { store, retry: Duration::ZERO, part_bytes: usize::MAX, marker: None }
    }

    /// Objects in a shared directory. Every operation fails while the marker is missing.
    pub(crate) fn in_shared_directory(store: Arc<dyn ObjectStore>, retry: Duration, marker: Marker) -> Self {
        Self { store, retry, part_bytes: usize::MAX, marker: Some(marker) }
    }

    /// Objects that are reached through a network.
    pub(crate) fn remote(store: Arc<dyn ObjectStore>, retry: Duration) -> Self {
        Self { store, retry, part_bytes: PART_BYTES, marker: None }
    }

    /// The object store.
    pub(crate) fn store(&self) -> &dyn ObjectStore {
        &*self.store
    }

    /// The first bytes of the file that should be the object of a key.
    pub(crate) async fn start(&self, key: Key, length: u64) -> Result<Bytes, Error> {
        // An empty range is an error.
        if length == 0 { Ok(Bytes::new()) } else { self.store.get_range(&key.location(), 0..length).await }
    }

    /// Whether the object of a key is still this version of it.
    pub(crate) async fn is_current(&self, key: Key, version: &ObjectVersion) -> Result<bool, Error> {
        match self.with_retry(|| async { self.store.head(&key.location()).await }).await {
            Ok(now) => Ok(ObjectVersion::from(&now) == *version),
            Err(Error::NotFound { .. }) => Ok(false),
            Err(error) => Err(error),
        }
    }

    /// Writes the object of a content in place of the old one. Readers see it complete or not at all.
    pub(crate) async fn write(&self, key: Key, content: &Content) -> Result<(), Error> {
        let object = ObjectBytes::of(&key, content).await;
        self.with_retry(|| upload::write(self.store(), key.location(), object.clone(), self.part_bytes)).await
    }

    /// Deletes the object of a key, if it exists.
    pub(crate) async fn delete(&self, key: Key) -> Result<(), Error> {
        self.delete_at(&key.location()).await
    }

    /// Writes and deletes a small file, to test whether the store is writable.
    pub(crate) async fn probe(&self, name: &str) -> Result<(), Error> {
        let location = Path::from(name);
        let probe = Self { retry: self.retry.min(PROBE_RETRY), ..self.clone() };
        probe.with_retry(|| self.store.put(&location, Bytes::from_static(b"probe").into())).await?;
        probe.delete_at(&location).await
    }

    async fn delete_at(&self, location: &Path) -> Result<(), Error> {
        match self.with_retry(|| async { self.store.delete(location).await }).await {
            Err(Error::NotFound { .. }) => Ok(()),
            deleted => deleted,
        }
    }

    /// Repeats an operation that the store refuses, unless the refusal is final.
    pub(crate) async fn with_retry<T, F: Future<Output = Result<T, Error>>>(
        &self,
        operation: impl Fn() -> F,
    ) -> Result<T, Error> {
        let (end, mut pause) = (Instant::now() + self.retry, FIRST_PAUSE);
        loop {
            match self.with_marker(&operation).await {
                Err(error) if is_transient(&error) && Instant::now() + pause < end => {
                    tracing::warn!(%error, "the result store refuses an operation: it is repeated");
                    tokio::time::sleep(pause).await;
                    pause *= 2;
                }
                result => return result,
            }
        }
    }

    /// Runs an operation between two checks of the marker. The first one ensures that nothing is written to the mount
    /// point of a file system that is not mounted, the second one that the file system was not unmounted meanwhile.
    async fn with_marker<T, F: Future<Output = Result<T, Error>>>(
        &self,
        operation: impl Fn() -> F,
    ) -> Result<T, Error> {
        let Some(marker) = &self.marker else { return operation().await };
        marker.check().await?;
        let result = operation().await;
        marker.check().await?;
        result
    }
}

/// Whether the same operation may succeed later.
fn is_transient(error: &Error) -> bool {
    matches!(error, Error::Generic { .. })
}
