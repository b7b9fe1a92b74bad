//! The key of a content, and the location of its object.

use std::fmt;

use object_store::path::Path;

/// The key of a content: 32 bytes that the caller chooses, usually the hash of a request.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Key([u8; 32]);

impl Key {
    /// The key's bytes.
    pub const fn as_bytes(&self) -> &[u8; 32] {
        &self.0
    }

    /// The location of the key's object: the first two digits, a slash, and the other 62.
    pub(crate) fn location(&self) -> Path {
        let digits = self.to_string();
        let (directory, name) = digits.split_at(2);
        Path::from_iter([directory, name])
    }

    /// The key whose object has a location, if there is one.
    pub(crate) fn at(location: &Path) -> Option<Self> {
        let digits: String = location.as_ref().split('/').collect();
        let key = Self::from(blake3::Hash::from_hex(digits).ok()?);
        // Upper case and other divisions of the digits can be parsed, but no object has such a location.
        (key.location() == *location).then_some(key)
    }
}

impl From<[u8; 32]> for Key {
    fn from(bytes: [u8; 32]) -> Self {
        Self(bytes)
    }
}

impl From<blake3::Hash> for Key {
    fn from(hash: blake3::Hash) -> Self {
        Self(*hash.as_bytes())
    }
}

/// 64 hexadecimal digits in lower case.
impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&blake3::Hash::from_bytes(self.0).to_hex())
    }
}

impl fmt::Debug for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Key({self})")
    }
}
