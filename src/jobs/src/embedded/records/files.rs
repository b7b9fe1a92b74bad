//! The files of an open database: whether they are still the ones in the directory.

use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};

use crate::Unavailable;

/// The database and its journal, as they were when it was opened.
pub(super) struct Files(Vec<(PathBuf, Identity)>);

/// Tells a file from another that has its name later.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Identity {
    #[cfg(unix)]
    device_and_inode: (u64, u64),
}

impl Files {
    /// Of a database that has been written. Where the file system cannot have the journal of the mode WAL there is
    /// none.
    pub(super) fn of(database: &Path) -> io::Result<Self> {
        let mut files = vec![(database.to_owned(), Identity::of(&fs::metadata(database)?))];
        let journal = journal(database);
        if let Ok(found) = fs::metadata(&journal) {
            files.push((journal, Identity::of(&found)));
        }
        Ok(Self(files))
    }

    pub(super) fn check(&self) -> Result<(), Unavailable> {
        for (path, identity) in &self.0 {
            let lost = match fs::metadata(path) {
                Ok(found) if Identity::of(&found) == *identity => continue,
                Ok(_) => "another file has taken its place".to_owned(),
                Err(fault) => fault.to_string(),
            };
            return Err(Unavailable(format!("{}: {lost}; start the process again", path.display())));
        }
        Ok(())
    }
}

impl Identity {
    #[cfg(unix)]
    fn of(file: &Metadata) -> Self {
        use std::os::unix::fs::MetadataExt;
        Self { device_and_inode: (file.dev(), file.ino()) }
    }

    /// An open file cannot be removed there.
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
