//! The format of an object on disk and in a shared store: a header, then the bytes of the content.
//!
//! | offset | length | |
//! |---|---|---|
//! | 0 | 8 | `VERNEobj` |
//! | 8 | 4 | version of the format, 2, little-endian |
//! | 12 | 8 | number of bytes after the header, little-endian |
//! | 20 | 32 | key |
//! | 52 | 32 | BLAKE3 hash of the bytes |
//! | 84 | 32 | BLAKE3 hash of the 84 bytes before it and of the table after it |
//! | 116 | 32 n | table: BLAKE3 hash of each of the n chunks |
//!
//! A chunk has 1 MiB; the last one has the rest. The header and one chunk can be checked without the other chunks, so
//! that a reader can check a range. Objects of another version count as foreign; their contents are computed again.

use std::error::Error;
use std::fmt;
use std::ops::Range;

use bytes::Bytes;

use crate::content::Content;
use crate::key::Key;

const MAGIC: &[u8; 8] = b"VERNEobj";
const VERSION: u32 = 2;
const HASH: usize = 32;
/// The bytes before the header's own hash.
const STATED: usize = 84;

/// The bytes before the table.
pub(crate) const FIXED: usize = STATED + HASH;

/// The bytes of a chunk.
pub(crate) const CHUNK: u64 = CHUNK_BYTES as u64;
const CHUNK_BYTES: usize = 1 << 20;

/// Why bytes are not the object of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FormatError {
    /// They do not begin as an object of this version does.
    Foreign,
    /// They are the object of another key.
    OtherKey,
    /// Their number differs from the one that the header states.
    Length,
    /// The header disagrees with its own hash.
    Header,
    /// A chunk disagrees with its hash in the header.
    Chunk,
}

/// A checked header.
#[derive(Clone, Debug)]
pub(crate) struct Header {
    /// The number of the content's bytes.
    pub(crate) length: u64,
    /// Their hash.
    pub(crate) hash: blake3::Hash,
    table: Bytes,
}

/// The statements of the bytes before the table, not checked yet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Claim {
    length: u64,
    hash: blake3::Hash,
    own: blake3::Hash,
}

/// The size of a content's object, in bytes.
pub(crate) fn size(content: &Content) -> u64 {
    let length = content.bytes.len() as u64;
    header_size(length) + length
}

/// The header of a content's object. Hashes all bytes.
pub(crate) fn header(key: &Key, content: &Content) -> Bytes {
    let bytes = &content.bytes;
    let table: Vec<u8> =
        bytes.chunks(CHUNK_BYTES).flat_map(|chunk| *blake3::hash(chunk).as_bytes()).collect();
    let mut header = Vec::with_capacity(FIXED + table.len());
    header.extend_from_slice(MAGIC);
    header.extend_from_slice(&VERSION.to_le_bytes());
    header.extend_from_slice(&(bytes.len() as u64).to_le_bytes());
    header.extend_from_slice(key.as_bytes());
    header.extend_from_slice(content.hash.as_bytes());
    let own = own_hash(&header, &table);
    header.extend_from_slice(own.as_bytes());
    header.extend_from_slice(&table);
    header.into()
}

/// Reads the first bytes of a file of `size` bytes, which should be the object of a key.
pub(crate) fn claim(key: &Key, start: &[u8], size: u64) -> Result<Claim, FormatError> {
    let rest = start.strip_prefix(MAGIC).ok_or(FormatError::Foreign)?;
    let (version, rest) = rest.split_first_chunk().ok_or(FormatError::Foreign)?;
    if u32::from_le_bytes(*version) != VERSION {
        return Err(FormatError::Foreign);
    }
    let (length, rest) = rest.split_first_chunk().ok_or(FormatError::Length)?;
    let (stated, rest) = rest.split_first_chunk::<HASH>().ok_or(FormatError::Length)?;
    let (hash, rest) = rest.split_first_chunk::<HASH>().ok_or(FormatError::Length)?;
    let own = rest.first_chunk::<HASH>().ok_or(FormatError::Length)?;
    if stated != key.as_bytes() {
        return Err(FormatError::OtherKey);
    }
    let length = u64::from_le_bytes(*length);
    if header_size(length).checked_add(length) != Some(size) {
        return Err(FormatError::Length);
    }
    Ok(Claim { length, hash: blake3::Hash::from_bytes(*hash), own: blake3::Hash::from_bytes(*own) })
}

impl Claim {
    /// The size of the whole header, at most that of the file.
    pub(crate) fn header_size(&self) -> u64 {
        header_size(self.length)
    }

    /// The header, if its bytes agree with its own hash.
    pub(crate) fn check(&self, header: &Bytes) -> Result<Header, FormatError> {
        if header.len() as u64 != self.header_size() {
            return Err(FormatError::Length);
        }
        let table = header.slice(FIXED..);
        if own_hash(&header[..STATED], &table) != self.own {
            return Err(FormatError::Header);
        }
        Ok(Header { length: self.length, hash: self.hash, table })
    }
}

impl Header {
    /// The number of chunks.
    pub(crate) fn chunks(&self) -> u64 {
        self.length.div_ceil(CHUNK)
    }

    /// The range of a chunk in the object.
    pub(crate) fn range(&self, chunk: u64) -> Range<u64> {
        let start = chunk * CHUNK;
        let header = header_size(self.length);
        header + start..header + (start + CHUNK).min(self.length)
    }

    /// Checks the bytes of a chunk.
    pub(crate) fn check(&self, chunk: u64, bytes: &[u8]) -> Result<(), FormatError> {
        let range = self.range(chunk);
        if bytes.len() as u64 != range.end - range.start {
            return Err(FormatError::Length);
        }
        let stated = usize::try_from(chunk).ok().and_then(|chunk| self.table.chunks(HASH).nth(chunk));
        if stated == Some(blake3::hash(bytes).as_bytes().as_slice()) {
            Ok(())
        } else {
            Err(FormatError::Chunk)
        }
    }
}

fn header_size(length: u64) -> u64 {
    FIXED as u64 + HASH as u64 * length.div_ceil(CHUNK)
}

fn own_hash(stated: &[u8], table: &[u8]) -> blake3::Hash {
    blake3::Hasher::new().update(stated).update(table).finalize()
}

impl fmt::Display for FormatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Foreign => "not an object of this version of the store",
            Self::OtherKey => "the object of another key",
            Self::Length => "its length differs from the one in its header",
            Self::Header => "its header disagrees with its own hash",
            Self::Chunk => "its bytes disagree with their hash",
        })
    }
}

impl Error for FormatError {}
