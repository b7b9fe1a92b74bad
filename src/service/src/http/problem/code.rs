//! The stable name of each failure: its status and its meaning. Answers and the OpenAPI document are made from this table.

use axum::http::StatusCode;

use crate::wire::error::Error;

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
    BadRequest, "bad_request", BAD_REQUEST, "The body is incomplete, or the service cannot decode it.";
    Unauthorized, "unauthorized", UNAUTHORIZED, "The service requires an API key, and the request has no valid one.";
    Forbidden, "forbidden", FORBIDDEN, "The role of the API key does not allow this request.";
    OtherOrigin, "other_origin", FORBIDDEN,
        "A web page of another origin cannot start or cancel jobs or send POST requests.";
    HostNotAllowed, "host_not_allowed", MISDIRECTED_REQUEST,
        "The service does not accept the host name in the header Host.";
    UriTooLong, "uri_too_long", URI_TOO_LONG, "The request URI is longer than the limit.";
    HeadersTooLarge, "headers_too_large", REQUEST_HEADER_FIELDS_TOO_LARGE,
        "The size or the number of the request headers exceeds the limit.";
    NotFound, "not_found", NOT_FOUND, "No operation has this path.";
    MachineNotFound, "machine_not_found", NOT_FOUND, "No machine has this name.";
    WorkspaceNotFound, "workspace_not_found", NOT_FOUND, "No stored result has this id.";
    NoMesh, "no_mesh", NOT_FOUND, "A family of workspaces has no mesh of its own.";
    NoSlice, "no_slice", NOT_FOUND, "Only a single workspace has slices.";
    NoCells, "no_cells", NOT_FOUND, "Only a dexterity map has a grid of points.";
    JobNotFound, "job_not_found", NOT_FOUND, "No job record has this id.";
    MethodNotAllowed, "method_not_allowed", METHOD_NOT_ALLOWED, "The path does not support the method.";
    NotAcceptable, "not_acceptable", NOT_ACCEPTABLE,
        "Accept allows no available media type, or Accept-Encoding allows no available coding.";
    JobCancelled, "job_cancelled", CONFLICT, "The job was cancelled while the request waited for it.";
    OtherVersion, "other_version", CONFLICT, "Another version of the service created the job.";
    BodyTooLarge, "body_too_large", PAYLOAD_TOO_LARGE, "The decoded body is larger than the limit.";
    TooManyRows, "too_many_rows", PAYLOAD_TOO_LARGE, "The batch has more rows than the limit.";
    UnsupportedMediaType, "unsupported_media_type", UNSUPPORTED_MEDIA_TYPE,
        "The Content-Type of the body is not application/json.";
    UnsupportedCoding, "unsupported_coding", UNSUPPORTED_MEDIA_TYPE,
        "The Content-Encoding of the body is neither gzip nor br.";
    RangeNotSatisfiable, "range_not_satisfiable", RANGE_NOT_SATISFIABLE,
        "The range starts beyond the end of the content.";
    InvalidRequest, "invalid_request", UNPROCESSABLE_ENTITY, "Fields or query parameters are invalid.";
    TooManyRequests, "too_many_requests", TOO_MANY_REQUESTS, "The client exceeded its request rate.";
    Internal, "internal", INTERNAL_SERVER_ERROR, "The service has a defect.";
    Overloaded, "overloaded", SERVICE_UNAVAILABLE,
        "The server is at its limit of requests, connections or memory, in total or for this client.";
    QueueFull, "queue_full", SERVICE_UNAVAILABLE, "The job queue is full.";
    Stopping, "stopping", SERVICE_UNAVAILABLE, "The service is stopping.";
    JobsUnavailable, "jobs_unavailable", SERVICE_UNAVAILABLE, "The service cannot read or write its job records.";
    DiskFailing, "disk_failing", SERVICE_UNAVAILABLE, "The service cannot store results.";
    JobTooLong, "job_too_long", SERVICE_UNAVAILABLE, "The job exceeded its time limit.";
    TimedOut, "timed_out", SERVICE_UNAVAILABLE, "The request exceeded its time limit.";
    NoRoom, "no_room", INSUFFICIENT_STORAGE, "The result is larger than the whole storage for results.";
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
