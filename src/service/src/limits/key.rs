//! An API key: how it is generated, hashed, and masked in messages.

use std::fmt;

use blake3::Hash;

/// The prefix of every key, by which a search finds leaked keys.
const PREFIX: &str = "verne_";

/// A key of 256 random bits. Nobody can guess it, so a fast hash is safe.
pub(crate) struct Key(String);

impl Key {
    /// Generates a key from the system's random numbers.
    pub(crate) fn generate() -> Result<Self, getrandom::Error> {
        let mut bits = [0; 32];
        getrandom::fill(&mut bits)?;
        // The hexadecimal digits of the bytes.
        Ok(Self(format!("{PREFIX}{}", Hash::from_bytes(bits).to_hex())))
    }

    /// The hash, which the file of keys has instead of the key.
    pub(crate) fn hash(&self) -> Hash {
        Self::hash_of(&self.0)
    }

    /// The text with everything masked that may be a key.
    pub(crate) fn masked(text: &str) -> String {
        let mut parts = text.split(PREFIX);
        let mut masked = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            masked.push_str(PREFIX);
            masked.push('…');
            masked.push_str(part.trim_start_matches(|c: char| c.is_ascii_hexdigit()));
        }
        masked
    }

    /// The hash of a key that a client sent. [`Hash`] compares in constant time.
    pub(crate) fn hash_of(sent: &str) -> Hash {
        blake3::hash(sent.as_bytes())
    }
}

/// The key as its owner sends it. Show it once, and never log it.
impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
