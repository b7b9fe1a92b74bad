//! The files of an open database: whether they are still the ones in the directory.

use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};

use crate::Unavailable;

/// The database and its journal, as they were when it was opened.
pub(super) struct Files([(PathBuf, Identity); 2]);

/// Tells a file from another that has its name later.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Identity {
    #[cfg(unix)]
    device_and_inode: (u64, u64),
}

impl Files {
    /// Of a database in the mode WAL that has been written.
    pub(super) fn of(database: &Path) -> io::Result<Self> {
        let file = |path: PathBuf| Ok::<_, io::Error>((path.clone(), Identity::of(&fs::metadata(path)?)));
        Ok(Self([file(database.to_owned())?, file(journal(database))?]))
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
