//! The layer on disk: objects in an object store, and the index of them.

mod open;

use std::collections::HashMap;
use std::fs::File;
use std::mem;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use crate::fault::DiskFault;
use crate::health::Health;
use crate::index::Index;
use crate::object;
use crate::objects::{Objects, Seen};
use crate::stats::Counts;
use crate::{Content, Key};

/// A disk that has much to do is slow, and no failing disk.
const SLOWEST: Duration = Duration::from_secs(30);

/// The name under which it is tried whether an object can be written.
const PROBE: &str = "probe";

/// So many uses are noted in one transaction.
const USES: usize = 256;

pub(crate) struct Disk {
    objects: Objects,
    index: Arc<Mutex<Index>>,
    /// Bytes of all objects are not more than this.
    bound: u64,
    /// Bytes of all objects, as the index last said.
    total: Arc<AtomicU64>,
    /// The number of the next use.
    next_use: AtomicU64,
    /// The last use of each key that the index does not know of yet.
    uses: Mutex<HashMap<Key, u64>>,
    /// Held by whoever changes what lies on disk: the objects and the index change one step at a time.
    turn: tokio::sync::Mutex<()>,
    health: Health,
    counts: Arc<Counts>,
    /// Keeps other processes out until it is closed.
    _lock: File,
}

impl Disk {
    /// The objects.
    pub(crate) fn objects(&self) -> &Objects {
        &self.objects
    }

    /// Writes a content's object, making room for it; answers whether it will be there after a restart.
    pub(crate) async fn write(self: &Arc<Self>, key: Key, content: &Content) -> bool {
        if object::size(content) > self.bound {
            return false;
        }
        // A task of its own: a caller that goes away must not leave an object that the index does not count.
        let (disk, content) = (Arc::clone(self), content.clone());
        let written = tokio::spawn(async move { disk.replace(key, &content).await });
        match written.await.map_err(DiskFault::from).flatten() {
            Ok(()) => true,
            Err(fault) => {
                self.counts.write_failures.add(1);
                tracing::error!(%key, %fault, "a result is not kept on disk");
                false
            }
        }
    }

    /// Notes that a key was asked for. Every so many uses the index learns of them.
    pub(crate) async fn touch(self: &Arc<Self>, key: Key) {
        let used = self.next_use.fetch_add(1, Ordering::Relaxed);
        let full = {
            let mut uses = self.uses.lock().unwrap_or_else(PoisonError::into_inner);
            uses.insert(key, used);
            uses.len() >= USES
        };
        if full {
            let uses = self.take_uses();
            if let Err(fault) = self.with_index(move |index| index.touch(&uses)).await {
                tracing::warn!(%fault, "last uses are not noted");
            }
        }
    }

    /// Whether an object can be written now, or could a few seconds ago.
    pub(crate) async fn healthy(self: &Arc<Self>) -> Result<(), String> {
        let disk = Arc::clone(self);
        let probe = async move { disk.objects.probe(PROBE).await.map_err(|fault| fault.to_string()) };
        self.health.ask(SLOWEST, probe).await
    }

    /// Bytes of all objects.
    pub(crate) fn total(&self) -> u64 {
        self.total.load(Ordering::Relaxed)
    }

    /// Removes a damaged object, unless it has been written anew since it was seen.
    pub(crate) async fn remove_damaged(self: &Arc<Self>, key: Key, seen: Seen) {
        let disk = Arc::clone(self);
        let removed = tokio::spawn(async move {
            let _turn = disk.turn.lock().await;
            if disk.objects.is_still(key, &seen).await? { disk.remove(&[key]).await } else { Ok(()) }
        });
        if let Err(fault) = removed.await.map_err(DiskFault::from).flatten() {
            tracing::error!(%key, %fault, "a damaged object cannot be removed");
        }
    }

    async fn replace(&self, key: Key, content: &Content) -> Result<(), DiskFault> {
        let _turn = self.turn.lock().await;
        let size = object::size(content);
        self.make_room(Some((key, size))).await?;
        self.objects.write(key, content).await?;
        let used = self.next_use.fetch_add(1, Ordering::Relaxed);
        let entered = self.with_index(move |index| index.insert(key, size, used)).await;
        if entered.is_err() {
            // Nothing would count it, nor remove it in its turn.
            self.objects.delete(key).await?;
        }
        entered
    }

    /// Removes what was used least recently until all, and a new object of so many bytes, fits.
    async fn make_room(&self, newcomer: Option<(Key, u64)>) -> Result<(), DiskFault> {
        let (uses, bound) = (self.take_uses(), self.bound);
        let victims = self
            .with_index(move |index| {
                index.touch(&uses)?;
                index.victims(newcomer, bound)
            })
            .await?;
        self.remove(&victims).await?;
        self.counts.evictions.add(victims.len() as u64);
        Ok(())
    }

    /// Removes objects, then their rows: a crash between the two leaves rows, which the next opening strikes out.
    async fn remove(&self, keys: &[Key]) -> Result<(), DiskFault> {
        let mut gone = Vec::with_capacity(keys.len());
        for key in keys {
            match self.objects.delete(*key).await {
                Ok(()) => gone.push(*key),
                Err(fault) => tracing::error!(%key, %fault, "an object cannot be removed"),
            }
        }
        let all = gone.len() == keys.len();
        if !gone.is_empty() {
            self.with_index(move |index| index.remove(&gone)).await?;
        }
        if all { Ok(()) } else { Err(DiskFault::NoRoom) }
    }

    fn take_uses(&self) -> Vec<(Key, u64)> {
        mem::take(&mut *self.uses.lock().unwrap_or_else(PoisonError::into_inner)).into_iter().collect()
    }

    async fn with_index<T: Send + 'static>(
        &self,
        work: impl FnOnce(&mut Index) -> rusqlite::Result<T> + Send + 'static,
    ) -> Result<T, DiskFault> {
        let (index, total) = (Arc::clone(&self.index), Arc::clone(&self.total));
        let answer = tokio::task::spawn_blocking(move || {
            let mut index = index.lock().unwrap_or_else(PoisonError::into_inner);
            let answer = work(&mut index);
            total.store(index.total(), Ordering::Relaxed);
            answer
        });
        Ok(answer.await??)
    }
}

impl Drop for Disk {
    /// The uses since the last transaction: a few milliseconds, once.
    fn drop(&mut self) {
        let uses = self.take_uses();
        let mut index = self.index.lock().unwrap_or_else(PoisonError::into_inner);
        if let Err(fault) = index.touch(&uses) {
            tracing::warn!(%fault, "last uses are not noted");
        }
    }
}
