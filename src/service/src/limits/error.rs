//! Why a limit rejects a request.

use thiserror::Error;

/// Why a limit rejects a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub(crate) enum LimitError {
    /// The client exceeded its request rate; it may retry after these seconds.
    #[error("The client exceeded its request rate; retry in {0} s.")]
    TooManyRequests(u64),
    /// The service, or this client, has the most requests, bodies or answers that are allowed at once.
    #[error("The server is at its request limit (total or per client); retry in 1 s.")]
    Overloaded,
}
