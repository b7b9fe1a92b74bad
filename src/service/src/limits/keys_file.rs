//! The file of API keys: a TOML table `[[key]]` for each key.

use std::collections::HashMap;
use std::fmt;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use blake3::Hash;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::limits::key::Key;
use crate::limits::rate::{Rate, TokenBucket};
use crate::limits::toml_error;
use crate::wire::role::Role;

/// Most characters of a name.
const NAME_LENGTH: usize = 64;

/// The holder of a key.
#[derive(Debug)]
pub(crate) struct KeyHolder {
    /// The name of the client. Keys with the same name are one client, so that its key can be replaced without a gap.
    pub name: String,
    /// The role.
    pub role: Role,
    /// The rate. The bucket is full again after the file was read again.
    pub bucket: Option<Arc<TokenBucket>>,
}

/// Holders by the hashes of their keys.
pub(crate) type KeyTable = HashMap<Hash, Arc<KeyHolder>>;

/// Why a file of keys cannot be used. The message masks keys that the file contains by mistake.
#[derive(Debug)]
pub struct KeysFileError {
    path: PathBuf,
    /// The entry.
    location: Option<String>,
    reason: String,
}

impl fmt::Display for KeysFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.path.display())?;
        if let Some(location) = &self.location {
            write!(f, "{}: ", Key::masked(location))?;
        }
        f.write_str(&Key::masked(&self.reason))
    }
}

impl std::error::Error for KeysFileError {}

impl KeysFileError {
    /// The thread that read the file failed.
    pub(crate) fn read_failed(path: &Path) -> Self {
        Self { path: path.to_owned(), location: None, reason: "the read failed".to_owned() }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    #[serde(default)]
    key: Vec<toml::Table>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    #[serde(deserialize_with = "name")]
    name: String,
    role: Role,
    #[serde(deserialize_with = "hash")]
    hash: Hash,
    rate: Option<u32>,
    rate_burst: Option<NonZeroU32>,
}

impl Entry {
    /// The rate of the key, or the default.
    fn rate(&self, default: Option<Rate>) -> Option<Rate> {
        self.rate.map_or(default, |second| Rate::new(second, self.rate_burst))
    }
}

/// Reads the keys of a file. `default` applies to keys without a rate of their own.
pub(crate) fn read(path: &Path, default: Option<Rate>) -> Result<KeyTable, KeysFileError> {
    let unreadable = |error: std::io::Error| KeysFileError {
        path: path.to_owned(),
        location: None,
        reason: error.to_string(),
    };
    parse(path, &std::fs::read_to_string(path).map_err(unreadable)?, default)
}

/// Reads the keys of the text of a file.
pub(crate) fn parse(path: &Path, text: &str, default: Option<Rate>) -> Result<KeyTable, KeysFileError> {
    let bad = |location, reason| KeysFileError { path: path.to_owned(), location, reason };
    let Document { key } =
        toml::from_str(text).map_err(|error| bad(None, toml_error::describe(&error, text)))?;
    let mut keys = KeyTable::new();
    for (i, entry) in key.into_iter().enumerate() {
        let location = location(i + 1, &entry);
        let entry: Entry = serde_path_to_error::deserialize(toml::Value::Table(entry)).map_err(|error| {
            let field = error.path().to_string();
            let location = if field == "." { location.clone() } else { format!("{location}: {field}") };
            bad(Some(location), error.inner().message().to_owned())
        })?;
        if entry.rate.is_none() && entry.rate_burst.is_some() {
            return Err(bad(Some(format!("{location}: rate_burst")), "needs a rate".to_owned()));
        }
        let bucket = entry.rate(default).map(|rate| Arc::new(TokenBucket::new(rate)));
        let holder = Arc::new(KeyHolder { name: entry.name, role: entry.role, bucket });
        if keys.insert(entry.hash, holder).is_some() {
            return Err(bad(Some(location), "its hash is that of an earlier entry".to_owned()));
        }
    }
    if keys.is_empty() { Err(bad(None, "has no entry [[key]]".to_owned())) } else { Ok(keys) }
}

/// Names an entry in a message.
fn location(number: usize, entry: &toml::Table) -> String {
    match entry.get("name").and_then(toml::Value::as_str).filter(|name| is_name(name)) {
        Some(name) => format!("key {number} ({name})"),
        None => format!("key {number}"),
    }
}

/// Whether it is a valid name. Names begin with a letter: so they differ from addresses, which name clients without
/// keys.
pub(crate) fn is_name(name: &str) -> bool {
    (1..=NAME_LENGTH).contains(&name.len())
        && name.starts_with(|first: char| first.is_ascii_alphabetic())
        && name.chars().all(|c| c.is_ascii_alphanumeric() || ".-_".contains(c))
}

fn name<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    let name = String::deserialize(deserializer)?;
    let expected = format!("must be 1 to {NAME_LENGTH} letters, digits or .-_, beginning with a letter");
    if is_name(&name) { Ok(name) } else { Err(D::Error::custom(expected)) }
}

fn hash<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Hash, D::Error> {
    let expected = || D::Error::custom("must be the 64 hexadecimal digits of the key's BLAKE3 hash");
    let text = String::deserialize(deserializer)?;
    Hash::from_hex(text).map_err(|_| expected())
}
