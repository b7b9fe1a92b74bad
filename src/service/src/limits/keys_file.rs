//! The file of keys: one TOML table `[[key]]` for each.

use std::collections::HashMap;
use std::fmt;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use blake3::Hash;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::limits::key::Key;
use crate::limits::rate::{Bucket, Rate};
use crate::limits::toml_error;
use crate::wire::role::Role;

/// Most characters in a name.
const NAME_LENGTH: usize = 64;

/// Whose key it is, and what it is good for.
#[derive(Debug)]
pub(crate) struct Holder {
    /// The client of the queue. Two keys of one name are one client: so a key is replaced without a gap.
    pub name: String,
    /// What it may.
    pub role: Role,
    /// How fast it may ask. Full again when the file is read again.
    pub bucket: Option<Bucket>,
}

/// Holders by the hashes of their keys.
pub(crate) type Table = HashMap<Hash, Arc<Holder>>;

/// Why a file of keys cannot be used. Tells no key that stands in it by mistake.
#[derive(Debug)]
pub struct BadKeys {
    path: PathBuf,
    /// Which entry.
    place: Option<String>,
    reason: String,
}

impl fmt::Display for BadKeys {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.path.display())?;
        if let Some(place) = &self.place {
            write!(f, "{}: ", Key::masked(place))?;
        }
        f.write_str(&Key::masked(&self.reason))
    }
}

impl std::error::Error for BadKeys {}

impl BadKeys {
    /// The thread that read it was lost.
    pub(crate) fn lost(path: &Path) -> Self {
        Self { path: path.to_owned(), place: None, reason: "the read failed".to_owned() }
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
    /// The key's own, or that of all.
    fn rate(&self, default: Option<Rate>) -> Option<Rate> {
        self.rate.map_or(default, |second| Rate::new(second, self.rate_burst))
    }
}

/// The keys of a file; `default` limits those that have no rate of their own.
pub(crate) fn read(path: &Path, default: Option<Rate>) -> Result<Table, BadKeys> {
    let bad = |place, reason| BadKeys { path: path.to_owned(), place, reason };
    let text = std::fs::read_to_string(path).map_err(|error| bad(None, error.to_string()))?;
    let Document { key } =
        toml::from_str(&text).map_err(|error| bad(None, toml_error::describe(&error, &text)))?;
    let mut keys = Table::new();
    for (i, entry) in key.into_iter().enumerate() {
        let place = place(i + 1, &entry);
        let entry: Entry = serde_path_to_error::deserialize(toml::Value::Table(entry)).map_err(|error| {
            let field = error.path().to_string();
            let place = if field == "." { place.clone() } else { format!("{place}: {field}") };
            bad(Some(place), error.inner().message().to_owned())
        })?;
        if entry.rate.is_none() && entry.rate_burst.is_some() {
            return Err(bad(Some(format!("{place}: rate_burst")), "needs a rate".to_owned()));
        }
        let bucket = entry.rate(default).map(Bucket::new);
        let holder = Arc::new(Holder { name: entry.name, role: entry.role, bucket });
        if keys.insert(entry.hash, holder).is_some() {
            return Err(bad(Some(place), "its hash is that of an earlier entry".to_owned()));
        }
    }
    if keys.is_empty() { Err(bad(None, "has no entry [[key]]".to_owned())) } else { Ok(keys) }
}

fn place(number: usize, entry: &toml::Table) -> String {
    match entry.get("name").and_then(toml::Value::as_str).filter(|name| is_name(name)) {
        Some(name) => format!("key {number} ({name})"),
        None => format!("key {number}"),
    }
}

/// Begins with a letter: addresses, the clients of a service without keys, do not, or have colons.
pub(crate) fn is_name(name: &str) -> bool {
    (1..=NAME_LENGTH).contains(&name.len())
        && name.starts_with(|first: char| first.is_ascii_alphabetic())
        && name.chars().all(|c| c.is_ascii_alphanumeric() || ".-_".contains(c))
}

fn name<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    let name = String::deserialize(deserializer)?;
    let wanted = format!("must be 1 to {NAME_LENGTH} letters, digits or .-_, beginning with a letter");
    if is_name(&name) { Ok(name) } else { Err(D::Error::custom(wanted)) }
}

fn hash<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Hash, D::Error> {
    let wanted = || D::Error::custom("must be the 64 hexadecimal digits of the key's BLAKE3 hash");
    let text = String::deserialize(deserializer)?;
    Hash::from_hex(text).map_err(|_| wanted())
}
