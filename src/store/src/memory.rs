//! The layer in memory.

use std::sync::Arc;

use moka::future::Cache;
use moka::policy::EvictionPolicy;

use crate::{Content, Key};

/// moka counts in 32 bits: in these units they reach 4 TiB.
const UNIT: u64 = 1 << 10;

/// What an entry takes beside its bytes: key, hash, and the nodes and counts of two tables. Rounded up.
const ENTRY: u64 = 512;

#[derive(Clone)]
pub(crate) struct Memory(Cache<Key, Content>);

impl Memory {
    /// A cache of so many bytes, entries' own overhead included. Least recently used and not least frequently:
    /// the newest result is about to be fetched, and where there is no disk it is nowhere else.
    pub(crate) fn of_size(bytes: u64) -> Self {
        Self(
            Cache::builder()
                .max_capacity(bytes / UNIT)
                .weigher(|_, content: &Content| weight(content))
                .eviction_policy(EvictionPolicy::lru())
                .build(),
        )
    }

    /// The bytes that count against the bound.
    pub(crate) fn size(&self) -> u64 {
        self.0.weighted_size() * UNIT
    }

    pub(crate) async fn get(&self, key: &Key) -> Option<Content> {
        self.0.get(key).await
    }

    /// Remembers a content, unless it alone is more than there is room for.
    pub(crate) async fn insert(&self, key: Key, content: Content) {
        let room = self.0.policy().max_capacity();
        if room.is_some_and(|room| u64::from(weight(&content)) <= room) {
            self.0.insert(key, content).await;
        } else {
            self.0.invalidate(&key).await;
        }
        self.let_go().await;
    }

    pub(crate) async fn forget(&self, key: &Key) {
        self.0.invalidate(key).await;
        self.let_go().await;
    }

    /// The content of a key. Of many callers at once one finds; if it finds nothing, so do the others.
    pub(crate) async fn get_or_find(
        &self,
        key: Key,
        find: impl Future<Output = Option<Content>>,
    ) -> Option<Content> {
        // moka moves it several times, and every caller's future has room for each.
        let found = self.0.optionally_get_with(key, Box::pin(find)).await;
        self.let_go().await;
        found
    }

    /// The same where what is not there is made. A failure is that of all who waited.
    pub(crate) async fn get_or_make<E: Clone + Send + Sync + 'static>(
        &self,
        key: Key,
        make: impl Future<Output = Result<Content, E>>,
    ) -> Result<Content, E> {
        let made = self.0.try_get_with(key, Box::pin(make)).await;
        self.let_go().await;
        made.map_err(Arc::unwrap_or_clone)
    }

    /// Lets go of what does not fit. moka would evict with some later call, and destroy what it evicted with
    /// some later one still, when up to 64 of the kind have gathered: gigabytes, of our size.
    async fn let_go(&self) {
        self.0.run_pending_tasks().await;
        // Garbage is destroyed two epochs after it was left.
        for _ in 0..3 {
            crossbeam_epoch::pin().flush();
        }
    }
}

/// In units; what no 32 bits count has no room anywhere.
fn weight(content: &Content) -> u32 {
    u32::try_from((content.bytes.len() as u64 + ENTRY).div_ceil(UNIT)).unwrap_or(u32::MAX)
}
