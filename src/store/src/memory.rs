//! The layer in memory.

use moka::future::Cache;
use moka::policy::EvictionPolicy;

use crate::{Content, Key};

/// moka counts in 32 bits: in these units they reach 4 TiB.
const UNIT: u64 = 1 << 10;

/// What an entry takes beside its bytes: key, hash, and the nodes and counts of two tables. Rounded up.
const ENTRY: u64 = 512;

pub(crate) type Memory = Cache<Key, Content>;

/// A cache of so many bytes, entries' own overhead included. Least recently used and not least frequently: the
/// newest result is about to be fetched, and where there is no disk it is nowhere else.
pub(crate) fn of_size(bytes: u64) -> Memory {
    Cache::builder()
        .max_capacity(bytes / UNIT)
        .weigher(|_, content: &Content| {
            u32::try_from((content.bytes.len() as u64 + ENTRY).div_ceil(UNIT)).unwrap_or(u32::MAX)
        })
        .eviction_policy(EvictionPolicy::lru())
        .build()
}

/// The bytes that the cache counts against its bound.
pub(crate) fn size(memory: &Memory) -> u64 {
    memory.weighted_size() * UNIT
}
