//! Writes an object: in one request, or as a multipart upload, which readers see complete or not at all.

use bytes::Bytes;
use futures_util::{StreamExt, TryStreamExt, stream};
use object_store::path::Path;
use object_store::{Error, ObjectStore, ObjectStoreExt, PutPayload};

use crate::content::{Content, HASH_INLINE_BYTES};
use crate::format;
use crate::key::Key;

/// Parts that are sent at the same time.
const PARTS_IN_FLIGHT: usize = 4;

/// The bytes of an object. Shares the buffer of the content.
#[derive(Clone)]
pub(crate) struct ObjectBytes {
    header: Bytes,
    content: Bytes,
}

impl ObjectBytes {
    /// The object of a content; a large one is hashed on a blocking thread.
    pub(crate) async fn of(key: &Key, content: &Content) -> Self {
        let header = if content.bytes.len() <= HASH_INLINE_BYTES {
            format::header(key, content)
        } else {
            let (key, content) = (*key, content.clone());
            let header = {
                let content = content.clone();
                tokio::task::spawn_blocking(move || format::header(&key, &content))
            };
            // Only a runtime that shuts down refuses.
            header.await.unwrap_or_else(|_| format::header(&key, &content))
        };
        Self { header, content: content.bytes.clone() }
    }

    fn len(&self) -> usize {
        self.header.len() + self.content.len()
    }

    /// Takes the next `length` bytes, fewer at the end.
    fn take(&mut self, length: usize) -> Option<PutPayload> {
        let header = self.header.split_to(length.min(self.header.len()));
        let content = self.content.split_to((length - header.len()).min(self.content.len()));
        (!header.is_empty() || !content.is_empty()).then(|| [header, content].into_iter().collect())
    }
}

/// Writes an object; one of more than `part_bytes` in parts of that size. A failed upload is aborted.
pub(crate) async fn write(
    store: &dyn ObjectStore,
    location: Path,
    mut object: ObjectBytes,
    part_bytes: usize,
) -> Result<(), Error> {
    if object.len() <= part_bytes {
        let all = object.take(part_bytes).unwrap_or_default();
        return store.put(&location, all).await.map(|_| ());
    }
    let mut upload = store.put_multipart(&location).await?;
    let parts = std::iter::from_fn(|| object.take(part_bytes));
    let sent = stream::iter(parts)
        .map(|part| upload.put_part(part))
        .buffer_unordered(PARTS_IN_FLIGHT)
        .try_for_each(|()| async { Ok(()) })
        .await;
    let completed = match sent {
        Ok(()) => upload.complete().await.map(|_| ()),
        Err(error) => Err(error),
    };
    if completed.is_err()
        && let Err(error) = upload.abort().await
    {
        tracing::warn!(%location, %error, "cannot abort an upload: its parts may remain in the store");
    }
    completed
}
