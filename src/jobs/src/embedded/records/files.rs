//! Checks that the files of an open database are still in the directory.

use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};

use crate::error::UnavailableError;

/// The database and its journal, as they were when the database was opened.
pub(super) struct Files(Vec<(PathBuf, FileIdentity)>);

/// Distinguishes a file from a later one with the same name.
#[derive(Clone, Copy, PartialEq, Eq)]
struct FileIdentity {
    #[cfg(unix)]
    device_and_inode: (u64, u64),
}

impl Files {
    /// The files of a database that has been written. There is no journal if the file system does not support the mode
    /// WAL.
    pub(super) fn of(database: &Path) -> io::Result<Self> {
        let mut files = vec![(database.to_owned(), FileIdentity::of(&fs::metadata(database)?))];
        let journal = journal(database);
        if let Ok(found) = fs::metadata(&journal) {
            files.push((journal, FileIdentity::of(&found)));
        }
        Ok(Self(files))
    }

    pub(super) fn check(&self) -> Result<(), UnavailableError> {
        for (path, identity) in &self.0 {
            let reason = match fs::metadata(path) {
                Ok(found) if FileIdentity::of(&found) == *identity => continue,
                Ok(_) => "another file has replaced it".to_owned(),
                Err(error) => error.to_string(),
            };
            return Err(UnavailableError(format!("{}: {reason}; start the process again", path.display())));
        }
        Ok(())
    }
}

impl FileIdentity {
    #[cfg(unix)]
    fn of(file: &Metadata) -> Self {
        use std::os::unix::fs::MetadataExt;
        Self { device_and_inode: (file.dev(), file.ino()) }
    }

    /// Other systems do not remove a file that is open.
    #[cfg(not(unix))]
    fn of(_: &Metadata) -> Self {
        Self {}
    }
}

fn journal(database: &Path) -> PathBuf {
    let mut name = database.as_os_str().to_owned();
    name.push("-wal");
    name.into()
}
