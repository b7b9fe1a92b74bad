//! The file that tells a shared directory from an empty mount point.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use object_store::Error;

/// Objects and probes lie in directories, so no object has this name.
const NAME: &str = "verne-store";

const TEXT: &[u8] =
    b"This directory is a store of results of verne. verne does not use it without this file.\n";

/// The marker of one directory. Clones are the same.
#[derive(Clone, Debug)]
pub(crate) struct Marker(Arc<Path>);

impl Marker {
    /// The marker that the directory has, or should have.
    pub(crate) fn of(directory: &Path) -> Self {
        Self(directory.join(NAME).into())
    }

    /// Where it is.
    pub(crate) fn path(&self) -> PathBuf {
        self.0.to_path_buf()
    }

    /// Makes it, unless it is there. Answers whether it was made.
    pub(super) fn make(&self) -> io::Result<bool> {
        match File::create_new(&self.0) {
            Ok(mut file) => file.write_all(TEXT).and_then(|()| file.sync_all()).map(|()| true),
            Err(fault) if fault.kind() == io::ErrorKind::AlreadyExists => Ok(false),
            Err(fault) => Err(fault),
        }
    }

    /// Whether it is there now. If not, the directory is not mounted; it may be again later.
    pub(crate) async fn check(&self) -> Result<(), Error> {
        let path = Arc::clone(&self.0);
        let looked = tokio::task::spawn_blocking(move || fs::metadata(path));
        let Err(fault) = looked.await.map_err(io::Error::other).flatten() else { return Ok(()) };
        let source = format!("{}: {fault}; is the directory mounted?", self.0.display()).into();
        Err(Error::Generic { store: "directory", source })
    }
}
