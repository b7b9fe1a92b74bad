use std::fmt;

use blake3::Hash;

/// What every key begins with, so that one that has leaked is found by a search.
const PREFIX: &str = "verne_";

/// A key: 256 random bits. Nobody guesses those, however fast a hash is computed; so a fast one is kept.
pub(crate) struct Key(String);

impl Key {
    /// A fresh one from the system's random numbers.
    pub(crate) fn fresh() -> Result<Self, getrandom::Error> {
        let mut bits = [0; 32];
        getrandom::fill(&mut bits)?;
        // A hash prints as the hexadecimal digits of its bytes.
        Ok(Self(format!("{PREFIX}{}", Hash::from_bytes(bits).to_hex())))
    }

    /// What the file of keys holds.
    pub(crate) fn hash(&self) -> Hash {
        Self::hash_of(&self.0)
    }

    /// The text without what may be a key in it.
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

    /// The hash of what a client sent as its key. Compared in constant time, as [`Hash`] does.
    pub(crate) fn hash_of(sent: &str) -> Hash {
        blake3::hash(sent.as_bytes())
    }
}

/// The text that its owner sends: to be shown once, and never to be logged.
impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
