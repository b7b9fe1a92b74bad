//! Why a limit rejects a request.

use thiserror::Error;

/// Why a limit rejects a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub(crate) enum LimitError {
    /// The rate of the client is exceeded for so many seconds.
    #[error("The client exceeded its request rate; retry in {0} s.")]
    TooManyRequests(u64),
    /// The service, or this client, has reached a limit of requests, connections or memory.
    #[error("The server is at its request limit (total or per client); retry in 1 s.")]
    Overloaded,
}
