//! The buffers that are alive now, so that the next reader of a content shares its buffer even if the memory cache has
//! evicted it, or never had room for it.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use bytes::Bytes;

use crate::content::Content;
use crate::key::Key;

/// Every key whose content is alive, whoever owns it. A buffer leaves the table with its last owner. Its clones are one
/// table.
#[derive(Clone, Default)]
pub(crate) struct LiveBuffers(Arc<Mutex<Table>>);

type Table = HashMap<Key, Weak<Buffer>>;

struct Buffer {
    key: Key,
    content: Content,
    table: Weak<Mutex<Table>>,
}

impl LiveBuffers {
    /// The content of a key, if it is alive.
    pub(crate) fn get(&self, key: &Key) -> Option<Content> {
        // The lock is free again before the buffer may be dropped: its drop takes the lock.
        let buffer = lock(&self.0).get(key).and_then(Weak::upgrade);
        buffer.map(Buffer::content)
    }

    /// Enters a content. If a buffer with the same bytes is alive already, returns that one.
    pub(crate) fn share(&self, key: Key, content: Content) -> Content {
        let new = Arc::new(Buffer { key, content, table: Arc::downgrade(&self.0) });
        let shared = match lock(&self.0).entry(key) {
            Entry::Occupied(mut entry) => {
                let alive = entry.get().upgrade().filter(|alive| alive.content.hash == new.content.hash);
                if alive.is_none() {
                    entry.insert(Arc::downgrade(&new));
                }
                alive
            }
            Entry::Vacant(entry) => {
                entry.insert(Arc::downgrade(&new));
                None
            }
        };
        Buffer::content(shared.unwrap_or(new))
    }

    #[cfg(test)]
    fn len(&self) -> usize {
        lock(&self.0).len()
    }
}

impl Buffer {
    fn content(self: Arc<Self>) -> Content {
        let hash = self.content.hash;
        Content { hash, bytes: Bytes::from_owner(Owner(self)) }
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        let Some(table) = self.table.upgrade() else { return };
        // A later buffer may have the entry by now.
        if let Entry::Occupied(entry) = lock(&table).entry(self.key)
            && entry.get().strong_count() == 0
        {
            entry.remove();
        }
    }
}

/// A buffer as the owner of bytes.
struct Owner(Arc<Buffer>);

impl AsRef<[u8]> for Owner {
    fn as_ref(&self) -> &[u8] {
        &self.0.content.bytes
    }
}

fn lock(table: &Mutex<Table>) -> MutexGuard<'_, Table> {
    table.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn content(text: &'static str) -> Content {
        Content { bytes: Bytes::from_static(text.as_bytes()), hash: blake3::hash(text.as_bytes()) }
    }

    #[test]
    fn a_buffer_leaves_the_table_with_its_last_owner() {
        let (buffers, key) = (LiveBuffers::default(), Key::from([7; 32]));
        let first = buffers.share(key, content("one"));
        let second = buffers.get(&key);
        drop(first);
        assert_eq!(buffers.get(&key), second, "one owner is enough");
        drop(second);
        assert_eq!((buffers.get(&key), buffers.len()), (None, 0));
    }

    #[test]
    fn readers_get_the_newest_bytes_and_owners_keep_the_old_ones() {
        let (buffers, key) = (LiveBuffers::default(), Key::from([7; 32]));
        let old = buffers.share(key, content("old"));
        let new = buffers.share(key, content("new"));
        assert_eq!(old, content("old"));
        drop(old);
        assert_eq!(buffers.get(&key), Some(new.clone()));
        drop(new);
        assert_eq!(buffers.len(), 0);
    }
}
