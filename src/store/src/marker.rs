//! The file that distinguishes a shared directory from an empty mount point.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use object_store::Error;

/// Objects and probes are files in subdirectories, so no object has this name.
const NAME: &str = "verne-store";

const TEXT: &[u8] =
    b"This directory is a store of results of verne. verne does not use it without this file.\n";

/// The marker of a directory.
#[derive(Clone, Debug)]
pub(crate) struct Marker(Arc<Path>);

impl Marker {
    /// The marker that a directory has, or should have.
    pub(crate) fn of(directory: &Path) -> Self {
        Self(directory.join(NAME).into())
    }

    /// The path of the file.
    pub(crate) fn path(&self) -> PathBuf {
        self.0.to_path_buf()
    }

    /// Creates the file, unless it exists. Returns whether it was created.
    pub(crate) fn create(&self) -> io::Result<bool> {
        match File::create_new(&self.0) {
            Ok(mut file) => file.write_all(TEXT).and_then(|()| file.sync_all()).map(|()| true),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(false),
            Err(error) => Err(error),
        }
    }

    /// Whether the file exists now. If not, the directory is not mounted; it may be mounted again later.
    pub(crate) async fn check(&self) -> Result<(), Error> {
        let path = Arc::clone(&self.0);
        let found = tokio::task::spawn_blocking(move || fs::metadata(path));
        let Err(error) = found.await.map_err(io::Error::other).flatten() else { return Ok(()) };
        let source = format!("{}: {error}; is the directory mounted?", self.0.display()).into();
        Err(Error::Generic { store: "directory", source })
    }
}
