//! The id of a result.

use std::fmt;
use std::str::FromStr;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use verne_jobs::{JobId, ParseJobIdError};
use verne_store::Key;

use crate::wire::answer::MachineId;

/// Version and target of this binary. Both are part of every id: the last digits of sin and atan2 differ between C
/// libraries, so the same question to a binary for another target is another question.
pub(crate) const BUILD: &str = concat!(env!("CARGO_PKG_VERSION"), " (", env!("VERNE_TARGET"), ")");

/// The id of a result: BLAKE3 of its question, the machine, and the version and the target of the binary, written as 64
/// hexadecimal digits. The job that computes the result has the same id.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ResultId(JobId);

impl ResultId {
    /// The id of the job that computes the result.
    pub(crate) fn job(self) -> JobId {
        self.0
    }

    /// The key of a blob of the result.
    pub(crate) fn key(self, blob: &str) -> Key {
        let mut hasher = blake3::Hasher::new();
        hasher.update(self.0.as_bytes()).update(blob.as_bytes());
        hasher.finalize().into()
    }

    /// Begins the hash of an id: a prefix for the kind of question or file, and the build.
    pub(crate) fn hasher(prefix: &[u8]) -> blake3::Hasher {
        hasher_of(prefix, BUILD)
    }

    /// The id of the answer to a question: the hash of a prefix for the kind of question, the build, the numbers of the
    /// question, and the machine. Name and description of the machine count, because the answer shows them.
    pub(crate) fn of(
        prefix: &[u8],
        machine: &MachineId,
        description: &str,
        numbers: impl IntoIterator<Item = f64>,
    ) -> Self {
        let mut hasher = Self::hasher(prefix);
        for number in numbers {
            hasher.update(&number.to_le_bytes());
        }
        for text in [&*machine.hash, &*machine.name, description] {
            // A hash has a fixed length, so the texts cannot run into each other.
            hasher.update(blake3::hash(text.as_bytes()).as_bytes());
        }
        hasher.finalize().into()
    }

    /// The id of the answer to a question that is given as text: as for [`ResultId::of`].
    pub(crate) fn of_text(prefix: &[u8], machine: &MachineId, description: &str, question: &[u8]) -> Self {
        let mut hasher = Self::hasher(prefix);
        for text in [question, machine.hash.as_bytes(), machine.name.as_bytes(), description.as_bytes()] {
            hasher.update(blake3::hash(text).as_bytes());
        }
        hasher.finalize().into()
    }

    /// The path of a workspace, a family or a map.
    pub(crate) fn path(self) -> String {
        format!("/workspace/{self}")
    }

    /// The path of a tool path.
    pub(crate) fn toolpath(self) -> String {
        format!("/toolpath/{self}")
    }
}

fn hasher_of(prefix: &[u8], build: &str) -> blake3::Hasher {
    let mut hasher = blake3::Hasher::new();
    // A hash has a fixed length, so that a build cannot run into what follows.
    hasher.update(prefix).update(blake3::hash(build.as_bytes()).as_bytes());
    hasher
}

impl From<blake3::Hash> for ResultId {
    fn from(hash: blake3::Hash) -> Self {
        Self(JobId::from_bytes(*hash.as_bytes()))
    }
}

impl From<JobId> for ResultId {
    fn from(id: JobId) -> Self {
        Self(id)
    }
}

impl FromStr for ResultId {
    type Err = ParseJobIdError;

    fn from_str(text: &str) -> Result<Self, ParseJobIdError> {
        text.parse().map(Self)
    }
}

impl fmt::Display for ResultId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.0.to_string())
    }
}

impl Serialize for ResultId {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&self.0)
    }
}

impl<'de> Deserialize<'de> for ResultId {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = std::borrow::Cow::<'de, str>::deserialize(deserializer)?;
        text.parse().map_err(|_| D::Error::custom("must be the 64 hexadecimal digits of an id"))
    }
}

#[cfg(test)]
mod tests {
    use super::{BUILD, ResultId, hasher_of};

    #[test]
    fn binaries_of_another_version_or_target_have_other_ids() {
        let id = |build: &str| ResultId::from(hasher_of(b"verne test 1", build).finalize());
        let builds = [
            "0.1.0 (x86_64-unknown-linux-gnu)",
            "0.1.0 (x86_64-unknown-linux-musl)",
            "0.1.1 (x86_64-unknown-linux-gnu)",
        ];
        for (i, build) in builds.iter().enumerate() {
            assert!(builds.iter().skip(i + 1).all(|other| id(build) != id(other)), "{build}");
        }
        assert_eq!(id(BUILD), ResultId::from(ResultId::hasher(b"verne test 1").finalize()));
    }

    #[test]
    fn the_build_names_version_and_target() {
        assert!(
            BUILD.starts_with(env!("CARGO_PKG_VERSION")) && BUILD.contains(std::env::consts::ARCH),
            "{BUILD}"
        );
    }
}
