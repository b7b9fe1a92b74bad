//! Errors that prevent `verne serve` and `verne worker` from starting.

use thiserror::Error;

use crate::limits::keys_file::KeysFileError;
use crate::operations::machine_registry::MachineFileError;
use crate::process::config::listen::Listen;
use crate::process::server::tls::TlsError;
use crate::process::storage::error::StorageError;

/// Why the process cannot start.
#[derive(Debug, Error)]
pub enum StartError {
    /// A machine file cannot be used.
    #[error("machines: {0}")]
    Machine(MachineFileError),
    /// The keys file cannot be used.
    #[error("keys: {0}")]
    Keys(KeysFileError),
    /// The result store or the job queue cannot be opened.
    #[error("{0}")]
    Storage(StorageError),
    /// The certificate cannot be used.
    #[error("tls_certificate, tls_key: {0}")]
    Tls(TlsError),
    /// The process cannot listen on this address.
    #[error("listen: cannot serve on {0}: {1}")]
    Listen(Listen, std::io::Error),
}
