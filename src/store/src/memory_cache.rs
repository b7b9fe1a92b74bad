//! The cache in memory: bounded in bytes, the least recently used content is evicted.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use hashlink::LinkedHashMap;

use crate::content::Content;
use crate::key::Key;

/// The memory of an entry beside its content's bytes, rounded up: key, hash, and nodes in this table and in that of the
/// live buffers.
const ENTRY_BYTES: u64 = 512;

/// A cache of contents. Its clones are one cache.
#[derive(Clone)]
pub(crate) struct MemoryCache {
    /// Greatest sum of the entries' sizes.
    limit: u64,
    entries: Arc<Mutex<Entries>>,
}

#[derive(Default)]
struct Entries {
    /// In the order of their last use.
    by_use: LinkedHashMap<Key, Content>,
    /// Sum of the entries' sizes.
    bytes: u64,
}

impl MemoryCache {
    /// A cache of `limit` bytes, the overhead of its entries included.
    ///
    /// The policy is least recently used, not least frequently used: clients fetch the newest result next, and without
    /// a backing store it exists nowhere else.
    pub(crate) fn new(limit: u64) -> Self {
        Self { limit, entries: Arc::default() }
    }

    /// The bytes that count against the limit.
    pub(crate) fn bytes(&self) -> u64 {
        self.lock().bytes
    }

    /// The content of a key; this is a use of it.
    pub(crate) fn get(&self, key: &Key) -> Option<Content> {
        self.lock().by_use.to_back(key).cloned()
    }

    /// Stores a content in place of the key's old one, and evicts others until all fit. A content that is larger than
    /// the cache is not stored.
    pub(crate) fn insert(&self, key: Key, content: Content) {
        let mut removed = Vec::new();
        let mut entries = self.lock();
        removed.extend(entries.remove(&key));
        if size(&content) <= self.limit {
            entries.bytes += size(&content);
            entries.by_use.insert(key, content);
            while entries.bytes > self.limit {
                removed.extend(entries.pop_oldest());
            }
        }
        // The lock is free before the contents are dropped: freeing large buffers takes time.
        drop(entries);
    }

    /// Removes the content of a key.
    pub(crate) fn remove(&self, key: &Key) {
        let removed = self.lock().remove(key);
        drop(removed);
    }

    fn lock(&self) -> MutexGuard<'_, Entries> {
        self.entries.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Entries {
    fn remove(&mut self, key: &Key) -> Option<Content> {
        let content = self.by_use.remove(key)?;
        self.bytes -= size(&content);
        Some(content)
    }

    fn pop_oldest(&mut self) -> Option<Content> {
        let (_, content) = self.by_use.pop_front()?;
        self.bytes -= size(&content);
        Some(content)
    }
}

fn size(content: &Content) -> u64 {
    content.bytes.len() as u64 + ENTRY_BYTES
}
