//! What can be wrong with a question, without a word of HTTP. `problem` alone knows statuses.

use std::fmt;

use serde::{Deserialize, Serialize};
use verne_jobs::{SubmitError, Unavailable};

use crate::access::Role;

/// One bad field: where it is and what would be accepted.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Fault {
    /// JSON Pointer into the body; `/query/<name>` for a query parameter.
    pub pointer: String,
    /// What is wrong, and what would be accepted.
    pub detail: String,
}

impl Fault {
    /// A fault of one field.
    pub(crate) fn new(pointer: impl Into<String>, detail: impl Into<String>) -> Self {
        Self { pointer: pointer.into(), detail: detail.into() }
    }

    /// A required field that is not there.
    pub(crate) fn missing(pointer: String, name: &str) -> Self {
        Self::new(pointer, format!("`{name}` is missing"))
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { pointer, detail } = self;
        // A detail that begins with the field's name needs no pointer before it.
        if pointer.is_empty() || detail.starts_with('`') {
            f.write_str(detail)
        } else {
            write!(f, "{pointer}: {detail}")
        }
    }
}

/// Why a request gets no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Error {
    /// No key was sent that is known here.
    Unauthorized,
    /// The key does not suffice; this role would.
    Forbidden(Role),
    /// A page of an origin that is not allowed to starts work.
    OtherOrigin,
    /// The service does not have this name.
    HostNotAllowed(String),
    /// The head of the request is not as HTTP has it.
    BadHead(&'static str),
    /// The request's address has more bytes than this.
    UriTooLong(usize),
    /// There are too many headers, or they have too many bytes.
    HeadersTooLarge,
    /// The client asks too fast; after so many seconds it may again.
    TooManyRequests(u64),
    /// As much is worked on as may be.
    Overloaded,
    /// The body is not JSON; the parser's words.
    Syntax(String),
    /// Well-formed, but these fields cannot be used.
    Fields(Vec<Fault>),
    /// The body is declared as something other than JSON, or as nothing.
    NotJson(Option<String>),
    /// The body is encoded in a way that the service does not decode.
    UnknownCoding(String),
    /// The body has more bytes than this, once it is decoded.
    BodyTooLarge(usize),
    /// The body broke off.
    BodyLost(String),
    /// More rows in a batch than are answered at once.
    TooManyRows {
        /// Rows asked for.
        rows: usize,
        /// Rows allowed.
        limit: usize,
    },
    /// No machine is published under this name.
    NoSuchMachine(String),
    /// No workspace is kept under this id.
    NoSuchWorkspace(String),
    /// This result has no mesh.
    NoMesh(String),
    /// This result cannot be cut.
    NoSlice(String),
    /// This result has no grid of points.
    NoCells(String),
    /// No job is known under this id.
    NoSuchJob(String),
    /// The queue is full; after so many seconds a place is likely to be free.
    QueueFull(u64),
    /// The service is stopping; jobs go on when it is started again.
    Stopping,
    /// The records of jobs cannot be read or written.
    JobsUnavailable,
    /// The disk takes no results.
    DiskFailing,
    /// The computation was to stop.
    Cancelled,
    /// Somebody cancelled the job that was waited for.
    JobCancelled,
    /// The job took longer than jobs may.
    JobTooLong,
    /// Another version of the service asked for it.
    OtherVersion,
    /// The result was computed and could be kept nowhere.
    NoRoom,
    /// None of the media types that Accept names can be had; these can.
    NotAcceptable(Vec<&'static str>),
    /// Accept-Encoding forbids every encoding, the plain one too.
    NoEncoding,
    /// The range starts beyond the end of so many bytes.
    RangeNotSatisfiable(u64),
    /// Nothing lives at this path.
    NoSuchPath,
    /// The answer took longer than the time allowed.
    TimedOut,
    /// The path is right, the method is not.
    MethodNotAllowed,
    /// A defect of the service itself.
    Internal,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unauthorized => {
                write!(f, "Send a key that is known here: the header Authorization: Bearer KEY.")
            }
            Self::Forbidden(role) => write!(f, "This takes a key whose role is {role}."),
            Self::OtherOrigin => write!(
                f,
                "A page of another origin may not start work here. The operator of the service can allow its origin: \
                 --cors-origin."
            ),
            Self::HostNotAllowed(host) => write!(
                f,
                "The service does not answer to the name {host:?} in Host. The operator of the service can allow it: \
                 --allowed-host {host}."
            ),
            Self::BadHead(reason) => write!(f, "{reason}"),
            Self::UriTooLong(limit) => write!(f, "The address has more than the {limit} bytes allowed here."),
            Self::HeadersTooLarge => {
                write!(f, "The request's head has more than the 32 KiB or the 100 headers allowed here.")
            }
            Self::TooManyRequests(seconds) => {
                write!(f, "More requests came than this client may send; the next in {seconds} s.")
            }
            Self::Overloaded => write!(f, "As many requests are worked on as may be; try again in a second."),
            Self::Syntax(reason) => write!(f, "The body is not JSON: {reason}."),
            Self::Fields(faults) => match faults.as_slice() {
                [] => write!(f, "A field cannot be used."),
                [only] => write!(f, "{only}."),
                [first, rest @ ..] => write!(f, "{first}; `errors` lists {} more.", rest.len()),
            },
            Self::NotJson(None) => {
                write!(f, "Send the body with Content-Type: application/json, as curl --json does.")
            }
            Self::NotJson(Some(found)) => {
                write!(
                    f,
                    "Send the body with Content-Type: application/json, as curl --json does, not {found}."
                )
            }
            Self::UnknownCoding(found) => {
                write!(
                    f,
                    "The body cannot be decoded from {found}; send it plain, or with Content-Encoding: gzip or br."
                )
            }
            Self::BodyTooLarge(limit) => {
                write!(f, "The body, once decoded, has more than the {limit} bytes allowed here.")
            }
            Self::BodyLost(reason) => write!(f, "The body could not be read: {reason}."),
            Self::TooManyRows { rows, limit } => {
                write!(f, "The batch has {rows} rows; at most {limit} are answered at once.")
            }
            Self::NoSuchMachine(name) => {
                write!(f, "No machine is published as {name:?}; GET /machines lists them.")
            }
            Self::NoSuchWorkspace(id) => {
                write!(
                    f,
                    "No workspace is kept as {id:?} (any more): ask /workspace again, the id will be the same."
                )
            }
            Self::NoMesh(id) => {
                write!(f, "{id:?} is a table of workspaces: each of its members has a mesh and slices.")
            }
            Self::NoSlice(id) => write!(f, "{id:?} is no single workspace: there is nothing to cut."),
            Self::NoCells(id) => write!(f, "{id:?} is no dexterity map: it has no grid of points."),
            Self::NoSuchJob(id) => {
                write!(f, "No job is known as {id:?} (any more); GET /jobs lists them.")
            }
            Self::QueueFull(seconds) => write!(f, "The queue is full; try again in {seconds} s."),
            Self::Stopping => {
                write!(f, "The service is stopping; what was asked for goes on when it is started again.")
            }
            Self::JobsUnavailable => {
                write!(f, "The records of jobs cannot be written now; the service's log says why.")
            }
            Self::DiskFailing => write!(f, "The disk takes no results now; the service's log says why."),
            Self::Cancelled => write!(f, "The computation was cancelled."),
            Self::JobCancelled => {
                write!(f, "The job was cancelled while it was waited for; asked again, it starts anew.")
            }
            Self::JobTooLong => write!(f, "The computation took longer than the time allowed for a job."),
            Self::OtherVersion => {
                write!(f, "Another version of the service was asked this; ask again, the id will be another.")
            }
            Self::NoRoom => write!(f, "The result is larger than all the room there is for results."),
            Self::NoEncoding => write!(f, "Accept-Encoding leaves none of br, gzip, zstd and identity."),
            Self::NotAcceptable(media) => {
                write!(f, "Accept names nothing that can be had here: {}.", media.join(", "))
            }
            Self::RangeNotSatisfiable(length) => {
                write!(f, "The range starts beyond the end: there are {length} bytes.")
            }
            Self::NoSuchPath => write!(f, "Nothing lives at this path; GET /openapi.json lists what does."),
            Self::TimedOut => write!(f, "The answer took longer than the time allowed."),
            Self::MethodNotAllowed => {
                write!(f, "This path takes other methods; the header Allow names them.")
            }
            Self::Internal => write!(f, "A defect of the service; its log holds this x-request-id."),
        }
    }
}

impl std::error::Error for Error {}

impl From<SubmitError> for Error {
    fn from(error: SubmitError) -> Self {
        match error {
            SubmitError::Full { retry_after } => Self::QueueFull(retry_after.as_secs().max(1)),
            SubmitError::Draining => Self::Stopping,
            SubmitError::Unavailable(unavailable) => unavailable.into(),
        }
    }
}

impl From<Unavailable> for Error {
    fn from(unavailable: Unavailable) -> Self {
        // The reason may name paths of this machine: it is for the log.
        tracing::error!(%unavailable, "jobs");
        Self::JobsUnavailable
    }
}
