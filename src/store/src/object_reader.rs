//! Reads an object: its header first, then the chunks that a caller wants. Checks each of them.

use std::error::Error as StdError;
use std::fs::File;
use std::io::{self, ErrorKind, Read, Seek, SeekFrom};
use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use bytes::{Bytes, BytesMut};
use futures_util::{StreamExt, TryStreamExt, stream};
use object_store::{Error, GetOptions, GetResult, GetResultPayload, ObjectStoreExt};

use crate::content::{Content, HASH_INLINE_BYTES};
use crate::format::{self, CHUNK, FormatError, Header};
use crate::key::Key;
use crate::object_io::{ObjectIo, ObjectVersion};

/// The bytes of the first request: the header of a content of two gigabytes, or the whole of a small object.
const FIRST_BYTES: u64 = 64 << 10;

/// Chunks that are fetched at the same time if all of them are wanted.
const CHUNKS_IN_FLIGHT: usize = 4;

/// Why an object cannot be read.
pub(crate) enum ObjectError {
    /// This version of the object is not what was written.
    Damaged(FormatError, ObjectVersion),
    /// The store does not return it.
    Unreadable(Box<dyn StdError + Send + Sync>),
}

/// Reads an object whose header is intact. Many callers can use it at the same time.
pub(crate) struct ObjectReader {
    key: Key,
    header: Header,
    version: ObjectVersion,
    source: Source,
}

/// Where the bytes of the content come from.
enum Source {
    /// They came with the header.
    Memory(Bytes),
    /// From an open file. It keeps its bytes even if another process removes or replaces the file.
    File(Arc<Mutex<File>>),
    /// From a store that returns ranges of the object.
    Remote(ObjectIo),
}

impl ObjectReader {
    /// Opens the object of a key, if it exists.
    pub(crate) async fn open(io: ObjectIo, key: Key) -> Result<Option<Self>, ObjectError> {
        let first = match io.with_retry(|| read_first(&io, key)).await {
            Err(Error::NotFound { .. }) => return Ok(None),
            Err(error) => return Err(unreadable(error)),
            Ok(first) => first,
        };
        let (start, source, version) = match first {
            FirstRead::File(file, range, version) => {
                let file = Arc::new(Mutex::new(file));
                (read_file(&file, range, &version).await?, Source::File(file), version)
            }
            FirstRead::Bytes(start, version) => (start, Source::Remote(io), version),
        };
        let claim = format::claim(&key, &start, version.size);
        let claim = claim.map_err(|damage| ObjectError::Damaged(damage, version.clone()))?;
        let end = claim.header_size();
        let header_bytes = match usize::try_from(end) {
            Ok(end) if end <= start.len() => start.slice(..end),
            _ => source.fetch(&key, 0..end, &version).await?,
        };
        let header = claim.check(&header_bytes);
        let header = header.map_err(|damage| ObjectError::Damaged(damage, version.clone()))?;
        let is_complete = start.len() as u64 == version.size;
        let source = if is_complete { Source::Memory(start.slice(header_bytes.len()..)) } else { source };
        Ok(Some(Self { key, header, version, source }))
    }

    /// The number of the content's bytes.
    pub(crate) fn length(&self) -> u64 {
        self.header.length
    }

    /// The hash of the content, as the header states it.
    pub(crate) fn hash(&self) -> blake3::Hash {
        self.header.hash
    }

    /// The key.
    pub(crate) fn key(&self) -> Key {
        self.key
    }

    /// The whole content.
    pub(crate) async fn content(&self) -> Result<Content, ObjectError> {
        let hash = self.header.hash;
        if self.header.chunks() <= 1 {
            let bytes = if self.header.length == 0 { Bytes::new() } else { self.chunk(0).await? };
            return Ok(Content { bytes, hash });
        }
        // The header is intact, so this is the length that was written.
        let length =
            usize::try_from(self.header.length).map_err(|error| ObjectError::Unreadable(error.into()))?;
        let mut bytes = BytesMut::with_capacity(length);
        let mut chunks =
            stream::iter(0..self.header.chunks()).map(|number| self.chunk(number)).buffered(CHUNKS_IN_FLIGHT);
        while let Some(chunk) = chunks.try_next().await? {
            bytes.extend_from_slice(&chunk);
        }
        Ok(Content { bytes: bytes.freeze(), hash })
    }

    /// A chunk of the content.
    pub(crate) async fn chunk(&self, number: u64) -> Result<Bytes, ObjectError> {
        let bytes = match &self.source {
            Source::Memory(bytes) => bytes.clone(),
            source => source.fetch(&self.key, self.header.range(number), &self.version).await?,
        };
        let check = {
            let (header, bytes) = (self.header.clone(), bytes.clone());
            move || header.check(number, &bytes)
        };
        let checked = if bytes.len() <= HASH_INLINE_BYTES {
            check()
        } else {
            tokio::task::spawn_blocking(check).await.map_err(|error| ObjectError::Unreadable(error.into()))?
        };
        checked.map_err(|damage| ObjectError::Damaged(damage, self.version.clone()))?;
        Ok(bytes)
    }

    /// The chunks that overlap a range of the content, and the wanted bytes of each.
    pub(crate) fn chunks_of(&self, range: Range<u64>) -> impl Iterator<Item = (u64, Range<usize>)> + use<> {
        let end = range.end.min(self.header.length);
        let start = range.start.min(end);
        (start / CHUNK..end.div_ceil(CHUNK)).filter_map(move |number| {
            let first = number * CHUNK;
            let offset = |at: u64| usize::try_from(at.saturating_sub(first).min(CHUNK)).ok();
            Some((number, offset(start)?..offset(end)?)).filter(|(_, wanted)| !wanted.is_empty())
        })
    }
}

impl Source {
    /// Bytes of the object.
    async fn fetch(
        &self,
        key: &Key,
        range: Range<u64>,
        version: &ObjectVersion,
    ) -> Result<Bytes, ObjectError> {
        match self {
            // All bytes of the content, which then has one chunk.
            Self::Memory(bytes) => Ok(bytes.clone()),
            Self::File(file) => read_file(file, range, version).await,
            Self::Remote(io) => {
                let location = key.location();
                let fetch = || io.store().get_range(&location, range.clone());
                io.with_retry(fetch).await.map_err(unreadable)
            }
        }
    }
}

async fn read_file(
    file: &Arc<Mutex<File>>,
    range: Range<u64>,
    version: &ObjectVersion,
) -> Result<Bytes, ObjectError> {
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
        Ok(Err(error)) if error.kind() == ErrorKind::UnexpectedEof => {
            Err(ObjectError::Damaged(FormatError::Length, version.clone()))
        }
        Ok(Err(error)) => Err(ObjectError::Unreadable(error.into())),
        Err(error) => Err(ObjectError::Unreadable(error.into())),
    }
}

/// The answer of a store to the first request.
enum FirstRead {
    File(File, Range<u64>, ObjectVersion),
    Bytes(Bytes, ObjectVersion),
}

async fn read_first(io: &ObjectIo, key: Key) -> Result<FirstRead, Error> {
    let options = GetOptions::new().with_range(Some(0..FIRST_BYTES));
    let location = key.location();
    let answer = match io.store().get_opts(&location, options).await {
        // A store refuses every range of an empty file. Such a file is a damaged object.
        Err(error @ Error::Generic { .. }) => {
            return match io.store().head(&location).await {
                Ok(meta) if meta.size == 0 => Ok(FirstRead::Bytes(Bytes::new(), ObjectVersion::from(&meta))),
                _ => Err(error),
            };
        }
        answer => answer?,
    };
    let GetResult { payload, meta, range, .. } = answer;
    let version = ObjectVersion::from(&meta);
    Ok(match payload {
        GetResultPayload::File(file, _) => FirstRead::File(file, range, version),
        GetResultPayload::Stream(mut stream) => {
            // Exactly as large as needed: the memory cache counts bytes, not capacity.
            let length = usize::try_from(range.end - range.start).unwrap_or_default();
            let mut start = BytesMut::with_capacity(length);
            while let Some(piece) = stream.try_next().await? {
                start.extend_from_slice(&piece);
            }
            FirstRead::Bytes(start.freeze(), version)
        }
    })
}

fn unreadable(error: Error) -> ObjectError {
    ObjectError::Unreadable(error.into())
}
