//! Why a store cannot be opened, and what goes wrong with its disk afterwards.

use std::path::PathBuf;
use std::{error, fmt, io};

/// Why a store cannot keep its results where it was told to.
#[derive(Debug)]
pub enum OpenError {
    /// The directory cannot be made, entered or written to.
    Directory {
        /// The directory.
        directory: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Another process has it open.
    InUse {
        /// The directory.
        directory: PathBuf,
    },
    /// Its index can be neither read nor made anew.
    Index {
        /// The directory.
        directory: PathBuf,
        /// What the data base says.
        source: Box<dyn error::Error + Send + Sync>,
    },
    /// Its objects cannot be listed, or no object can be written.
    Objects {
        /// The directory.
        directory: PathBuf,
        /// What the layer of bytes says.
        source: object_store::Error,
    },
    /// The address of a shared store means nothing.
    Address {
        /// The address.
        address: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A shared directory does not have the file that tells it from an empty mount point.
    NoMarker {
        /// The store's address.
        address: String,
        /// The file.
        marker: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A shared store cannot be reached, or takes no objects.
    Shared {
        /// Its address.
        address: String,
        /// What it says.
        source: object_store::Error,
    },
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Directory { directory, source } => {
                write!(f, "results cannot be kept in {}: {source}", directory.display())
            }
            Self::InUse { directory } => {
                write!(f, "{} is in use: another process keeps its results there", directory.display())
            }
            Self::Index { directory, source } => {
                write!(f, "the index in {} can be neither read nor made anew: {source}", directory.display())
            }
            Self::Objects { directory, source } => {
                write!(f, "the objects in {} cannot be listed or written: {source}", directory.display())
            }
            Self::Address { address, reason } => write!(f, "{address} is no address of results: {reason}"),
            Self::NoMarker { address, marker, source } => write!(
                f,
                "{address} is not a store of results: {}: {source}. Mount the directory; if it is a new store, prepare it \
                 with `verne store init {address}`",
                marker.display()
            ),
            Self::Shared { address, source } => write!(f, "results cannot be kept in {address}: {source}"),
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

/// What the disk refused.
#[derive(Debug)]
pub(crate) enum DiskFault {
    Objects(object_store::Error),
    Index(rusqlite::Error),
    /// The room that an object needs could not be made.
    NoRoom,
    /// The runtime ended before the work did.
    Ended(tokio::task::JoinError),
}

impl fmt::Display for DiskFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Objects(fault) => fault.fmt(f),
            Self::Index(fault) => write!(f, "the index: {fault}"),
            Self::NoRoom => f.write_str("older objects could not be removed"),
            Self::Ended(fault) => fault.fmt(f),
        }
    }
}

impl From<object_store::Error> for DiskFault {
    fn from(fault: object_store::Error) -> Self {
        Self::Objects(fault)
    }
}

impl From<rusqlite::Error> for DiskFault {
    fn from(fault: rusqlite::Error) -> Self {
        Self::Index(fault)
    }
}

impl From<tokio::task::JoinError> for DiskFault {
    fn from(fault: tokio::task::JoinError) -> Self {
        Self::Ended(fault)
    }
}
