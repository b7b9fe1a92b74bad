//! The store: the memory cache in front of a backing store.

use std::path::Path;
use std::sync::Arc;

use bytes::Bytes;
use object_store::ObjectStore;

use crate::backing_store::{BackingStore, Kind};
use crate::config::{Config, Durability};
use crate::content::Content;
use crate::disk::Disk;
use crate::error::OpenError;
use crate::format::CHUNK;
use crate::key::Key;
use crate::live_buffers::LiveBuffers;
use crate::memory_cache::MemoryCache;
use crate::object_reader::ObjectReader;
use crate::reader::ContentReader;
use crate::shared::Shared;
use crate::single_flight::SingleFlight;
use crate::stats::{Counters, Stats};

/// A content of at most so many bytes is read whole and cached; a larger one is read while it is sent.
const READ_WHOLE_BYTES: u64 = CHUNK;

/// Contents under keys. Its clones are one store.
#[derive(Clone)]
pub struct Store {
    memory: MemoryCache,
    live: LiveBuffers,
    flights: SingleFlight,
    backing: Option<BackingStore>,
    counters: Arc<Counters>,
}

impl Store {
    /// Opens the configured directory, or a store in memory if there is none. After a crash it first makes the index
    /// agree with the objects.
    pub async fn open(config: &Config) -> Result<Self, OpenError> {
        match &config.directory {
            Some(directory) => Self::open_disk(directory, None, config.memory_bytes, config.disk_bytes).await,
            None => Ok(Self::in_memory(config.memory_bytes)),
        }
    }

    /// Opens a store of given objects, whose index and lock are in a directory. The objects must have no other writer.
    pub async fn open_over(
        objects: Arc<dyn ObjectStore>,
        directory: &Path,
        memory_bytes: u64,
        disk_bytes: u64,
    ) -> Result<Self, OpenError> {
        Self::open_disk(directory, Some(objects), memory_bytes, disk_bytes).await
    }

    /// Opens the shared store at an address: `s3://bucket/prefix`, or `file:///shared/directory`, which
    /// [`Store::init_shared`] has prepared. The documentation of the crate states the guarantees of such a store.
    ///
    /// Endpoint, region and credentials of S3 come from the environment: `AWS_ENDPOINT`, `AWS_REGION`,
    /// `AWS_ACCESS_KEY_ID`, `AWS_SECRET_ACCESS_KEY`, `AWS_ALLOW_HTTP` and the other variables that
    /// [`object_store::aws::AmazonS3Builder::from_env`] reads.
    pub async fn open_shared(address: &str, memory_bytes: u64) -> Result<Self, OpenError> {
        let shared = Shared::open(address).await?;
        Ok(Self::in_memory(memory_bytes).backed_by(Kind::Shared(shared)))
    }

    /// Opens a shared store of given objects.
    pub async fn open_shared_over(
        objects: Arc<dyn ObjectStore>,
        memory_bytes: u64,
    ) -> Result<Self, OpenError> {
        let shared = Shared::open_over(objects).await?;
        Ok(Self::in_memory(memory_bytes).backed_by(Kind::Shared(shared)))
    }

    /// Prepares the directory at an address `file:///shared/directory`: creates it, and the marker file without which
    /// no store is opened there. The marker distinguishes the directory from the mount point of a file system that is
    /// not mounted. Returns whether the marker was created; if it exists, nothing changes. Blocks on files.
    pub fn init_shared(address: &str) -> Result<bool, OpenError> {
        Shared::init(address)
    }

    /// A store that ends with the process.
    pub fn in_memory(memory_bytes: u64) -> Self {
        Self {
            memory: MemoryCache::new(memory_bytes),
            live: LiveBuffers::default(),
            flights: SingleFlight::default(),
            backing: None,
            counters: Arc::default(),
        }
    }

    async fn open_disk(
        directory: &Path,
        objects: Option<Arc<dyn ObjectStore>>,
        memory_bytes: u64,
        disk_bytes: u64,
    ) -> Result<Self, OpenError> {
        let store = Self::in_memory(memory_bytes);
        let disk = Disk::open(directory, objects, disk_bytes, Arc::clone(&store.counters)).await?;
        Ok(store.backed_by(Kind::Disk(disk)))
    }

    fn backed_by(mut self, kind: Kind) -> Self {
        self.backing = Some(BackingStore::new(kind, Arc::clone(&self.counters)));
        self
    }

    /// The content of a key, if it exists. A damaged or unreadable object is logged and counted, and counts as absent.
    pub async fn get(&self, key: &Key) -> Option<Content> {
        if let Some(content) = self.in_memory_now(key).await {
            return Some(content);
        }
        let mut was_read = false;
        let content = self.flights.run(*key, self.read(*key, &mut was_read)).await;
        self.counters.count(content.is_some(), was_read);
        content
    }

    /// A reader of the content of a key, if it exists. A large content that is not in memory is not cached. As for
    /// [`Store::get`], but the reader reports damage beyond the header.
    pub async fn reader(&self, key: &Key) -> Option<ContentReader> {
        if let Some(content) = self.in_memory_now(key).await {
            return Some(content.into());
        }
        let mut was_read = false;
        let small = self.flights.run(*key, self.read_small(*key, &mut was_read)).await;
        let reader = match (small, &self.backing) {
            (Ok(content), _) => Some(content.into()),
            (Err(NotRead::Large(object)), Some(backing)) => {
                Some(ContentReader::of_object(object, backing.clone()))
            }
            _ => None,
        };
        self.counters.count(reader.is_some(), was_read);
        reader
    }

    /// Stores bytes under a key, in place of the old ones. A disk that fails is logged and counted, and the content is
    /// in memory all the same. A content that a shared store refuses is not in memory either: this process would take
    /// it for stored, while other processes do not find it.
    pub async fn put(&self, key: &Key, bytes: Bytes) -> (Content, Durability) {
        let content = self.live.share(*key, Content::hashed(bytes).await);
        let is_shared = self.is_shared();
        if !is_shared {
            self.memory.insert(*key, content.clone());
        }
        let durability = self.write(*key, &content).await;
        match durability {
            _ if !is_shared => {}
            Durability::Durable => self.memory.insert(*key, content.clone()),
            Durability::MemoryOnly => self.memory.remove(key),
        }
        (content, durability)
    }

    /// Stores bytes as [`Store::put`] does, but in memory only if there is no other place.
    pub async fn put_uncached(&self, key: &Key, bytes: Bytes) -> (Content, Durability) {
        if self.backing.is_none() {
            return self.put(key, bytes).await;
        }
        let content = self.live.share(*key, Content::hashed(bytes).await);
        self.memory.remove(key);
        let durability = self.write(*key, &content).await;
        if durability == Durability::MemoryOnly && !self.is_shared() {
            self.memory.insert(*key, content.clone());
        }
        (content, durability)
    }

    /// The content of a key; if it does not exist, `make` makes it.
    ///
    /// If several callers ask at once, one makes the content and all get it; if that caller is dropped, another one
    /// takes over. An error goes to those who wait now and is not stored. Callers whose errors have different types do
    /// not wait for each other.
    pub async fn get_or_make<E: Clone + Send + 'static>(
        &self,
        key: &Key,
        make: impl Future<Output = Result<Bytes, E>> + Send,
    ) -> Result<Content, E> {
        if let Some(content) = self.in_memory_now(key).await {
            return Ok(content);
        }
        let mut worked = false;
        let get_or_make = async {
            worked = true;
            if let Some(content) = self.get(key).await {
                return Ok(content);
            }
            let content = self.live.share(*key, Content::hashed(make.await?).await);
            self.write(*key, &content).await;
            self.memory.insert(*key, content.clone());
            Ok(content)
        };
        let content = self.flights.run(*key, get_or_make).await;
        if content.is_ok() && !worked {
            self.counters.memory_hits.add(1);
        }
        content
    }

    /// Whether other processes read what is stored here.
    pub fn is_shared(&self) -> bool {
        self.backing.as_ref().is_some_and(BackingStore::is_shared)
    }

    /// Counts since the store was opened, and current sizes.
    pub fn stats(&self) -> Stats {
        let counters = &self.counters;
        Stats {
            memory_hits: counters.memory_hits.get(),
            disk_hits: counters.disk_hits.get(),
            misses: counters.misses.get(),
            memory_bytes: self.memory.bytes(),
            disk_bytes: self.backing.as_ref().map_or(Some(0), BackingStore::bytes),
            evictions: counters.evictions.get(),
            damaged: counters.damaged.get(),
            read_failures: counters.read_failures.get(),
            write_failures: counters.write_failures.get(),
        }
    }

    /// Whether the backing store, if there is one, accepts an object now, or did a few seconds ago.
    pub async fn healthy(&self) -> Result<(), String> {
        match &self.backing {
            Some(backing) => backing.healthy().await,
            None => Ok(()),
        }
    }

    /// A content that is in the memory cache, or that a caller still holds.
    async fn in_memory_now(&self, key: &Key) -> Option<Content> {
        let content = self.memory.get(key).or_else(|| self.live.get(key))?;
        self.counters.memory_hits.add(1);
        if let Some(backing) = &self.backing {
            backing.record_use(*key).await;
        }
        Some(content)
    }

    /// Reads a content from the backing store and caches it, unless it has come into memory meanwhile. Sets `was_read`
    /// if it looks there.
    async fn read(&self, key: Key, was_read: &mut bool) -> Option<Content> {
        if let Some(content) = self.live.get(&key) {
            return Some(content);
        }
        *was_read = true;
        let backing = self.backing.as_ref()?;
        let object = backing.open(key).await?;
        let content = backing.content(&object).await?;
        backing.record_use(key).await;
        Some(self.cached(key, content))
    }

    /// The same for a small content; opens the object of a large one.
    async fn read_small(&self, key: Key, was_read: &mut bool) -> Result<Content, NotRead> {
        if let Some(content) = self.live.get(&key) {
            return Ok(content);
        }
        *was_read = true;
        let backing = self.backing.as_ref().ok_or(NotRead::Absent)?;
        let object = backing.open(key).await.ok_or(NotRead::Absent)?;
        backing.record_use(key).await;
        if object.length() > READ_WHOLE_BYTES {
            return Err(NotRead::Large(Arc::new(object)));
        }
        let content = backing.content(&object).await.ok_or(NotRead::Absent)?;
        Ok(self.cached(key, content))
    }

    fn cached(&self, key: Key, content: Content) -> Content {
        let content = self.live.share(key, content);
        self.memory.insert(key, content.clone());
        content
    }

    async fn write(&self, key: Key, content: &Content) -> Durability {
        match &self.backing {
            Some(backing) if backing.write(key, content).await => Durability::Durable,
            _ => Durability::MemoryOnly,
        }
    }
}

/// Why a content was not read whole. All callers that wait for it get the same reason.
#[derive(Clone)]
enum NotRead {
    Absent,
    Large(Arc<ObjectReader>),
}
