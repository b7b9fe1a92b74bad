//! Opens a directory: locks it, removes what a crash left, and makes the index agree with the objects.

use std::collections::HashMap;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use futures_util::{StreamExt, TryStreamExt, future, stream};
use object_store::local::LocalFileSystem;
use object_store::{ObjectMeta, ObjectStore};

use super::{Disk, PROBE};
use crate::error::{BackingStoreError, OpenError};
use crate::format::{self, FormatError};
use crate::health::Health;
use crate::index::{Index, OpenedIndex};
use crate::key::Key;
use crate::object_io::ObjectIo;
use crate::stats::Counters;

/// Headers that are read at the same time.
const HEADERS_IN_FLIGHT: usize = 16;

impl Disk {
    /// Opens a directory whose index and objects may use `limit` bytes. `objects`, if given, contains the objects.
    pub(crate) async fn open(
        directory: &Path,
        objects: Option<Arc<dyn ObjectStore>>,
        limit: u64,
        counters: Arc<Counters>,
    ) -> Result<Arc<Self>, OpenError> {
        let lock = lock(directory).await?;
        let objects = match objects {
            Some(objects) => objects,
            None => open_objects(directory).await?,
        };
        let path = directory.to_path_buf();
        let opened = tokio::task::spawn_blocking(move || Index::open(&path)).await;
        let OpenedIndex { index, sizes, next_use } = opened
            .map_err(Into::into)
            .flatten()
            .map_err(|source| OpenError::Index { directory: directory.to_path_buf(), source })?;
        let disk = Self {
            io: ObjectIo::on_disk(objects),
            index: Arc::new(Mutex::new(index)),
            limit,
            bytes: Arc::default(),
            next_use: AtomicU64::new(next_use),
            uses: Mutex::default(),
            changes: tokio::sync::Mutex::default(),
            health: Health::default(),
            counters,
            _lock: lock,
        };
        disk.reconcile(sizes).await.map_err(|error| open_error(directory, error))?;
        Ok(Arc::new(disk))
    }

    /// Makes the index agree with the objects, evicts what exceeds the limit, and tests whether the disk is writable.
    async fn reconcile(&self, mut sizes: HashMap<Key, u64>) -> Result<(), BackingStoreError> {
        let mut unknown = Vec::new();
        let mut listing = self.io.store().list(None);
        while let Some(file) = listing.try_next().await? {
            if let Some(key) = Key::at(&file.location)
                && sizes.remove(&key) != Some(file.size)
            {
                unknown.push((key, file));
            }
        }
        let wrong: Vec<Key> = sizes.into_keys().chain(unknown.iter().map(|(key, _)| *key)).collect();
        let found = self.objects_among(unknown).await;
        if !wrong.is_empty() {
            tracing::warn!(
                rows = wrong.len(),
                objects = found.len(),
                "the index disagrees with the objects: correcting it"
            );
            let first_use = self.next_use.fetch_add(found.len() as u64, Ordering::Relaxed);
            self.with_index(move |index| index.replace(&wrong, &found, first_use)).await?;
        }
        self.make_room(None).await?;
        Ok(self.io.probe(PROBE).await?)
    }

    /// The files that are objects, oldest first.
    async fn objects_among(&self, files: Vec<(Key, ObjectMeta)>) -> Vec<(Key, u64)> {
        let mut found: Vec<(Key, ObjectMeta)> = stream::iter(files)
            .map(|(key, file)| async move { self.is_object(key, &file).await.then_some((key, file)) })
            .buffer_unordered(HEADERS_IN_FLIGHT)
            .filter_map(future::ready)
            .collect()
            .await;
        found.sort_unstable_by_key(|(_, file)| file.last_modified);
        found.into_iter().map(|(key, file)| (key, file.size)).collect()
    }

    /// Whether a file begins as the object of its key and has the length that it states. Removes a damaged object, but
    /// not a file that never was an object.
    async fn is_object(&self, key: Key, file: &ObjectMeta) -> bool {
        let damage = match self.io.start(key, file.size.min(format::FIXED as u64)).await {
            Ok(start) => match format::claim(&key, &start, file.size) {
                Ok(_) => return true,
                Err(damage) => damage,
            },
            Err(error) => {
                self.counters.read_failures.add(1);
                tracing::error!(%key, %error, "cannot read an object");
                return false;
            }
        };
        self.counters.damaged.add(1);
        if damage == FormatError::Foreign {
            tracing::warn!(%key, error = %damage, "ignoring a foreign file in the directory of objects");
        } else {
            tracing::error!(%key, error = %damage, "removing a damaged object");
            if let Err(error) = self.io.delete(key).await {
                tracing::error!(%key, %error, "cannot remove a damaged object");
            }
        }
        false
    }
}

/// Creates the directory, and keeps other processes out of it while the returned file is open.
async fn lock(directory: &Path) -> Result<File, OpenError> {
    let path = directory.to_path_buf();
    let locked = blocking(directory, move || {
        fs::create_dir_all(&path)?;
        let lock = File::create(path.join("lock"))?;
        match lock.try_lock() {
            Ok(()) => Ok(Some(lock)),
            Err(TryLockError::WouldBlock) => Ok(None),
            Err(TryLockError::Error(error)) => Err(error),
        }
    });
    locked.await?.ok_or_else(|| OpenError::InUse { directory: directory.to_path_buf() })
}

/// Opens the objects in a directory.
async fn open_objects(directory: &Path) -> Result<Arc<dyn ObjectStore>, OpenError> {
    let (path, root) = (directory.to_path_buf(), directory.join("objects"));
    let objects = blocking(directory, move || {
        fs::create_dir_all(&root)?;
        remove_unfinished(&root)?;
        for entry in fs::read_dir(&root)? {
            let entry = entry?;
            if entry.file_type()?.is_dir() {
                remove_unfinished(&entry.path())?;
            }
        }
        // Writing an object flushes the object's own directory, but not this one.
        File::open(&path)?.sync_all()?;
        LocalFileSystem::new_with_prefix(&root).map_err(io::Error::other)
    });
    Ok(Arc::new(objects.await?.with_fsync(true)))
}

/// Removes files that a crash left unfinished: object_store writes `name#1` and renames it to `name`, and its listings
/// omit such names.
fn remove_unfinished(directory: &Path) -> io::Result<()> {
    for entry in fs::read_dir(directory)? {
        let entry = entry?;
        let name = entry.file_name();
        let unfinished =
            name.to_str().and_then(|name| name.rsplit_once('#')).is_some_and(|(name, number)| {
                (name.len() == 62 || name == "probe") && number.bytes().all(|digit| digit.is_ascii_digit())
            });
        if unfinished {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}

async fn blocking<T: Send + 'static>(
    directory: &Path,
    work: impl FnOnce() -> io::Result<T> + Send + 'static,
) -> Result<T, OpenError> {
    let done = tokio::task::spawn_blocking(work).await.map_err(io::Error::other).flatten();
    done.map_err(|source| OpenError::Directory { directory: directory.to_path_buf(), source })
}

fn open_error(directory: &Path, error: BackingStoreError) -> OpenError {
    let directory = directory.to_path_buf();
    match error {
        BackingStoreError::Objects(source) => OpenError::Objects { directory, source },
        BackingStoreError::Index(source) => OpenError::Index { directory, source: Box::new(source) },
        error @ (BackingStoreError::NoRoom | BackingStoreError::Cancelled(_)) => {
            OpenError::Directory { directory, source: io::Error::other(error.to_string()) }
        }
    }
}
