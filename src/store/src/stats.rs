//! Counts of what the store has done since it was opened.

use std::sync::atomic::{AtomicU64, Ordering};

/// Counts since the store was opened, and current sizes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Requests that memory answered, including those that waited for another caller's answer.
    pub memory_hits: u64,
    /// Requests that an object in the backing store answered.
    pub disk_hits: u64,
    /// Requests for absent contents.
    pub misses: u64,
    /// Bytes that count against the limit of the memory cache.
    pub memory_bytes: u64,
    /// Bytes of all objects on disk. `None` for a shared store: no process counts what the others write.
    pub disk_bytes: Option<u64>,
    /// Objects removed from disk to make room.
    pub evictions: u64,
    /// Objects that were not those that had been written.
    pub damaged: u64,
    /// Objects that could not be read for another reason than damage.
    pub read_failures: u64,
    /// Contents that could not be written, or not be entered in the index.
    pub write_failures: u64,
}

/// The counters behind [`Stats`].
#[derive(Default)]
pub(crate) struct Counters {
    pub(crate) memory_hits: Counter,
    pub(crate) disk_hits: Counter,
    pub(crate) misses: Counter,
    pub(crate) evictions: Counter,
    pub(crate) damaged: Counter,
    pub(crate) read_failures: Counter,
    pub(crate) write_failures: Counter,
}

impl Counters {
    /// Counts a request by its outcome, and by whether its caller looked in the backing store.
    pub(crate) fn count(&self, found: bool, was_read: bool) {
        let counter = match (found, was_read) {
            (false, _) => &self.misses,
            (true, true) => &self.disk_hits,
            (true, false) => &self.memory_hits,
        };
        counter.add(1);
    }
}

#[derive(Default)]
pub(crate) struct Counter(AtomicU64);

impl Counter {
    pub(crate) fn add(&self, more: u64) {
        self.0.fetch_add(more, Ordering::Relaxed);
    }

    pub(crate) fn get(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
}
