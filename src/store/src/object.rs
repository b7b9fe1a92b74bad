//! An object as it lies on disk or in a shared store: a header that says what follows, and the bytes.
//!
//! | offset | length | |
//! |---|---|---|
//! | 0 | 8 | `VERNEobj` |
//! | 8 | 4 | the format's version, 2, little-endian |
//! | 12 | 8 | the number of bytes after the header, little-endian |
//! | 20 | 32 | the key |
//! | 52 | 32 | the BLAKE3 hash of the bytes |
//! | 84 | 32 | the BLAKE3 hash of what stands before it and of the table after it |
//! | 116 | 32 n | the table: the BLAKE3 hash of each of the n chunks |
//!
//! A chunk is 1 MiB, the last one what is left. Whoever has the header and one chunk can tell whether they are
//! those that were written: a range is checked without the rest. Objects of version 1 had no table; they count
//! as foreign, and what they held is computed again.

use std::fmt;
use std::ops::Range;

use bytes::Bytes;

use crate::{Content, Key};

const MAGIC: &[u8; 8] = b"VERNEobj";
const VERSION: u32 = 2;
const HASH: usize = 32;
/// What the header's own hash covers, the table excepted.
const STATED: usize = 84;

/// The bytes before the table.
pub(crate) const FIXED: usize = STATED + HASH;

/// So many bytes are checked together.
pub(crate) const CHUNK: u64 = CHUNK_BYTES as u64;
const CHUNK_BYTES: usize = 1 << 20;

/// Why bytes are no object of their key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damage {
    /// They do not begin as an object of this version does.
    Foreign,
    /// They are another key's object.
    OtherKey,
    /// They are not as many as they say.
    Length,
    /// The header is not the one that was written.
    Header,
    /// The bytes after the header are not those that were written.
    Bytes,
}

/// A header that is sound.
#[derive(Clone, Debug)]
pub(crate) struct Header {
    /// The number of the content's bytes.
    pub(crate) length: u64,
    /// Their hash.
    pub(crate) hash: blake3::Hash,
    table: Bytes,
}

/// What the bytes before the table say, taken at their word.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Claim {
    length: u64,
    hash: blake3::Hash,
    own: blake3::Hash,
}

/// How long the object of a content is, in bytes.
pub(crate) fn size(content: &Content) -> u64 {
    let length = content.bytes.len() as u64;
    header_size(length) + length
}

/// The header of a content's object. Hashes every byte.
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

/// What the first bytes of a file of so many bytes say, if they are those of the key's object.
pub(crate) fn claim(key: &Key, start: &[u8], size: u64) -> Result<Claim, Damage> {
    let rest = start.strip_prefix(MAGIC).ok_or(Damage::Foreign)?;
    let (version, rest) = rest.split_first_chunk().ok_or(Damage::Foreign)?;
    if u32::from_le_bytes(*version) != VERSION {
        return Err(Damage::Foreign);
    }
    let (length, rest) = rest.split_first_chunk().ok_or(Damage::Length)?;
    let (stated, rest) = rest.split_first_chunk::<HASH>().ok_or(Damage::Length)?;
    let (hash, rest) = rest.split_first_chunk::<HASH>().ok_or(Damage::Length)?;
    let own = rest.first_chunk::<HASH>().ok_or(Damage::Length)?;
    if stated != key.as_bytes() {
        return Err(Damage::OtherKey);
    }
    let length = u64::from_le_bytes(*length);
    if header_size(length).checked_add(length) != Some(size) {
        return Err(Damage::Length);
    }
    Ok(Claim { length, hash: blake3::Hash::from_bytes(*hash), own: blake3::Hash::from_bytes(*own) })
}

impl Claim {
    /// How long the whole header is. Not longer than the file that it was read from.
    pub(crate) fn header_size(&self) -> u64 {
        header_size(self.length)
    }

    /// The header, if its bytes are those that were written.
    pub(crate) fn check(&self, header: &Bytes) -> Result<Header, Damage> {
        if header.len() as u64 != self.header_size() {
            return Err(Damage::Length);
        }
        let table = header.slice(FIXED..);
        if own_hash(&header[..STATED], &table) != self.own {
            return Err(Damage::Header);
        }
        Ok(Header { length: self.length, hash: self.hash, table })
    }
}

impl Header {
    /// The number of chunks.
    pub(crate) fn chunks(&self) -> u64 {
        self.length.div_ceil(CHUNK)
    }

    /// Where a chunk lies in the object.
    pub(crate) fn place(&self, chunk: u64) -> Range<u64> {
        let start = chunk * CHUNK;
        let header = header_size(self.length);
        header + start..header + (start + CHUNK).min(self.length)
    }

    /// Whether bytes are those that were written as a chunk.
    pub(crate) fn check(&self, chunk: u64, bytes: &[u8]) -> Result<(), Damage> {
        let place = self.place(chunk);
        if bytes.len() as u64 != place.end - place.start {
            return Err(Damage::Length);
        }
        let stated = usize::try_from(chunk).ok().and_then(|chunk| self.table.chunks(HASH).nth(chunk));
        if stated == Some(blake3::hash(bytes).as_bytes().as_slice()) { Ok(()) } else { Err(Damage::Bytes) }
    }
}

fn header_size(length: u64) -> u64 {
    FIXED as u64 + HASH as u64 * length.div_ceil(CHUNK)
}

fn own_hash(stated: &[u8], table: &[u8]) -> blake3::Hash {
    blake3::Hasher::new().update(stated).update(table).finalize()
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Foreign => "not an object of this version of the store",
            Self::OtherKey => "another key's object",
            Self::Length => "not as long as it says",
            Self::Header => "not the header it was written with",
            Self::Bytes => "not the bytes it was written with",
        })
    }
}
