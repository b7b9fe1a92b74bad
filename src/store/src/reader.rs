//! A content that is read as a stream.

use std::error::Error;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use bytes::Bytes;
use futures_util::future::Either;
use futures_util::{Stream, StreamExt, stream};

use crate::backing_store::BackingStore;
use crate::content::Content;
use crate::format::FormatError;
use crate::object_reader::{ObjectError, ObjectReader};

/// Chunks in flight for one reader: the one that it waits for, and the next.
const CHUNKS_IN_FLIGHT: usize = 2;

/// Reads a content, from memory or from its object in the backing store.
#[derive(Clone)]
pub struct ContentReader(Source);

#[derive(Clone)]
enum Source {
    Memory(Content),
    Object(Arc<ObjectReader>, BackingStore),
}

/// Why a content ends early.
#[derive(Debug)]
pub enum ReadError {
    /// The next bytes are not those that were written. The store removes the object.
    Damaged(FormatError),
    /// The backing store does not return them.
    Unreadable(Box<dyn Error + Send + Sync>),
}

impl ContentReader {
    pub(crate) fn of_object(object: Arc<ObjectReader>, store: BackingStore) -> Self {
        Self(Source::Object(object, store))
    }

    /// The number of its bytes.
    pub fn len(&self) -> u64 {
        match &self.0 {
            Source::Memory(content) => content.bytes.len() as u64,
            Source::Object(object, _) => object.length(),
        }
    }

    /// Whether it has no bytes.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The BLAKE3 hash of all its bytes.
    pub fn hash(&self) -> blake3::Hash {
        match &self.0 {
            Source::Memory(content) => content.hash,
            Source::Object(object, _) => object.hash(),
        }
    }

    /// The bytes of a range, as far as the content reaches.
    ///
    /// From memory they come as one slice of the buffer. From the backing store they come in pieces of at most 1 MiB,
    /// each checked before it is returned; the reader fetches the piece that is waited for and the next, no more. The
    /// stream ends after an error.
    pub fn stream(&self, range: Range<u64>) -> impl Stream<Item = Result<Bytes, ReadError>> + Send + use<> {
        match &self.0 {
            Source::Memory(content) => {
                let slice = slice(&content.bytes, range);
                Either::Left(stream::iter((!slice.is_empty()).then_some(Ok(slice))))
            }
            Source::Object(object, store) => Either::Right(pieces(Arc::clone(object), store.clone(), range)),
        }
    }
}

fn slice(bytes: &Bytes, range: Range<u64>) -> Bytes {
    let clamp = |at: u64| usize::try_from(at).unwrap_or(usize::MAX).min(bytes.len());
    let end = clamp(range.end);
    bytes.slice(clamp(range.start).min(end)..end)
}

fn pieces(
    object: Arc<ObjectReader>,
    store: BackingStore,
    range: Range<u64>,
) -> impl Stream<Item = Result<Bytes, ReadError>> + Send {
    let key = object.key();
    let chunks = stream::iter(object.chunks_of(range)).map(move |(number, wanted)| {
        let object = Arc::clone(&object);
        async move { object.chunk(number).await.map(|chunk| chunk.slice(wanted)) }
    });
    stream::unfold(Some((Box::pin(chunks.buffered(CHUNKS_IN_FLIGHT)), store)), move |state| async move {
        let (mut chunks, store) = state?;
        match chunks.next().await? {
            Ok(piece) => Some((Ok(piece), Some((chunks, store)))),
            Err(error) => {
                store.report(key, &error).await;
                Some((Err(error.into()), None))
            }
        }
    })
}

impl From<Content> for ContentReader {
    fn from(content: Content) -> Self {
        Self(Source::Memory(content))
    }
}

impl fmt::Debug for ContentReader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "ContentReader({} bytes, {})", self.len(), self.hash())
    }
}

impl From<ObjectError> for ReadError {
    fn from(error: ObjectError) -> Self {
        match error {
            ObjectError::Damaged(damage, _) => Self::Damaged(damage),
            ObjectError::Unreadable(error) => Self::Unreadable(error),
        }
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Damaged(damage) => write!(f, "a stored content is damaged: {damage}"),
            Self::Unreadable(error) => write!(f, "a stored content cannot be read: {error}"),
        }
    }
}

impl Error for ReadError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Damaged(damage) => Some(damage),
            Self::Unreadable(error) => Some(error.as_ref()),
        }
    }
}
