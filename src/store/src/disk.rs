//! The backing store of one process: a directory of objects, and the index of them.

mod open;

use std::collections::HashMap;
use std::fs::File;
use std::mem;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use crate::content::Content;
use crate::error::BackingStoreError;
use crate::format;
use crate::health::Health;
use crate::index::Index;
use crate::key::Key;
use crate::object_io::{ObjectIo, ObjectVersion};
use crate::stats::Counters;

/// A busy disk may be slow; it is unhealthy only after this time.
const PROBE_TIMEOUT: Duration = Duration::from_secs(30);

/// The name of the file that tests whether the disk is writable.
const PROBE: &str = "probe";

/// Uses that are recorded in one transaction.
const USES_PER_TRANSACTION: usize = 256;

pub(crate) struct Disk {
    io: ObjectIo,
    index: Arc<Mutex<Index>>,
    /// Greatest sum of the sizes of all objects, bytes.
    limit: u64,
    /// Sum of the sizes of all objects after the last change of the index, bytes.
    bytes: Arc<AtomicU64>,
    /// The number of the next use.
    next_use: AtomicU64,
    /// The last use of each key, until it is recorded in the index.
    uses: Mutex<HashMap<Key, u64>>,
    /// Serializes the changes of objects and index.
    changes: tokio::sync::Mutex<()>,
    health: Health,
    counters: Arc<Counters>,
    /// Keeps other processes out until it is closed.
    _lock: File,
}

impl Disk {
    /// Access to the objects.
    pub(crate) fn io(&self) -> &ObjectIo {
        &self.io
    }

    /// Whether the object of a content is not larger than the limit.
    pub(crate) fn has_room_for(&self, content: &Content) -> bool {
        format::size(content) <= self.limit
    }

    /// Writes the object of a content, and makes room for it before. Must not be cancelled.
    pub(crate) async fn write(&self, key: Key, content: &Content) -> Result<(), BackingStoreError> {
        let _changes = self.changes.lock().await;
        let size = format::size(content);
        self.make_room(Some((key, size))).await?;
        self.io.write(key, content).await?;
        let used = self.next_use.fetch_add(1, Ordering::Relaxed);
        let entered = self.with_index(move |index| index.insert(key, size, used)).await;
        if entered.is_err() {
            // Without a row the object would be neither counted nor evicted.
            self.io.delete(key).await?;
        }
        entered
    }

    /// Records a use of a key. The index gets many uses in one transaction.
    pub(crate) async fn record_use(&self, key: Key) {
        let used = self.next_use.fetch_add(1, Ordering::Relaxed);
        let is_full = {
            let mut uses = self.uses.lock().unwrap_or_else(PoisonError::into_inner);
            uses.insert(key, used);
            uses.len() >= USES_PER_TRANSACTION
        };
        if is_full {
            let uses = self.take_uses();
            if let Err(error) = self.with_index(move |index| index.record_uses(&uses)).await {
                tracing::warn!(%error, "cannot record the last uses of results");
            }
        }
    }

    /// Whether an object can be written now, or could a few seconds ago.
    pub(crate) async fn healthy(self: &Arc<Self>) -> Result<(), String> {
        let disk = Arc::clone(self);
        let probe = async move { disk.io.probe(PROBE).await.map_err(|error| error.to_string()) };
        self.health.check(PROBE_TIMEOUT, probe).await
    }

    /// Sum of the sizes of all objects, bytes.
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes.load(Ordering::Relaxed)
    }

    /// Removes a damaged object, unless a later version of it has been written. Must not be cancelled.
    pub(crate) async fn remove_damaged(
        &self,
        key: Key,
        version: &ObjectVersion,
    ) -> Result<(), BackingStoreError> {
        let _changes = self.changes.lock().await;
        if self.io.is_current(key, version).await? { self.remove(&[key]).await } else { Ok(()) }
    }

    /// Removes the least recently used objects until all others, and a new one of that key and size, fit.
    async fn make_room(&self, new: Option<(Key, u64)>) -> Result<(), BackingStoreError> {
        let (uses, limit) = (self.take_uses(), self.limit);
        let evicted = self
            .with_index(move |index| {
                index.record_uses(&uses)?;
                index.least_recently_used(new, limit)
            })
            .await?;
        self.remove(&evicted).await?;
        self.counters.evictions.add(evicted.len() as u64);
        Ok(())
    }

    /// Removes objects, then their rows: a crash between the two leaves rows, which the next opening deletes.
    async fn remove(&self, keys: &[Key]) -> Result<(), BackingStoreError> {
        let mut removed = Vec::with_capacity(keys.len());
        for key in keys {
            match self.io.delete(*key).await {
                Ok(()) => removed.push(*key),
                Err(error) => tracing::error!(%key, %error, "cannot remove an object"),
            }
        }
        let all = removed.len() == keys.len();
        if !removed.is_empty() {
            self.with_index(move |index| index.remove(&removed)).await?;
        }
        if all { Ok(()) } else { Err(BackingStoreError::NoRoom) }
    }

    fn take_uses(&self) -> Vec<(Key, u64)> {
        mem::take(&mut *self.uses.lock().unwrap_or_else(PoisonError::into_inner)).into_iter().collect()
    }

    async fn with_index<T: Send + 'static>(
        &self,
        work: impl FnOnce(&mut Index) -> rusqlite::Result<T> + Send + 'static,
    ) -> Result<T, BackingStoreError> {
        let (index, bytes) = (Arc::clone(&self.index), Arc::clone(&self.bytes));
        let answer = tokio::task::spawn_blocking(move || {
            let mut index = index.lock().unwrap_or_else(PoisonError::into_inner);
            let answer = work(&mut index);
            bytes.store(index.bytes(), Ordering::Relaxed);
            answer
        });
        Ok(answer.await??)
    }
}

impl Drop for Disk {
    /// Records the uses since the last transaction: a few milliseconds, once.
    fn drop(&mut self) {
        let uses = self.take_uses();
        let mut index = self.index.lock().unwrap_or_else(PoisonError::into_inner);
        if let Err(error) = index.record_uses(&uses) {
            tracing::warn!(%error, "cannot record the last uses of results");
        }
    }
}
