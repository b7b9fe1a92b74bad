//! Why a request has no answer over HTTP. `http::problem` turns these errors into problem documents.

use thiserror::Error;
use verne_jobs::{SubmitError, UnavailableError};

use crate::limits::error::LimitError;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::query::point_into_query;
use crate::wire::role::Role;

/// Why a request has no answer.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(crate) enum HttpError {
    /// The client may not send the request.
    #[error(transparent)]
    Access(#[from] AccessError),
    /// A limit rejects the request.
    #[error(transparent)]
    Limit(#[from] LimitError),
    /// The request cannot be read.
    #[error(transparent)]
    Request(#[from] RequestError),
    /// The operation fails.
    #[error(transparent)]
    Operation(#[from] OperationError),
    /// The machine, result or job does not exist.
    #[error(transparent)]
    Lookup(#[from] LookupError),
    /// The job has no result, or cannot start.
    #[error(transparent)]
    Job(#[from] JobError),
    /// No route has this path.
    #[error("No operation has this path; GET /openapi.json lists the paths.")]
    UnknownPath,
    /// The route does not have this method.
    #[error("The path does not support the method; Allow lists the methods.")]
    MethodNotAllowed,
    /// The header Accept allows none of these media types, which are available.
    #[error("Accept allows none of the available media types: {}.", .0.join(", "))]
    NotAcceptable(Vec<&'static str>),
    /// The header Accept-Encoding forbids every coding, identity included.
    #[error("Accept-Encoding allows none of br, gzip, zstd and identity.")]
    NoAcceptableCoding,
    /// The range starts beyond the end of the content, which has this many bytes.
    #[error("The range starts beyond the end: the content has {0} bytes.")]
    RangeNotSatisfiable(u64),
    /// The request exceeded its time limit.
    #[error("The request exceeded its time limit.")]
    TimedOut,
}

impl HttpError {
    /// One field is invalid.
    pub(crate) fn field(pointer: impl Into<String>, detail: impl Into<String>) -> Self {
        OperationError::Fields(vec![FieldError::new(pointer, detail)]).into()
    }

    /// The error with pointers into the query string in place of the body.
    pub(crate) fn in_query(self) -> Self {
        match self {
            Self::Operation(error) => point_into_query(error).into(),
            other => other,
        }
    }
}

/// Why a client may not send a request.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(crate) enum AccessError {
    /// The request has no valid key.
    #[error("Send a valid API key in the header Authorization: Bearer KEY.")]
    Unauthorized,
    /// The role of the key is too low; this role suffices.
    #[error("This request needs an API key with the role {0}.")]
    Forbidden(Role),
    /// A web page of an origin that is not allowed sends the request.
    #[error(
        "A web page of another origin cannot start or cancel jobs or send POST requests. The operator can allow the \
         origin with --cors-origin."
    )]
    OtherOrigin,
    /// The service does not have this host name.
    #[error("The service rejects the host name {0:?}. The operator can allow it: --allowed-host {0}.")]
    HostNotAllowed(String),
}

/// Why a request cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(crate) enum RequestError {
    /// The request line or a header is malformed.
    #[error("{0}")]
    MalformedHead(&'static str),
    /// The request URI has more bytes than this limit.
    #[error("The request URI is longer than the limit of {0} bytes.")]
    UriTooLong(usize),
    /// The headers are too many or too long.
    #[error("The request head exceeds the limit of 32 KiB or 100 headers.")]
    HeadersTooLarge,
    /// The header Content-Type is missing, or names this type instead of JSON.
    #[error(
        "Send the body with Content-Type: application/json, as curl --json does{}.",
        .0.as_ref().map(|found| format!(", not {found}")).unwrap_or_default()
    )]
    NotJson(Option<String>),
    /// The service does not decode this Content-Encoding.
    #[error(
        "The service cannot decode {0}; send the body uncompressed, or with Content-Encoding: gzip or br."
    )]
    UnsupportedCoding(String),
    /// The decoded body has more bytes than this limit.
    #[error("The decoded body is larger than the limit of {0} bytes.")]
    BodyTooLarge(usize),
    /// The body is incomplete or cannot be decoded, for this reason.
    #[error("The service cannot read the body: {0}.")]
    UnreadableBody(String),
}

/// Which machine, result or job does not exist.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(crate) enum LookupError {
    /// No machine has this name.
    #[error("No machine has the name {0:?}; GET /machines lists the machines.")]
    Machine(String),
    /// No stored result has this id.
    #[error(
        "No stored result has the id {0:?}. If the service evicted it, repeat the request that computed it; the id \
         stays the same."
    )]
    Result(String),
    /// The result with this id has no mesh.
    #[error("{0:?} is a table of workspaces. Each workspace in it has its own mesh and slices.")]
    Mesh(String),
    /// The result with this id has no slices.
    #[error("{0:?} is not a single workspace, so it has no slices.")]
    Slice(String),
    /// The result with this id has no grid of points.
    #[error("{0:?} is not a dexterity map, so it has no grid.")]
    Grid(String),
    /// No job has this id.
    #[error("No job has the id {0:?}, or the service has removed its record; GET /jobs lists the jobs.")]
    Job(String),
}

/// Why a job cannot start or has no result.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(crate) enum JobError {
    /// The queue is full; the client may retry after these seconds.
    #[error("The job queue is full; retry in {0} s.")]
    QueueFull(u64),
    /// The service is stopping. Jobs continue after the next start.
    #[error("The service is stopping. Its jobs continue after the next start.")]
    Stopping,
    /// The records of jobs cannot be read or written. The reason may name paths of this machine: only the log has it.
    #[error("The service cannot access its job records. Its log states the reason.")]
    RecordsUnavailable(#[from] UnavailableError),
    /// A client cancelled the job while this request waited for it.
    #[error("The job was cancelled during the wait. Repeat the request to restart it.")]
    Cancelled,
    /// The job exceeded its time limit.
    #[error("The job exceeded its time limit.")]
    DeadlinePassed,
    /// The store has no room for the result.
    #[error("The result is larger than the whole storage for results.")]
    ResultTooLarge,
}

impl From<SubmitError> for JobError {
    fn from(error: SubmitError) -> Self {
        match error {
            SubmitError::Full { retry_after } => Self::QueueFull(retry_after.as_secs().max(1)),
            SubmitError::Draining => Self::Stopping,
            SubmitError::Unavailable(unavailable) => Self::RecordsUnavailable(unavailable),
        }
    }
}

impl From<UnavailableError> for HttpError {
    fn from(unavailable: UnavailableError) -> Self {
        JobError::from(unavailable).into()
    }
}
