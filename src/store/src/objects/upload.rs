//! Sends an object: in one piece, or in parts that are seen together or not at all.

use bytes::Bytes;
use futures_util::{StreamExt, TryStreamExt, stream};
use object_store::path::Path;
use object_store::{Error, ObjectStore, ObjectStoreExt, PutPayload};

use crate::content::HASHED_IN_PLACE;
use crate::{Content, Key, object};

/// So many parts are under way at once.
const AT_ONCE: usize = 4;

/// The bytes of an object, the content's not copied.
#[derive(Clone)]
pub(super) struct Pieces {
    header: Bytes,
    content: Bytes,
}

impl Pieces {
    /// The object of a content, hashed off the runtime when that takes long.
    pub(super) async fn of(key: &Key, content: &Content) -> Self {
        let header = if content.bytes.len() <= HASHED_IN_PLACE {
            object::header(key, content)
        } else {
            let (key, content) = (*key, content.clone());
            let there = {
                let content = content.clone();
                tokio::task::spawn_blocking(move || object::header(&key, &content))
            };
            // Refused only by a runtime that is shutting down.
            there.await.unwrap_or_else(|_| object::header(&key, &content))
        };
        Self { header, content: content.bytes.clone() }
    }

    fn len(&self) -> usize {
        self.header.len() + self.content.len()
    }

    /// The next so many bytes.
    fn take(&mut self, length: usize) -> Option<PutPayload> {
        let header = self.header.split_to(length.min(self.header.len()));
        let content = self.content.split_to((length - header.len()).min(self.content.len()));
        (!header.is_empty() || !content.is_empty()).then(|| [header, content].into_iter().collect())
    }
}

/// Sends an object, one of more than `part` bytes in parts of so many. What fails is undone at the store.
pub(super) async fn send(
    store: &dyn ObjectStore,
    location: Path,
    mut object: Pieces,
    part: usize,
) -> Result<(), Error> {
    if object.len() <= part {
        let all = object.take(part).unwrap_or_default();
        return store.put(&location, all).await.map(|_| ());
    }
    let mut upload = store.put_multipart(&location).await?;
    let parts = std::iter::from_fn(|| object.take(part));
    let sent = stream::iter(parts)
        .map(|part| upload.put_part(part))
        .buffer_unordered(AT_ONCE)
        .try_for_each(|()| async { Ok(()) })
        .await;
    let completed = match sent {
        Ok(()) => upload.complete().await.map(|_| ()),
        Err(fault) => Err(fault),
    };
    if completed.is_err()
        && let Err(fault) = upload.abort().await
    {
        tracing::warn!(%location, %fault, "parts of an upload that failed may be left");
    }
    completed
}
