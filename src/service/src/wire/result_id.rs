//! The id of a result: the hash of the question that it answers.

use std::fmt;
use std::str::FromStr;

use serde::{Serialize, Serializer};
use verne_jobs::JobId;
use verne_store::Key;

use crate::wire::answer::MachineId;

/// BLAKE3 of a question, its machine and the solver's version; 64 hexadecimal digits to readers. The job that makes
/// the result has the same id.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ResultId(blake3::Hash);

impl ResultId {
    /// The job that makes the result.
    pub(crate) fn job(self) -> JobId {
        JobId::from_bytes(*self.0.as_bytes())
    }

    /// The key of a named part of the result.
    pub(crate) fn key(self, part: &str) -> Key {
        let mut hasher = blake3::Hasher::new();
        hasher.update(self.0.as_bytes()).update(part.as_bytes());
        hasher.finalize().into()
    }

    /// The id of a question's answer: of a layout of bytes, this version of the solver, the question's numbers, and the
    /// machine; its name and description count here, as the answer shows them.
    pub(crate) fn of(
        layout: &[u8],
        machine: &MachineId,
        description: &str,
        numbers: impl IntoIterator<Item = f64>,
    ) -> Self {
        let mut hasher = blake3::Hasher::new();
        hasher.update(layout).update(env!("CARGO_PKG_VERSION").as_bytes());
        for number in numbers {
            hasher.update(&number.to_le_bytes());
        }
        for text in [&*machine.hash, &*machine.name, description] {
            // Hashed by itself, a text cannot run into the next one.
            hasher.update(blake3::hash(text.as_bytes()).as_bytes());
        }
        Self(hasher.finalize())
    }

    /// The path of the result.
    pub(crate) fn path(self) -> String {
        format!("/workspace/{self}")
    }
}

impl From<blake3::Hash> for ResultId {
    fn from(hash: blake3::Hash) -> Self {
        Self(hash)
    }
}

impl From<JobId> for ResultId {
    fn from(id: JobId) -> Self {
        Self(blake3::Hash::from_bytes(*id.as_bytes()))
    }
}

/// A text is not an id.
#[derive(Debug)]
pub(crate) struct NoId;

impl FromStr for ResultId {
    type Err = NoId;

    fn from_str(text: &str) -> Result<Self, NoId> {
        // Ids are written in lower case; one result has one address.
        let lower = !text.bytes().any(|byte| byte.is_ascii_uppercase());
        blake3::Hash::from_hex(text).ok().filter(|_| lower).map(Self).ok_or(NoId)
    }
}

impl fmt::Display for ResultId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.0.to_hex())
    }
}

impl Serialize for ResultId {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.0.to_hex())
    }
}
