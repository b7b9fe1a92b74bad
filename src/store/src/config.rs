//! The configuration of a store, and what it guarantees for a content.

use std::path::PathBuf;

/// The directory of a store, and its limits.
#[derive(Clone, Debug)]
pub struct Config {
    /// The directory, created if it does not exist. `None`: contents are in memory only.
    pub directory: Option<PathBuf>,
    /// Greatest size of the memory cache, bytes. Contents that callers hold themselves are not counted.
    pub memory_bytes: u64,
    /// Greatest sum of the sizes of all objects on disk, bytes. The index, some 100 bytes per object, is not counted.
    pub disk_bytes: u64,
}

/// How long a content stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Durability {
    /// It is flushed to disk and survives a restart, until it is evicted. Or it is in the shared store, where every
    /// process finds it until it expires.
    Durable,
    /// It is in memory until it is evicted: the store has no disk, the disk or the shared store refused it, or it is
    /// larger than the limit of the disk. An older object of the key still exists.
    MemoryOnly,
}
