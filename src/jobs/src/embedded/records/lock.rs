//! The lock on a directory of jobs.

use std::fs::{File, TryLockError};
use std::path::Path;

use crate::embedded::config::OpenError;

/// Keeps other verne processes out of a directory. It has a file of its own. SQLite's locks would not do: they would
/// keep out programs that back up the database, and closing any handle of the database releases them.
///
/// The lock is released explicitly. A child process that is being started has a copy of the open file until it runs its
/// program; closing the file alone would leave the lock.
pub(super) struct DirectoryLock(File);

impl DirectoryLock {
    pub(super) fn take(directory: &Path) -> Result<Self, OpenError> {
        let path = directory.join("jobs.lock");
        let unusable =
            |error: std::io::Error| OpenError::Unusable { path: path.clone(), reason: error.to_string() };
        let file = File::options().create(true).write(true).truncate(false).open(&path).map_err(unusable)?;
        match file.try_lock() {
            Ok(()) => Ok(Self(file)),
            Err(TryLockError::WouldBlock) => Err(OpenError::InUse { directory: directory.to_owned() }),
            Err(TryLockError::Error(error)) => Err(unusable(error)),
        }
    }
}

impl Drop for DirectoryLock {
    fn drop(&mut self) {
        // If this fails, closing the file releases the lock.
        drop(self.0.unlock());
    }
}
