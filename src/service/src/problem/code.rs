//! The stable name of each failure: its status and its meaning. Answers and the OpenAPI document are made from this table.

use axum::http::StatusCode;

use crate::error::Error;

macro_rules! codes {
    ($($code:ident, $name:literal, $status:ident, $meaning:literal;)*) => {
        /// The stable name of a failure, for programs.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Code {
            $(#[doc = $meaning] $code,)*
        }

        impl Code {
            /// All of them.
            pub(crate) const ALL: &[Self] = &[$(Self::$code),*];

            /// The name.
            pub(crate) const fn name(self) -> &'static str {
                match self { $(Self::$code => $name),* }
            }

            /// The HTTP status.
            pub(crate) const fn status(self) -> StatusCode {
                match self { $(Self::$code => StatusCode::$status),* }
            }

            /// What it means, as a sentence.
            pub(crate) const fn meaning(self) -> &'static str {
                match self { $(Self::$code => $meaning),* }
            }
        }
    };
}

codes! {
    BadJson, "bad_json", BAD_REQUEST, "The body is not JSON.";
    BadRequest, "bad_request", BAD_REQUEST, "The body broke off or cannot be decoded.";
    Unauthorized, "unauthorized", UNAUTHORIZED, "The service has keys, and the request has none that it knows.";
    Forbidden, "forbidden", FORBIDDEN, "The role of the key does not suffice.";
    OtherOrigin, "other_origin", FORBIDDEN, "A page of another origin may not start or end work.";
    HostNotAllowed, "host_not_allowed", MISDIRECTED_REQUEST, "The service does not have the name in Host.";
    UriTooLong, "uri_too_long", URI_TOO_LONG, "The address of the request is longer than the limit.";
    HeadersTooLarge, "headers_too_large", REQUEST_HEADER_FIELDS_TOO_LARGE,
        "The headers of the request are larger, or more, than the limit.";
    NotFound, "not_found", NOT_FOUND, "No operation has this path.";
    MachineNotFound, "machine_not_found", NOT_FOUND, "No machine has this name.";
    WorkspaceNotFound, "workspace_not_found", NOT_FOUND, "No result is kept under this id.";
    NoMesh, "no_mesh", NOT_FOUND, "A family of workspaces has no mesh of its own.";
    NoSlice, "no_slice", NOT_FOUND, "Only a single workspace can be cut.";
    NoCells, "no_cells", NOT_FOUND, "Only a dexterity map has a grid of points.";
    JobNotFound, "job_not_found", NOT_FOUND, "No job is known under this id.";
    MethodNotAllowed, "method_not_allowed", METHOD_NOT_ALLOWED, "The path has no such method.";
    NotAcceptable, "not_acceptable", NOT_ACCEPTABLE,
        "Accept names no media type, or Accept-Encoding no coding, that the answer can have.";
    JobCancelled, "job_cancelled", CONFLICT, "The job was cancelled while the request waited for it.";
    OtherVersion, "other_version", CONFLICT, "Another version of the service made the job.";
    BodyTooLarge, "body_too_large", PAYLOAD_TOO_LARGE, "The body, once decoded, is larger than the limit.";
    TooManyRows, "too_many_rows", PAYLOAD_TOO_LARGE, "The batch has more rows than the limit.";
    UnsupportedMediaType, "unsupported_media_type", UNSUPPORTED_MEDIA_TYPE,
        "The Content-Type of the body is not application/json.";
    UnsupportedCoding, "unsupported_coding", UNSUPPORTED_MEDIA_TYPE,
        "The Content-Encoding of the body is neither gzip nor br.";
    RangeNotSatisfiable, "range_not_satisfiable", RANGE_NOT_SATISFIABLE, "The range starts beyond the end.";
    InvalidRequest, "invalid_request", UNPROCESSABLE_ENTITY, "Fields or query parameters cannot be used.";
    TooManyRequests, "too_many_requests", TOO_MANY_REQUESTS, "The client sends requests faster than its limit.";
    Internal, "internal", INTERNAL_SERVER_ERROR, "The service has a defect.";
    Overloaded, "overloaded", SERVICE_UNAVAILABLE, "The service is at its limit of concurrent work.";
    QueueFull, "queue_full", SERVICE_UNAVAILABLE, "The queue of jobs is full.";
    Stopping, "stopping", SERVICE_UNAVAILABLE, "The service is stopping.";
    JobsUnavailable, "jobs_unavailable", SERVICE_UNAVAILABLE, "The records of jobs cannot be read or written.";
    DiskFailing, "disk_failing", SERVICE_UNAVAILABLE, "The storage takes no results.";
    JobTooLong, "job_too_long", SERVICE_UNAVAILABLE, "The job took longer than its limit.";
    TimedOut, "timed_out", SERVICE_UNAVAILABLE, "The answer took longer than the limit.";
    NoRoom, "no_room", INSUFFICIENT_STORAGE, "The result is larger than the room for results.";
}

impl From<&Error> for Code {
    fn from(error: &Error) -> Self {
        match error {
            Error::Syntax(_) => Self::BadJson,
            Error::BodyLost(_) | Error::BadHead(_) => Self::BadRequest,
            Error::Fields(_) => Self::InvalidRequest,
            Error::Unauthorized => Self::Unauthorized,
            Error::Forbidden(_) => Self::Forbidden,
            Error::OtherOrigin => Self::OtherOrigin,
            Error::HostNotAllowed(_) => Self::HostNotAllowed,
            Error::UriTooLong(_) => Self::UriTooLong,
            Error::HeadersTooLarge => Self::HeadersTooLarge,
            Error::TooManyRequests(_) => Self::TooManyRequests,
            Error::Overloaded => Self::Overloaded,
            Error::NotJson(_) => Self::UnsupportedMediaType,
            Error::UnknownCoding(_) => Self::UnsupportedCoding,
            Error::BodyTooLarge(_) => Self::BodyTooLarge,
            Error::TooManyRows { .. } => Self::TooManyRows,
            Error::NoSuchMachine(_) => Self::MachineNotFound,
            Error::NoSuchWorkspace(_) => Self::WorkspaceNotFound,
            Error::NoMesh(_) => Self::NoMesh,
            Error::NoSlice(_) => Self::NoSlice,
            Error::NoCells(_) => Self::NoCells,
            Error::NoSuchJob(_) => Self::JobNotFound,
            Error::QueueFull(_) => Self::QueueFull,
            Error::Stopping => Self::Stopping,
            Error::JobsUnavailable => Self::JobsUnavailable,
            Error::DiskFailing => Self::DiskFailing,
            Error::Cancelled | Error::JobCancelled => Self::JobCancelled,
            Error::JobTooLong => Self::JobTooLong,
            Error::OtherVersion => Self::OtherVersion,
            Error::NoRoom => Self::NoRoom,
            Error::NotAcceptable(_) | Error::NoEncoding => Self::NotAcceptable,
            Error::RangeNotSatisfiable(_) => Self::RangeNotSatisfiable,
            Error::NoSuchPath => Self::NotFound,
            Error::MethodNotAllowed => Self::MethodNotAllowed,
            Error::TimedOut => Self::TimedOut,
            Error::Internal => Self::Internal,
        }
    }
}
