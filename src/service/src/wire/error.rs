//! What can be wrong with a question, without a word of HTTP. `problem` alone knows statuses.

use std::fmt;

use serde::{Deserialize, Serialize};
use verne_jobs::{SubmitError, Unavailable};

use crate::wire::role::Role;

/// One bad field: where it is and what would be accepted.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Fault {
    /// JSON Pointer into the body; `/query/<name>` for a query parameter.
    pub pointer: String,
    /// The error, and the accepted values.
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
    /// The request exceeded its time limit.
    TimedOut,
    /// The path is right, the method is not.
    MethodNotAllowed,
    /// A defect of the service itself.
    Internal,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::Unauthorized => "Send a valid API key in the header Authorization: Bearer KEY.",
            Self::Forbidden(role) => return write!(f, "This request needs an API key with the role {role}."),
            Self::OtherOrigin => {
                "A web page of another origin cannot start or cancel jobs or send POST requests. The operator can \
                 allow the origin with --cors-origin."
            }
            Self::HostNotAllowed(host) => {
                return write!(
                    f,
                    "The service rejects the host name {host:?}. The operator can allow it: --allowed-host {host}."
                );
            }
            Self::BadHead(reason) => reason,
            Self::UriTooLong(limit) => {
                return write!(f, "The request URI is longer than the limit of {limit} bytes.");
            }
            Self::HeadersTooLarge => "The request head exceeds the limit of 32 KiB or 100 headers.",
            Self::TooManyRequests(seconds) => {
                return write!(f, "The client exceeded its request rate; retry in {seconds} s.");
            }
            Self::Overloaded => "The server is at its request limit (total or per client); retry in 1 s.",
            Self::Syntax(reason) => return write!(f, "The body is not JSON: {reason}."),
            Self::Fields(faults) => match faults.as_slice() {
                [] => "A field is invalid.",
                [only] => return write!(f, "{only}."),
                [first, rest @ ..] => return write!(f, "{first}; `errors` lists {} more.", rest.len()),
            },
            Self::NotJson(None) => "Send the body with Content-Type: application/json, as curl --json does.",
            Self::NotJson(Some(found)) => {
                return write!(
                    f,
                    "Send the body with Content-Type: application/json, as curl --json does, not {found}."
                );
            }
            Self::UnknownCoding(found) => {
                return write!(
                    f,
                    "The service cannot decode {found}; send the body uncompressed, or with Content-Encoding: gzip or \
                     br."
                );
            }
            Self::BodyTooLarge(limit) => {
                return write!(f, "The decoded body is larger than the limit of {limit} bytes.");
            }
            Self::BodyLost(reason) => return write!(f, "The service cannot read the body: {reason}."),
            Self::TooManyRows { rows, limit } => {
                return write!(f, "The batch has {rows} rows; the limit is {limit}.");
            }
            Self::NoSuchMachine(name) => {
                return write!(f, "No machine has the name {name:?}; GET /machines lists the machines.");
            }
            Self::NoSuchWorkspace(id) => {
                return write!(
                    f,
                    "No stored result has the id {id:?}. If the service evicted it, repeat the request that computed \
                     it; the id stays the same."
                );
            }
            Self::NoMesh(id) => {
                return write!(
                    f,
                    "{id:?} is a table of workspaces. Each workspace in it has its own mesh and slices."
                );
            }
            Self::NoSlice(id) => return write!(f, "{id:?} is not a single workspace, so it has no slices."),
            Self::NoCells(id) => {
                return write!(f, "{id:?} is not a dexterity map, so it has no grid.");
            }
            Self::NoSuchJob(id) => {
                return write!(
                    f,
                    "No job has the id {id:?}, or the service has removed its record; GET /jobs lists the jobs."
                );
            }
            Self::QueueFull(seconds) => return write!(f, "The job queue is full; retry in {seconds} s."),
            Self::Stopping => "The service is stopping. Its jobs continue after the next start.",
            Self::JobsUnavailable => "The service cannot access its job records. Its log states the reason.",
            Self::DiskFailing => "The service cannot store results. Its log states the reason.",
            Self::Cancelled => "The computation was cancelled.",
            Self::JobCancelled => "The job was cancelled during the wait. Repeat the request to restart it.",
            Self::JobTooLong => "The job exceeded its time limit.",
            Self::OtherVersion => "Another version created the job. Repeat the request for a new id.",
            Self::NoRoom => "The result is larger than the whole storage for results.",
            Self::NoEncoding => "Accept-Encoding allows none of br, gzip, zstd and identity.",
            Self::NotAcceptable(media) => {
                return write!(f, "Accept allows none of the available media types: {}.", media.join(", "));
            }
            Self::RangeNotSatisfiable(length) => {
                return write!(f, "The range starts beyond the end: the content has {length} bytes.");
            }
            Self::NoSuchPath => "No operation has this path; GET /openapi.json lists the paths.",
            Self::TimedOut => "The request exceeded its time limit.",
            Self::MethodNotAllowed => "The path does not support the method; Allow lists the methods.",
            Self::Internal => "The service has a defect; its log states this x-request-id.",
        };
        f.write_str(text)
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
        tracing::error!(%unavailable, "cannot read or write job records");
        Self::JobsUnavailable
    }
}
