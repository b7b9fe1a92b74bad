//! Why a store cannot be opened, and why an operation of its backing store fails.

use std::path::PathBuf;
use std::{error, fmt, io};

/// Why a store cannot be opened.
#[derive(Debug)]
pub enum OpenError {
    /// The directory cannot be created, entered or written to.
    Directory {
        /// The directory.
        directory: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// Another process has the directory open.
    InUse {
        /// The directory.
        directory: PathBuf,
    },
    /// The index can be neither read nor created anew.
    Index {
        /// The directory.
        directory: PathBuf,
        /// The error of the database.
        source: Box<dyn error::Error + Send + Sync>,
    },
    /// The objects cannot be listed, or no object can be written.
    Objects {
        /// The directory.
        directory: PathBuf,
        /// The error of the object store.
        source: object_store::Error,
    },
    /// The address of a shared store is invalid.
    Address {
        /// The address.
        address: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A shared directory has no marker file: it may be an empty mount point.
    NoMarker {
        /// The address of the store.
        address: String,
        /// The file.
        marker: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// A shared store cannot be reached, or accepts no objects.
    Shared {
        /// The address of the store.
        address: String,
        /// The error of the object store.
        source: object_store::Error,
    },
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Directory { directory, source } => {
                write!(f, "cannot store results in {}: {source}", directory.display())
            }
            Self::InUse { directory } => {
                write!(f, "{} is in use: another process stores its results there", directory.display())
            }
            Self::Index { directory, source } => {
                write!(
                    f,
                    "the index in {} can be neither read nor created anew: {source}",
                    directory.display()
                )
            }
            Self::Objects { directory, source } => {
                write!(f, "cannot list or write the objects in {}: {source}", directory.display())
            }
            Self::Address { address, reason } => {
                write!(f, "{address} is not the address of a result store: {reason}")
            }
            Self::NoMarker { address, marker, source } => write!(
                f,
                "{address} is not a result store: {}: {source}. Mount the directory; if it is a new store, prepare it \
                 with `verne store init {address}`",
                marker.display()
            ),
            Self::Shared { address, source } => write!(f, "cannot store results in {address}: {source}"),
        }
    }
}

impl error::Error for OpenError {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match self {
            Self::Directory { source, .. } | Self::NoMarker { source, .. } => Some(source),
            Self::InUse { .. } | Self::Address { .. } => None,
            Self::Index { source, .. } => Some(source.as_ref()),
            Self::Objects { source, .. } | Self::Shared { source, .. } => Some(source),
        }
    }
}

/// Why an operation of a backing store fails.
#[derive(Debug)]
pub(crate) enum BackingStoreError {
    Objects(object_store::Error),
    Index(rusqlite::Error),
    /// Older objects could not be removed to make room.
    NoRoom,
    /// The runtime ended before the operation did.
    Cancelled(tokio::task::JoinError),
}

impl fmt::Display for BackingStoreError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Objects(error) => error.fmt(f),
            Self::Index(error) => write!(f, "the index: {error}"),
            Self::NoRoom => f.write_str("older objects could not be removed"),
            Self::Cancelled(error) => error.fmt(f),
        }
    }
}

impl From<object_store::Error> for BackingStoreError {
    fn from(error: object_store::Error) -> Self {
        Self::Objects(error)
    }
}

impl From<rusqlite::Error> for BackingStoreError {
    fn from(error: rusqlite::Error) -> Self {
        Self::Index(error)
    }
}

impl From<tokio::task::JoinError> for BackingStoreError {
    fn from(error: tokio::task::JoinError) -> Self {
        Self::Cancelled(error)
    }
}
