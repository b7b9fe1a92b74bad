//! The buffers that somebody holds now, so that the next reader shares them: also those that memory has
//! forgotten, or never had room for.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use bytes::Bytes;

use crate::{Content, Key};

/// Every key whose content is alive, whoever holds it. Its size is that of what is alive: a buffer leaves the
/// table with its last holder.
#[derive(Clone, Default)]
pub(crate) struct Held(Arc<Mutex<Table>>);

type Table = HashMap<Key, Weak<Buffer>>;

struct Buffer {
    key: Key,
    content: Content,
    table: Weak<Mutex<Table>>,
}

impl Held {
    /// The content of a key, if somebody holds it.
    pub(crate) fn get(&self, key: &Key) -> Option<Content> {
        // The lock is free again before the buffer may be dropped: its drop takes it.
        let buffer = lock(&self.0).get(key).and_then(Weak::upgrade);
        buffer.map(Buffer::content)
    }

    /// The content as others shall find it: what is held already where the bytes are the same.
    pub(crate) fn share(&self, key: Key, content: Content) -> Content {
        let fresh = Arc::new(Buffer { key, content, table: Arc::downgrade(&self.0) });
        let found = match lock(&self.0).entry(key) {
            Entry::Occupied(mut entry) => {
                let held = entry.get().upgrade().filter(|held| held.content.hash == fresh.content.hash);
                if held.is_none() {
                    entry.insert(Arc::downgrade(&fresh));
                }
                held
            }
            Entry::Vacant(entry) => {
                entry.insert(Arc::downgrade(&fresh));
                None
            }
        };
        Buffer::content(found.unwrap_or(fresh))
    }

    #[cfg(test)]
    fn len(&self) -> usize {
        lock(&self.0).len()
    }
}

impl Buffer {
    fn content(self: Arc<Self>) -> Content {
        let hash = self.content.hash;
        Content { hash, bytes: Bytes::from_owner(Holder(self)) }
    }
}

impl Drop for Buffer {
    fn drop(&mut self) {
        let Some(table) = self.table.upgrade() else { return };
        // Another buffer may have taken the place meanwhile.
        if let Entry::Occupied(entry) = lock(&table).entry(self.key)
            && entry.get().strong_count() == 0
        {
            entry.remove();
        }
    }
}

/// A buffer as the owner of bytes.
struct Holder(Arc<Buffer>);

impl AsRef<[u8]> for Holder {
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
    fn a_buffer_leaves_with_its_last_holder() {
        let (held, key) = (Held::default(), Key::from([7; 32]));
        let first = held.share(key, content("one"));
        let second = held.get(&key);
        drop(first);
        assert_eq!(held.get(&key), second, "one holder is enough");
        drop(second);
        assert_eq!((held.get(&key), held.len()), (None, 0));
    }

    #[test]
    fn the_newest_bytes_are_found_and_the_old_stay_with_their_holders() {
        let (held, key) = (Held::default(), Key::from([7; 32]));
        let old = held.share(key, content("old"));
        let new = held.share(key, content("new"));
        assert_eq!(old, content("old"));
        drop(old);
        assert_eq!(held.get(&key), Some(new.clone()));
        drop(new);
        assert_eq!(held.len(), 0);
    }
}
