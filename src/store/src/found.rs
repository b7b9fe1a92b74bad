//! What was found under a key, read as a whole or as a stream.

use std::error::Error;
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use bytes::Bytes;
use futures_util::future::Either;
use futures_util::{Stream, StreamExt, stream};

use crate::Content;
use crate::below::Below;
use crate::object::{CHUNK, Damage};
use crate::objects::{Fault, Object};

/// A content of so many bytes or fewer is read whole and remembered; a larger one is read as it is sent.
pub(crate) const WHOLE: u64 = CHUNK;

/// So many chunks are under way for one reader: the one that it waits for, and the next.
const AHEAD: usize = 2;

/// A content that was found: in memory, or below as an object that is read as far as it is wanted.
#[derive(Clone)]
pub struct Found(Place);

#[derive(Clone)]
enum Place {
    Memory(Content),
    Below(Arc<Object>, Below),
}

/// Why a content breaks off.
#[derive(Debug)]
pub enum ReadFault {
    /// What comes next is not what was written. The object is removed.
    Damaged(Damage),
    /// The store refuses to read it.
    Refused(Box<dyn Error + Send + Sync>),
}

impl Found {
    pub(crate) fn below(object: Arc<Object>, below: Below) -> Self {
        Self(Place::Below(object, below))
    }

    /// The number of its bytes.
    pub fn len(&self) -> u64 {
        match &self.0 {
            Place::Memory(content) => content.bytes.len() as u64,
            Place::Below(object, _) => object.length(),
        }
    }

    /// Whether it has no bytes.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The BLAKE3 hash of all its bytes.
    pub fn hash(&self) -> blake3::Hash {
        match &self.0 {
            Place::Memory(content) => content.hash,
            Place::Below(object, _) => object.hash(),
        }
    }

    /// The bytes of a range; those beyond the end are none. What memory holds comes as one slice of it. What
    /// does not comes in pieces of 1 MiB at most, each checked before it is handed on; no more is fetched than
    /// the piece that is waited for and the next. After an error there is nothing more.
    pub fn stream(&self, range: Range<u64>) -> impl Stream<Item = Result<Bytes, ReadFault>> + Send + use<> {
        match &self.0 {
            Place::Memory(content) => {
                let slice = slice(&content.bytes, range);
                Either::Left(stream::iter((!slice.is_empty()).then_some(Ok(slice))))
            }
            Place::Below(object, below) => Either::Right(pieces(Arc::clone(object), below.clone(), range)),
        }
    }
}

fn slice(bytes: &Bytes, range: Range<u64>) -> Bytes {
    let within = |at: u64| usize::try_from(at).unwrap_or(usize::MAX).min(bytes.len());
    let end = within(range.end);
    bytes.slice(within(range.start).min(end)..end)
}

fn pieces(
    object: Arc<Object>,
    below: Below,
    range: Range<u64>,
) -> impl Stream<Item = Result<Bytes, ReadFault>> + Send {
    let key = object.key();
    let chunks = stream::iter(object.touched(range)).map(move |(number, part)| {
        let object = Arc::clone(&object);
        async move { object.chunk(number).await.map(|chunk| chunk.slice(part)) }
    });
    stream::unfold(Some((Box::pin(chunks.buffered(AHEAD)), below)), move |state| async move {
        let (mut chunks, below) = state?;
        match chunks.next().await? {
            Ok(piece) => Some((Ok(piece), Some((chunks, below)))),
            Err(fault) => {
                below.note(key, &fault).await;
                Some((Err(fault.into()), None))
            }
        }
    })
}

impl From<Content> for Found {
    fn from(content: Content) -> Self {
        Self(Place::Memory(content))
    }
}

impl fmt::Debug for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Found({} bytes, {})", self.len(), self.hash())
    }
}

impl From<Fault> for ReadFault {
    fn from(fault: Fault) -> Self {
        match fault {
            Fault::Damaged(damage, _) => Self::Damaged(damage),
            Fault::Refused(fault) => Self::Refused(fault),
        }
    }
}

impl fmt::Display for ReadFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Damaged(damage) => write!(f, "a kept content is damaged: {damage}"),
            Self::Refused(fault) => write!(f, "a kept content cannot be read: {fault}"),
        }
    }
}

impl Error for ReadFault {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Damaged(_) => None,
            Self::Refused(fault) => Some(fault.as_ref()),
        }
    }
}
