//! What the store has done since it was opened.

use std::sync::atomic::{AtomicU64, Ordering};

/// Counts since the store was opened, and sizes now.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Questions that memory answered, those that waited for another's answer included.
    pub memory_hits: u64,
    /// Questions that an object on disk, or in the shared store, answered.
    pub disk_hits: u64,
    /// Questions that nothing answered.
    pub misses: u64,
    /// Bytes that count against memory's bound.
    pub memory_bytes: u64,
    /// Bytes of all objects on disk. `None` for a shared store: no process counts what the others write.
    pub disk_bytes: Option<u64>,
    /// Objects removed from disk to make room.
    pub evictions: u64,
    /// Objects found that were not the one that was written.
    pub damaged: u64,
    /// Objects that could not be read for another reason than damage.
    pub read_failures: u64,
    /// Contents that could not be written, or not be entered in the index.
    pub write_failures: u64,
}

/// The counts behind [`Stats`].
#[derive(Default)]
pub(crate) struct Counts {
    pub(crate) memory_hits: Count,
    pub(crate) disk_hits: Count,
    pub(crate) misses: Count,
    pub(crate) evictions: Count,
    pub(crate) damaged: Count,
    pub(crate) read_failures: Count,
    pub(crate) write_failures: Count,
}

#[derive(Default)]
pub(crate) struct Count(AtomicU64);

impl Count {
    pub(crate) fn add(&self, more: u64) {
        self.0.fetch_add(more, Ordering::Relaxed);
    }

    pub(crate) fn get(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
}
