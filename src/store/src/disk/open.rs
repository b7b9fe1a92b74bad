//! Opening: one process at a time, no remains of a crash, and an index that agrees with the objects.

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
use crate::Key;
use crate::fault::{DiskFault, OpenError};
use crate::health::Health;
use crate::index::{Found, Index};
use crate::object::{self, Damage};
use crate::objects::Objects;
use crate::stats::Counts;

/// So many headers are read at once.
const AT_ONCE: usize = 16;

impl Disk {
    /// Opens a directory, with its objects in it or elsewhere.
    pub(crate) async fn open(
        directory: &Path,
        elsewhere: Option<Arc<dyn ObjectStore>>,
        bound: u64,
        counts: Arc<Counts>,
    ) -> Result<Arc<Self>, OpenError> {
        let lock = lock(directory).await?;
        let objects = match elsewhere {
            Some(objects) => objects,
            None => local(directory).await?,
        };
        let place = directory.to_path_buf();
        let found = tokio::task::spawn_blocking(move || Index::open(&place)).await;
        let Found { index, sizes, next_use } = found
            .map_err(Into::into)
            .flatten()
            .map_err(|source| OpenError::Index { directory: directory.to_path_buf(), source })?;
        let disk = Self {
            objects: Objects::on_disk(objects),
            index: Arc::new(Mutex::new(index)),
            bound,
            total: Arc::default(),
            next_use: AtomicU64::new(next_use),
            uses: Mutex::default(),
            turn: tokio::sync::Mutex::default(),
            health: Health::default(),
            counts,
            _lock: lock,
        };
        disk.settle(sizes).await.map_err(|fault| refusal(directory, fault))?;
        Ok(Arc::new(disk))
    }

    /// Makes the index agree with the objects, keeps the bound, and sees that an object can be written.
    async fn settle(&self, mut sizes: HashMap<Key, u64>) -> Result<(), DiskFault> {
        let mut unknown = Vec::new();
        let mut listing = self.objects.store().list(None);
        while let Some(file) = listing.try_next().await? {
            if let Some(key) = Key::at(&file.location)
                && sizes.remove(&key) != Some(file.size)
            {
                unknown.push((key, file));
            }
        }
        let gone: Vec<Key> = sizes.into_keys().chain(unknown.iter().map(|(key, _)| *key)).collect();
        let found = self.recognise(unknown).await;
        if !gone.is_empty() {
            tracing::warn!(
                changed = gone.len(),
                found = found.len(),
                "the index did not agree with the objects"
            );
            let first_use = self.next_use.fetch_add(found.len() as u64, Ordering::Relaxed);
            self.with_index(move |index| index.reconcile(&gone, &found, first_use)).await?;
        }
        self.make_room(None).await?;
        Ok(self.objects.probe(PROBE).await?)
    }

    /// Those of the files that are objects, oldest first.
    async fn recognise(&self, files: Vec<(Key, ObjectMeta)>) -> Vec<(Key, u64)> {
        let mut found: Vec<(Key, ObjectMeta)> = stream::iter(files)
            .map(|(key, file)| async move { self.is_object(key, &file).await.then_some((key, file)) })
            .buffer_unordered(AT_ONCE)
            .filter_map(future::ready)
            .collect()
            .await;
        found.sort_unstable_by_key(|(_, file)| file.last_modified);
        found.into_iter().map(|(key, file)| (key, file.size)).collect()
    }

    /// Whether a file begins as its key's object and is as long as it says. What is left of a damaged object is
    /// removed; what never was an object is left alone.
    async fn is_object(&self, key: Key, file: &ObjectMeta) -> bool {
        let damage = match self.objects.start(key, file.size.min(object::FIXED as u64)).await {
            Ok(start) => match object::claim(&key, &start, file.size) {
                Ok(_) => return true,
                Err(damage) => damage,
            },
            Err(fault) => {
                self.counts.read_failures.add(1);
                tracing::error!(%key, %fault, "an object cannot be read");
                return false;
            }
        };
        self.counts.damaged.add(1);
        if damage == Damage::Foreign {
            tracing::warn!(%key, %damage, "a file where objects lie: left alone");
        } else {
            tracing::error!(%key, %damage, "a damaged object: removed");
            if let Err(fault) = self.objects.delete(key).await {
                tracing::error!(%key, %fault, "a damaged object cannot be removed");
            }
        }
        false
    }
}

/// Makes the directory and keeps other processes out of it while the file is open.
async fn lock(directory: &Path) -> Result<File, OpenError> {
    let place = directory.to_path_buf();
    let locked = blocking(directory, move || {
        fs::create_dir_all(&place)?;
        let lock = File::create(place.join("lock"))?;
        match lock.try_lock() {
            Ok(()) => Ok(Some(lock)),
            Err(TryLockError::WouldBlock) => Ok(None),
            Err(TryLockError::Error(fault)) => Err(fault),
        }
    });
    locked.await?.ok_or_else(|| OpenError::InUse { directory: directory.to_path_buf() })
}

/// The objects in a directory.
async fn local(directory: &Path) -> Result<Arc<dyn ObjectStore>, OpenError> {
    let (place, root) = (directory.to_path_buf(), directory.join("objects"));
    let objects = blocking(directory, move || {
        fs::create_dir_all(&root)?;
        remove_unfinished(&root)?;
        for place in fs::read_dir(&root)? {
            let place = place?;
            if place.file_type()?.is_dir() {
                remove_unfinished(&place.path())?;
            }
        }
        // Flushed with the first object otherwise: its own directory, but not this one's entry.
        File::open(&place)?.sync_all()?;
        LocalFileSystem::new_with_prefix(&root).map_err(io::Error::other)
    });
    Ok(Arc::new(objects.await?.with_fsync(true)))
}

/// Removes what a crash left of files that were being written: object_store writes `name#1` and moves it to
/// `name`, and its listings pass such names over.
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

fn refusal(directory: &Path, fault: DiskFault) -> OpenError {
    let directory = directory.to_path_buf();
    match fault {
        DiskFault::Objects(source) => OpenError::Objects { directory, source },
        DiskFault::Index(source) => OpenError::Index { directory, source: Box::new(source) },
        fault @ (DiskFault::NoRoom | DiskFault::Ended(_)) => {
            OpenError::Directory { directory, source: io::Error::other(fault.to_string()) }
        }
    }
}
