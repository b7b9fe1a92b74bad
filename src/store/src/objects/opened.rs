//! An object that is being read: its header first, then those of its chunks that are wanted, each checked.

use std::error::Error as StdError;
use std::fs::File;
use std::io::{self, ErrorKind, Read, Seek, SeekFrom};
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use bytes::{Bytes, BytesMut};
use futures_util::{StreamExt, TryStreamExt, stream};
use object_store::{Error, GetOptions, GetResult, GetResultPayload, ObjectMeta, ObjectStoreExt};

use super::Objects;
use crate::content::HASHED_IN_PLACE;
use crate::object::{self, CHUNK, Damage, Header};
use crate::{Content, Key};

/// So much is fetched to begin with: the header of two gigabytes, or all of what is small.
const BEGINNING: u64 = 64 << 10;

/// So many chunks are under way at once where all of them are wanted.
const AT_ONCE: usize = 4;

/// Why an object cannot be read.
pub(crate) enum Fault {
    /// It is not the one that was written. What was seen tells it from one that is written later.
    Damaged(Damage, Seen),
    /// The store refused.
    Refused(Box<dyn StdError + Send + Sync>),
}

/// Tells an object from one that is written later in its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Seen {
    size: u64,
    tag: Option<String>,
    modified: i64,
}

impl From<&ObjectMeta> for Seen {
    fn from(meta: &ObjectMeta) -> Self {
        Self { size: meta.size, tag: meta.e_tag.clone(), modified: meta.last_modified.timestamp() }
    }
}

/// An object whose header is sound. It can be read many times, by many at once.
pub(crate) struct Object {
    key: Key,
    header: Header,
    seen: Seen,
    source: Source,
}

/// Where the content's bytes are.
enum Source {
    /// They came with the header.
    Here(Bytes),
    /// In a file. It stays what it was while it is open, also when it is removed or replaced.
    File(Arc<Mutex<File>>),
    /// Where they are asked for chunk by chunk.
    Far(Objects),
}

impl Object {
    pub(super) async fn open(objects: Objects, key: Key) -> Result<Option<Self>, Fault> {
        let begun = match objects.patiently(|| begin(&objects, key)).await {
            Err(Error::NotFound { .. }) => return Ok(None),
            Err(fault) => return Err(refused(fault)),
            Ok(begun) => begun,
        };
        let (start, source, seen) = match begun {
            Begun::File(file, range, seen) => {
                let file = Arc::new(Mutex::new(file));
                (read(&file, range, &seen).await?, Source::File(file), seen)
            }
            Begun::Bytes(start, seen) => (start, Source::Far(objects), seen),
        };
        let claim = object::claim(&key, &start, seen.size);
        let claim = claim.map_err(|damage| Fault::Damaged(damage, seen.clone()))?;
        let end = claim.header_size();
        let head = match usize::try_from(end) {
            Ok(end) if end <= start.len() => start.slice(..end),
            _ => source.fetch(&key, 0..end, &seen).await?,
        };
        let header = claim.check(&head).map_err(|damage| Fault::Damaged(damage, seen.clone()))?;
        let source =
            if start.len() as u64 == seen.size { Source::Here(start.slice(head.len()..)) } else { source };
        Ok(Some(Self { key, header, seen, source }))
    }

    /// The number of the content's bytes.
    pub(crate) fn length(&self) -> u64 {
        self.header.length
    }

    /// Their hash, as the header states it.
    pub(crate) fn hash(&self) -> blake3::Hash {
        self.header.hash
    }

    /// The key.
    pub(crate) fn key(&self) -> Key {
        self.key
    }

    /// The whole content.
    pub(crate) async fn content(&self) -> Result<Content, Fault> {
        let hash = self.header.hash;
        if self.header.chunks() <= 1 {
            let bytes = if self.header.length == 0 { Bytes::new() } else { self.chunk(0).await? };
            return Ok(Content { bytes, hash });
        }
        // The length is the one that was written: the header is sound.
        let length = usize::try_from(self.header.length).map_err(|fault| Fault::Refused(fault.into()))?;
        let mut bytes = BytesMut::with_capacity(length);
        let mut chunks =
            stream::iter(0..self.header.chunks()).map(|number| self.chunk(number)).buffered(AT_ONCE);
        while let Some(chunk) = chunks.try_next().await? {
            bytes.extend_from_slice(&chunk);
        }
        Ok(Content { bytes: bytes.freeze(), hash })
    }

    /// A chunk of the content.
    pub(crate) async fn chunk(&self, number: u64) -> Result<Bytes, Fault> {
        let bytes = match &self.source {
            Source::Here(bytes) => bytes.clone(),
            source => source.fetch(&self.key, self.header.place(number), &self.seen).await?,
        };
        let check = {
            let (header, bytes) = (self.header.clone(), bytes.clone());
            move || header.check(number, &bytes)
        };
        let checked = if bytes.len() <= HASHED_IN_PLACE {
            check()
        } else {
            tokio::task::spawn_blocking(check).await.map_err(|fault| Fault::Refused(fault.into()))?
        };
        checked.map_err(|damage| Fault::Damaged(damage, self.seen.clone()))?;
        Ok(bytes)
    }

    /// The chunks that a range of the content touches, and which bytes of each.
    pub(crate) fn touched(&self, range: Range<u64>) -> impl Iterator<Item = (u64, Range<usize>)> + use<> {
        let end = range.end.min(self.header.length);
        let start = range.start.min(end);
        (start / CHUNK..end.div_ceil(CHUNK)).filter_map(move |number| {
            let first = number * CHUNK;
            let within = |at: u64| usize::try_from(at.saturating_sub(first).min(CHUNK)).ok();
            Some((number, within(start)?..within(end)?)).filter(|(_, part)| !part.is_empty())
        })
    }
}

impl Source {
    /// Bytes of the object.
    async fn fetch(&self, key: &Key, range: Range<u64>, seen: &Seen) -> Result<Bytes, Fault> {
        match self {
            // Asked for only where it is all that there is.
            Self::Here(bytes) => Ok(bytes.clone()),
            Self::File(file) => read(file, range, seen).await,
            Self::Far(objects) => {
                let location = key.location();
                let fetch = || objects.store().get_range(&location, range.clone());
                objects.patiently(fetch).await.map_err(refused)
            }
        }
    }
}

/// Bytes of a file.
async fn read(file: &Arc<Mutex<File>>, range: Range<u64>, seen: &Seen) -> Result<Bytes, Fault> {
    let file = Arc::clone(file);
    let bytes = tokio::task::spawn_blocking(move || -> io::Result<Bytes> {
        let length = usize::try_from(range.end - range.start).map_err(io::Error::other)?;
        let mut bytes = vec![0; length];
        let mut file = file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(range.start))?;
        file.read_exact(&mut bytes)?;
        Ok(bytes.into())
    });
    match bytes.await {
        Ok(Ok(bytes)) => Ok(bytes),
        Ok(Err(fault)) if fault.kind() == ErrorKind::UnexpectedEof => {
            Err(Fault::Damaged(Damage::Length, seen.clone()))
        }
        Ok(Err(fault)) => Err(Fault::Refused(fault.into())),
        Err(fault) => Err(Fault::Refused(fault.into())),
    }
}

/// What the store answers to begin with.
enum Begun {
    File(File, Range<u64>, Seen),
    Bytes(Bytes, Seen),
}

async fn begin(objects: &Objects, key: Key) -> Result<Begun, Error> {
    let options = GetOptions::new().with_range(Some(0..BEGINNING));
    let location = key.location();
    let found = match objects.store().get_opts(&location, options).await {
        // Where there are no bytes every range is refused; the object is damaged all the same.
        Err(fault @ Error::Generic { .. }) => {
            return match objects.store().head(&location).await {
                Ok(meta) if meta.size == 0 => Ok(Begun::Bytes(Bytes::new(), Seen::from(&meta))),
                _ => Err(fault),
            };
        }
        found => found?,
    };
    let GetResult { payload, meta, range, .. } = found;
    let seen = Seen::from(&meta);
    Ok(match payload {
        GetResultPayload::File(file, _) => Begun::File(file, range, seen),
        GetResultPayload::Stream(mut stream) => {
            // No larger than what comes: memory counts bytes, not capacity.
            let length = usize::try_from(range.end - range.start).unwrap_or_default();
            let mut start = BytesMut::with_capacity(length);
            while let Some(piece) = stream.try_next().await? {
                start.extend_from_slice(&piece);
            }
            Begun::Bytes(start.freeze(), seen)
        }
    })
}

fn refused(fault: Error) -> Fault {
    Fault::Refused(fault.into())
}
