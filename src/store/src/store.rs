//! The store: memory before what lies below.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use bytes::Bytes;
use object_store::ObjectStore;

use crate::below::{Below, Layer};
use crate::disk::Disk;
use crate::found::{Found, WHOLE};
use crate::held::Held;
use crate::memory::Memory;
use crate::objects::Object;
use crate::shared::Shared;
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
    /// It is flushed to disk: a restart does not lose it, only the need for room. Or the shared store has it:
    /// every process finds it there until it expires.
    Durable,
    /// It is in memory until that needs the room: there is no disk, the disk or the shared store refused it, or
    /// it is larger than the disk's bound. What lay there under the key before still does.
    MemoryOnly,
}

/// Results under content keys. Its clones are one store.
#[derive(Clone)]
pub struct Store {
    memory: Memory,
    held: Held,
    below: Option<Below>,
    counts: Arc<Counts>,
}

impl Store {
    /// Opens the configured directory, or a store in memory if there is none. After a crash the index is made to
    /// agree with the objects first.
    pub async fn open(config: &Config) -> Result<Self, OpenError> {
        match &config.directory {
            Some(directory) => Self::build(directory, None, config.memory_bytes, config.disk_bytes).await,
            None => Ok(Self::in_memory(config.memory_bytes)),
        }
    }

    /// Opens a store whose objects lie elsewhere than in the directory, which holds the index of them. The index
    /// knows of no other writer: one store at a time.
    pub async fn open_over(
        objects: Arc<dyn ObjectStore>,
        directory: &Path,
        memory_bytes: u64,
        disk_bytes: u64,
    ) -> Result<Self, OpenError> {
        Self::build(directory, Some(objects), memory_bytes, disk_bytes).await
    }

    /// Opens the store at an address, which many processes share: `s3://bucket/prefix`, or
    /// `file:///shared/directory`, which [`Store::init_shared`] has prepared. The crate's description says what such a
    /// store holds and what it does not. Endpoint, region and credentials of S3 are those of the environment:
    /// `AWS_ENDPOINT`, `AWS_REGION`, `AWS_ACCESS_KEY_ID`, `AWS_SECRET_ACCESS_KEY`, `AWS_ALLOW_HTTP` and the
    /// others that [`object_store::aws::AmazonS3Builder::from_env`] reads.
    pub async fn open_shared(address: &str, memory_bytes: u64) -> Result<Self, OpenError> {
        let store = Self::in_memory(memory_bytes);
        let shared = Shared::open(address, Arc::clone(&store.counts)).await?;
        Ok(store.over(Layer::Shared(shared)))
    }

    /// Prepares the directory at an address `file:///shared/directory`: makes it, and the marker file without which no
    /// store is opened there. The marker tells the directory from the mount point of a file system that is not mounted.
    /// Answers whether the marker was made; if it is there already, nothing is changed. Blocks on files.
    pub fn init_shared(address: &str) -> Result<bool, OpenError> {
        Shared::init(address)
    }

    /// Opens a shared store whose objects lie where the caller says.
    pub async fn open_shared_over(
        objects: Arc<dyn ObjectStore>,
        memory_bytes: u64,
    ) -> Result<Self, OpenError> {
        let store = Self::in_memory(memory_bytes);
        let shared = Shared::open_over(objects, Arc::clone(&store.counts)).await?;
        Ok(store.over(Layer::Shared(shared)))
    }

    /// A store of so many bytes that lasts as long as the process.
    pub fn in_memory(memory_bytes: u64) -> Self {
        Self {
            memory: Memory::of_size(memory_bytes),
            held: Held::default(),
            below: None,
            counts: Arc::default(),
        }
    }

    async fn build(
        directory: &Path,
        objects: Option<Arc<dyn ObjectStore>>,
        memory_bytes: u64,
        disk_bytes: u64,
    ) -> Result<Self, OpenError> {
        let store = Self::in_memory(memory_bytes);
        let disk = Disk::open(directory, objects, disk_bytes, Arc::clone(&store.counts)).await?;
        Ok(store.over(Layer::Disk(disk)))
    }

    fn over(mut self, layer: Layer) -> Self {
        self.below = Some(Below::new(layer, Arc::clone(&self.counts)));
        self
    }

    /// The content of a key, if it is kept. An object that is damaged or cannot be read is logged, counted and
    /// as if not there.
    pub async fn get(&self, key: &Key) -> Option<Content> {
        if let Some(content) = self.remembered(key).await {
            return Some(content);
        }
        let mut looked = false;
        let content = self.memory.get_or_find(*key, self.read(*key, &mut looked)).await;
        self.count(content.is_some(), looked);
        content
    }

    /// The content of a key, to be read as far as it is wanted: what is large and not in memory is not brought
    /// there. Otherwise as [`Store::get`]; damage beyond the header shows when the content is read.
    pub async fn find(&self, key: &Key) -> Option<Found> {
        if let Some(content) = self.remembered(key).await {
            return Some(content.into());
        }
        let mut looked = false;
        let small = self.memory.get_or_make(*key, self.read_small(*key, &mut looked)).await;
        let found = match (small, &self.below) {
            (Ok(content), _) => Some(content.into()),
            (Err(NotRead::Large(object)), Some(below)) => Some(Found::below(object, below.clone())),
            _ => None,
        };
        self.count(found.is_some(), looked);
        found
    }

    /// Keeps bytes under a key, in place of what was there. A disk that fails is logged and counted: the content
    /// is in memory all the same. What a shared store does not take is not: this process would believe it to be where
    /// others do not find it.
    pub async fn put(&self, key: &Key, bytes: Bytes) -> (Content, Kept) {
        let content = self.held.share(*key, Content::of(bytes).await);
        if !self.is_shared() {
            self.memory.insert(*key, content.clone()).await;
            let kept = self.write(*key, &content).await;
            return (content, kept);
        }
        let kept = self.write(*key, &content).await;
        match kept {
            Kept::Durable => self.memory.insert(*key, content.clone()).await,
            Kept::MemoryOnly => self.memory.forget(key).await,
        }
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
        let mut asked = false;
        let found_or_made = async {
            asked = true;
            if let Some(content) = self.get(key).await {
                return Ok(content);
            }
            let content = self.held.share(*key, Content::of(make.await?).await);
            self.write(*key, &content).await;
            Ok(content)
        };
        let content = self.memory.get_or_make(*key, found_or_made).await;
        if content.is_ok() && !asked {
            self.counts.memory_hits.add(1);
        }
        content
    }

    /// Whether other processes look for what is put here.
    pub fn is_shared(&self) -> bool {
        self.below.as_ref().is_some_and(Below::is_shared)
    }

    /// What the store has done, and how large it is.
    pub fn stats(&self) -> Stats {
        let counts = &self.counts;
        Stats {
            memory_hits: counts.memory_hits.get(),
            disk_hits: counts.disk_hits.get(),
            misses: counts.misses.get(),
            memory_bytes: self.memory.size(),
            disk_bytes: self.below.as_ref().map_or(Some(0), Below::bytes),
            evictions: counts.evictions.get(),
            damaged: counts.damaged.get(),
            read_failures: counts.read_failures.get(),
            write_failures: counts.write_failures.get(),
        }
    }

    /// Whether the disk or the shared store, if there is one, takes an object now; asked again after a few
    /// seconds at the earliest.
    pub async fn healthy(&self) -> Result<(), String> {
        match &self.below {
            Some(below) => below.healthy().await,
            None => Ok(()),
        }
    }

    /// What memory holds, or somebody else.
    async fn remembered(&self, key: &Key) -> Option<Content> {
        let content = match self.memory.get(key).await {
            Some(content) => content,
            None => self.held.get(key)?,
        };
        self.counts.memory_hits.add(1);
        self.touch(*key).await;
        Some(content)
    }

    /// What lies below, unless somebody holds it since its turn was waited for; whether it was looked for there.
    async fn read(&self, key: Key, looked: &mut bool) -> Option<Content> {
        if let Some(content) = self.held.get(&key) {
            return Some(content);
        }
        *looked = true;
        let below = self.below.as_ref()?;
        let object = below.open(key).await?;
        let content = below.content(&object).await?;
        below.touch(key).await;
        Some(self.held.share(key, content))
    }

    /// The same of what is small.
    async fn read_small(&self, key: Key, looked: &mut bool) -> Result<Content, NotRead> {
        if let Some(content) = self.held.get(&key) {
            return Ok(content);
        }
        *looked = true;
        let below = self.below.as_ref().ok_or(NotRead::Missing)?;
        let object = below.open(key).await.ok_or(NotRead::Missing)?;
        below.touch(key).await;
        if object.length() > WHOLE {
            return Err(NotRead::Large(Arc::new(object)));
        }
        let content = below.content(&object).await.ok_or(NotRead::Missing)?;
        Ok(self.held.share(key, content))
    }

    async fn write(&self, key: Key, content: &Content) -> Kept {
        match &self.below {
            Some(below) if below.write(key, content).await => Kept::Durable,
            _ => Kept::MemoryOnly,
        }
    }

    async fn touch(&self, key: Key) {
        if let Some(below) = &self.below {
            below.touch(key).await;
        }
    }

    /// Counts a question, and whether its caller had to look below.
    fn count(&self, found: bool, looked: bool) {
        let count = match (found, looked) {
            (false, _) => &self.counts.misses,
            (true, true) => &self.counts.disk_hits,
            (true, false) => &self.counts.memory_hits,
        };
        count.add(1);
    }
}

/// Why a content was not read whole; told to all who wait for it.
#[derive(Clone)]
enum NotRead {
    Missing,
    Large(Arc<Object>),
}
