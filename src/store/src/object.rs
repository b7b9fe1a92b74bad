//! An object as it lies on disk: a header that says what follows, and the bytes.
//!
//! | offset | length | |
//! |---|---|---|
//! | 0 | 8 | `VERNEobj` |
//! | 8 | 4 | the format's version, 1, little-endian |
//! | 12 | 8 | the number of bytes after the header, little-endian |
//! | 20 | 32 | the key |
//! | 52 | 32 | the BLAKE3 hash of the bytes |

use std::fmt;

use bytes::Bytes;
use object_store::PutPayload;

use crate::{Content, Key};

const MAGIC: &[u8; 8] = b"VERNEobj";
const VERSION: u32 = 1;

/// The bytes before the content's.
pub(crate) const HEADER: usize = 84;

/// Why a file is no object of its key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Damage {
    /// It does not begin as an object of this version does.
    Foreign,
    /// It is another key's object.
    OtherKey,
    /// It is not as long as it says.
    Length,
    /// Its bytes are not those it was written with.
    Bytes,
}

/// How long the object of a content is, in bytes.
pub(crate) fn size(content: &Content) -> u64 {
    (HEADER + content.bytes.len()) as u64
}

/// The object, the content's bytes not copied.
pub(crate) fn wrap(key: &Key, content: &Content) -> PutPayload {
    let mut header = Vec::with_capacity(HEADER);
    header.extend_from_slice(MAGIC);
    header.extend_from_slice(&VERSION.to_le_bytes());
    header.extend_from_slice(&(content.bytes.len() as u64).to_le_bytes());
    header.extend_from_slice(key.as_bytes());
    header.extend_from_slice(content.hash.as_bytes());
    [Bytes::from(header), content.bytes.clone()].into_iter().collect()
}

/// The content of an object, its bytes not copied; or why they are not to be served. Reads every byte.
pub(crate) fn open(key: &Key, object: &Bytes) -> Result<Content, Damage> {
    let stated = head(key, object, object.len() as u64)?;
    let bytes = object.slice(HEADER..);
    let hash = blake3::hash(&bytes);
    if hash == stated { Ok(Content { bytes, hash }) } else { Err(Damage::Bytes) }
}

/// The hash that the header of a file of so many bytes states, if it is the header of the key's object.
pub(crate) fn head(key: &Key, start: &[u8], size: u64) -> Result<blake3::Hash, Damage> {
    let rest = start.strip_prefix(MAGIC).ok_or(Damage::Foreign)?;
    let (version, rest) = rest.split_first_chunk().ok_or(Damage::Foreign)?;
    if u32::from_le_bytes(*version) != VERSION {
        return Err(Damage::Foreign);
    }
    let (length, rest) = rest.split_first_chunk().ok_or(Damage::Length)?;
    let (stated, rest) = rest.split_first_chunk::<32>().ok_or(Damage::Length)?;
    let hash = rest.first_chunk::<32>().ok_or(Damage::Length)?;
    if stated != key.as_bytes() {
        return Err(Damage::OtherKey);
    }
    if size.checked_sub(HEADER as u64) != Some(u64::from_le_bytes(*length)) {
        return Err(Damage::Length);
    }
    Ok(blake3::Hash::from_bytes(*hash))
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Foreign => "not an object of this store",
            Self::OtherKey => "another key's object",
            Self::Length => "not as long as it says",
            Self::Bytes => "not the bytes it was written with",
        })
    }
}
