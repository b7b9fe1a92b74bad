//! Immutable bytes with their hash.

use std::fmt;

use bytes::Bytes;

/// Hashing so many bytes takes less time than a switch to another thread and back.
pub(crate) const HASH_INLINE_BYTES: usize = 64 << 10;

/// Immutable bytes with their BLAKE3 hash. Its clones share one buffer.
#[derive(Clone, PartialEq, Eq)]
pub struct Content {
    /// The bytes.
    pub bytes: Bytes,
    /// Their hash.
    pub hash: blake3::Hash,
}

impl Content {
    /// Hashes the bytes; many of them on a blocking thread.
    pub(crate) async fn hashed(bytes: Bytes) -> Self {
        let inline = || blake3::hash(&bytes);
        let hash = if bytes.len() <= HASH_INLINE_BYTES {
            inline()
        } else {
            let bytes = bytes.clone();
            let hash = tokio::task::spawn_blocking(move || blake3::hash(&bytes));
            // Only a runtime that shuts down refuses.
            hash.await.unwrap_or_else(|_| inline())
        };
        Self { bytes, hash }
    }
}

/// Without the bytes: there may be megabytes of them.
impl fmt::Debug for Content {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Content({} bytes, {})", self.bytes.len(), self.hash)
    }
}
