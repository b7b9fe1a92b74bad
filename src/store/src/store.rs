//! The store: memory before disk.

use std::path::PathBuf;
use std::sync::Arc;

use bytes::Bytes;
use object_store::ObjectStore;

use crate::disk::Disk;
use crate::held::Held;
use crate::memory::{self, Memory};
use crate::stats::Counts;
use crate::{Content, Key, OpenError, Stats};

/// Where results are kept, and how many bytes of them.
#[derive(Clone, Debug)]
pub struct Config {
    /// Where they are kept across restarts; made if it is not there. `None`: nowhere.
    pub directory: Option<PathBuf>,
    /// How many bytes memory holds. What callers hold themselves is not counted.
    pub memory_bytes: u64,
    /// How many bytes the objects on disk have together. The index is not counted: some 100 bytes an object.
    pub disk_bytes: u64,
}

/// How long a content that was put stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// It is flushed to disk: a restart does not lose it, only the need for room.
    Durable,
    /// It is in memory: there is no disk, the disk refused it, or it is larger than the disk's bound.
    MemoryOnly,
}

/// Results under content keys. Its clones are one store.
#[derive(Clone)]
pub struct Store {
    memory: Memory,
    held: Held,
    disk: Option<Arc<Disk>>,
    counts: Arc<Counts>,
}

impl Store {
    /// Opens the configured directory, or a store in memory if there is none. After a crash the index is made to
    /// agree with the objects first.
    pub async fn open(config: &Config) -> Result<Self, OpenError> {
        Self::build(config, None).await
    }

    /// The same with the objects elsewhere than in the directory, which holds the index of them. The index
    /// knows of no other writer: one store at a time.
    pub async fn open_over(config: &Config, objects: Arc<dyn ObjectStore>) -> Result<Self, OpenError> {
        Self::build(config, Some(objects)).await
    }

    /// A store of so many bytes that lasts as long as the process.
    pub fn in_memory(memory_bytes: u64) -> Self {
        Self {
            memory: memory::of_size(memory_bytes),
            held: Held::default(),
            disk: None,
            counts: Arc::default(),
        }
    }

    async fn build(config: &Config, objects: Option<Arc<dyn ObjectStore>>) -> Result<Self, OpenError> {
        let mut store = Self::in_memory(config.memory_bytes);
        if let Some(directory) = &config.directory {
            let counts = Arc::clone(&store.counts);
            store.disk = Some(Disk::open(directory, objects, config.disk_bytes, counts).await?);
        }
        Ok(store)
    }

    /// The content of a key, if it is kept. An object that is damaged or cannot be read is logged, counted and
    /// as if not there.
    pub async fn get(&self, key: &Key) -> Option<Content> {
        if let Some(content) = self.remembered(key).await {
            return Some(content);
        }
        let mut ran = false;
        let content = self.memory.optionally_get_with(*key, async {
            ran = true;
            self.load(*key).await
        });
        let content = content.await;
        if ran {
            self.trim().await;
        } else {
            let count = if content.is_some() { &self.counts.memory_hits } else { &self.counts.misses };
            count.add(1);
        }
        content
    }

    /// Keeps bytes under a key, in place of what was there. A disk that fails is logged and counted: the content
    /// is in memory all the same.
    pub async fn put(&self, key: &Key, bytes: Bytes) -> (Content, Kept) {
        let content = self.held.share(*key, Content::of(bytes).await);
        self.memory.insert(*key, content.clone()).await;
        self.trim().await;
        let kept = self.write(*key, &content).await;
        (content, kept)
    }

    /// The content of a key; if it is not kept, `make` makes it. Of many callers at once one makes it and all have
    /// the one answer; if that caller is dropped, another takes over. A failure is answered to those who wait
    /// now and not remembered. Callers whose errors are of different types do not wait for each other.
    pub async fn get_or_make<E: Clone + Send + Sync + 'static>(
        &self,
        key: &Key,
        make: impl Future<Output = Result<Bytes, E>> + Send,
    ) -> Result<Content, E> {
        if let Some(content) = self.remembered(key).await {
            return Ok(content);
        }
        let mut ran = false;
        let content = self.memory.try_get_with(*key, async {
            ran = true;
            if let Some(content) = self.get(key).await {
                return Ok(content);
            }
            let content = self.held.share(*key, Content::of(make.await?).await);
            self.write(*key, &content).await;
            Ok(content)
        });
        let content = content.await.map_err(Arc::unwrap_or_clone);
        if ran {
            self.trim().await;
        } else if content.is_ok() {
            self.counts.memory_hits.add(1);
        }
        content
    }

    /// What the store has done, and how large it is.
    pub fn stats(&self) -> Stats {
        let counts = &self.counts;
        Stats {
            memory_hits: counts.memory_hits.get(),
            disk_hits: counts.disk_hits.get(),
            misses: counts.misses.get(),
            memory_bytes: memory::size(&self.memory),
            disk_bytes: self.disk.as_ref().map_or(0, |disk| disk.total()),
            evictions: counts.evictions.get(),
            damaged: counts.damaged.get(),
            read_failures: counts.read_failures.get(),
            write_failures: counts.write_failures.get(),
        }
    }

    /// Whether the disk, if there is one, takes an object now; asked again after a few seconds at the earliest.
    pub async fn healthy(&self) -> Result<(), String> {
        match &self.disk {
            Some(disk) => disk.healthy().await,
            None => Ok(()),
        }
    }

    /// What memory holds.
    async fn remembered(&self, key: &Key) -> Option<Content> {
        let content = self.memory.get(key).await?;
        self.counts.memory_hits.add(1);
        self.touch(*key).await;
        Some(content)
    }

    /// What somebody holds though memory does not, or what lies on disk.
    async fn load(&self, key: Key) -> Option<Content> {
        if let Some(content) = self.held.get(&key) {
            self.counts.memory_hits.add(1);
            self.touch(key).await;
            return Some(content);
        }
        let read = match &self.disk {
            Some(disk) => disk.read(key).await,
            None => None,
        };
        let Some(content) = read else {
            self.counts.misses.add(1);
            return None;
        };
        self.counts.disk_hits.add(1);
        self.touch(key).await;
        Some(self.held.share(key, content))
    }

    async fn write(&self, key: Key, content: &Content) -> Kept {
        match &self.disk {
            Some(disk) if disk.write(key, content).await => Kept::Durable,
            _ => Kept::MemoryOnly,
        }
    }

    async fn touch(&self, key: Key) {
        if let Some(disk) = &self.disk {
            disk.touch(key).await;
        }
    }

    /// Holds memory to its bound at once: moka would let go of what does not fit with some later call.
    async fn trim(&self) {
        self.memory.run_pending_tasks().await;
    }
}
