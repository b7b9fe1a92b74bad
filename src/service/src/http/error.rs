//! Why a request has no answer over HTTP. `problem` makes problem documents of these errors, `problem::code` lists
//! their codes and statuses. The messages describe the variants.

use thiserror::Error;
use verne_jobs::{SubmitError, UnavailableError};

use crate::limits::error::LimitError;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::query::point_into_query;
use crate::wire::role::Role;

/// Why a request has no answer.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(crate) enum HttpError {
    #[error(transparent)]
    Access(#[from] AccessError),
    #[error(transparent)]
    Limit(#[from] LimitError),
    #[error(transparent)]
    Request(#[from] RequestError),
    #[error(transparent)]
    Operation(#[from] OperationError),
    #[error(transparent)]
    Lookup(#[from] LookupError),
    #[error(transparent)]
    Job(#[from] JobError),
    #[error("No operation has this path; GET /openapi.json lists the paths.")]
    UnknownPath,
    #[error("The path does not support the method; Allow lists the methods.")]
    MethodNotAllowed,
    #[error("Accept allows none of the available media types: {}.", .0.join(", "))]
    NotAcceptable(Vec<&'static str>),
    #[error("Accept-Encoding allows none of br, gzip, zstd and identity.")]
    NoAcceptableCoding,
    #[error("The range starts beyond the end: the content has {0} bytes.")]
    RangeNotSatisfiable(u64),
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
    #[error("Send a valid API key in the header Authorization: Bearer KEY.")]
    Unauthorized,
    #[error("This request needs an API key with the role {0}.")]
    Forbidden(Role),
    #[error(
        "A web page of another origin cannot start or cancel jobs or send POST requests. The operator can allow the \
         origin with --cors-origin."
    )]
    OtherOrigin,
    #[error("The service rejects the host name {0:?}. The operator can allow it: --allowed-host {0}.")]
    HostNotAllowed(String),
}

/// Why a request cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(crate) enum RequestError {
    #[error("{0}")]
    MalformedHead(&'static str),
    #[error("The request URI is longer than the limit of {0} bytes.")]
    UriTooLong(usize),
    #[error("The request head exceeds the limit of 32 KiB or 100 headers.")]
    HeadersTooLarge,
    /// The header Content-Type is missing, or names this type instead of JSON.
    #[error(
        "Send the body with Content-Type: application/json, as curl --json does{}.",
        .0.as_ref().map(|found| format!(", not {found}")).unwrap_or_default()
    )]
    NotJson(Option<String>),
    #[error(
        "The service cannot decode {0}; send the body uncompressed, or with Content-Encoding: gzip or br."
    )]
    UnsupportedCoding(String),
    #[error("The decoded body is larger than the limit of {0} bytes.")]
    BodyTooLarge(usize),
    #[error(
        "The body did not arrive within {0} s. Send it compressed with Content-Encoding: gzip, or over a faster \
         connection. The operator can allow more time with --timeout."
    )]
    SlowBody(u64),
    #[error("The service cannot read the body: {0}.")]
    UnreadableBody(String),
}

/// Which machine, result or job does not exist.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(crate) enum LookupError {
    #[error("No machine has the name {0:?}; GET /machines lists the machines.")]
    Machine(String),
    #[error(
        "No stored result has the id {0:?}. If the service evicted it, repeat the request that computed it; the id \
         stays the same."
    )]
    Result(String),
    #[error(
        "No stored tool path has the id {0:?}. If the service evicted it, repeat the request that planned it; the id \
         stays the same."
    )]
    Toolpath(String),
    #[error("{0:?} is a table of workspaces. Each workspace in it has its own mesh and slices.")]
    Mesh(String),
    #[error("{0:?} is not a single workspace, so it has no slices.")]
    Slice(String),
    #[error("{0:?} is no dexterity map and no error map, so it has no grid.")]
    Grid(String),
    #[error("{0:?} is not a region of origins, so it has no mesh and no slices.")]
    Region(String),
    #[error("No job has the id {0:?}, or the service has removed its record; GET /jobs lists the jobs.")]
    Job(String),
}

/// Why a job cannot start or has no result.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(crate) enum JobError {
    #[error("The job queue is full; retry in {0} s.")]
    QueueFull(u64),
    #[error("The service is stopping. Its jobs continue after the next start.")]
    Stopping,
    /// The records of jobs cannot be read or written. The reason may name paths of this machine: only the log has it.
    #[error("The service cannot access its job records. Its log states the reason.")]
    RecordsUnavailable(#[from] UnavailableError),
    #[error("The job was cancelled during the wait. Repeat the request to restart it.")]
    Cancelled,
    #[error("The job exceeded its time limit.")]
    DeadlinePassed,
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
