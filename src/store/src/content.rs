//! What is kept.

use std::fmt;

use bytes::Bytes;

/// Up to here hashing takes less time than handing the bytes to another thread and waiting.
pub(crate) const HASHED_IN_PLACE: usize = 64 << 10;

/// Bytes that never change, with their BLAKE3 hash. Its clones share one buffer.
#[derive(Clone, PartialEq, Eq)]
pub struct Content {
    /// The bytes.
    pub bytes: Bytes,
    /// Their hash.
    pub hash: blake3::Hash,
}

impl Content {
    /// Hashes the bytes, off the runtime when that takes long.
    pub(crate) async fn of(bytes: Bytes) -> Self {
        let here = || blake3::hash(&bytes);
        let hash = if bytes.len() <= HASHED_IN_PLACE {
            here()
        } else {
            let bytes = bytes.clone();
            let there = tokio::task::spawn_blocking(move || blake3::hash(&bytes));
            // Refused only by a runtime that is shutting down.
            there.await.unwrap_or_else(|_| here())
        };
        Self { bytes, hash }
    }
}

/// Not the bytes: there are megabytes of them.
impl fmt::Debug for Content {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Content({} bytes, {})", self.bytes.len(), self.hash)
    }
}
