//! The one map from errors to HTTP: status, stable `code`, and the problem document (RFC 9457).

use axum::body::{Body, Bytes, HttpBody};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::{BoxError, Extension};
use headers::{ContentRange, HeaderMapExt};
use serde::Serialize;
use utoipa::ToSchema;

use crate::error::{Error, Fault};

/// Seconds after which a service that is being restarted is worth asking again.
const PAUSE: u64 = 5;

/// Media type of every failure.
pub(crate) const PROBLEM_JSON: &str = "application/problem+json";

/// A failure, as RFC 9457 writes it.
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct Problem {
    /// Always `about:blank`: `code` tells failures apart.
    #[serde(rename = "type")]
    #[schema(example = "about:blank")]
    kind: &'static str,
    /// The status in words.
    title: String,
    /// The HTTP status.
    status: u16,
    /// Stable name of the failure, for programs.
    code: &'static str,
    /// What happened, for people.
    detail: String,
    /// The fields that cannot be used.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<FieldProblem>,
}

/// One bad field.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FieldProblem)]
struct FieldProblem {
    /// JSON Pointer into the body, such as `/machine/limits/stroke/0`; `/query/<name>` for a query parameter.
    pointer: String,
    /// What is wrong, and what would be accepted.
    detail: String,
}

impl From<Fault> for FieldProblem {
    fn from(Fault { pointer, detail }: Fault) -> Self {
        Self { pointer, detail }
    }
}

fn status_and_code(error: &Error) -> (StatusCode, &'static str) {
    match error {
        Error::Syntax(_) => (StatusCode::BAD_REQUEST, "bad_json"),
        Error::BodyLost(_) => (StatusCode::BAD_REQUEST, "bad_request"),
        Error::Fields(_) => (StatusCode::UNPROCESSABLE_ENTITY, "invalid_request"),
        Error::Unauthorized => (StatusCode::UNAUTHORIZED, "unauthorized"),
        Error::Forbidden(_) => (StatusCode::FORBIDDEN, "forbidden"),
        Error::TooManyRequests(_) => (StatusCode::TOO_MANY_REQUESTS, "too_many_requests"),
        Error::Overloaded => (StatusCode::SERVICE_UNAVAILABLE, "overloaded"),
        Error::NotJson(_) => (StatusCode::UNSUPPORTED_MEDIA_TYPE, "unsupported_media_type"),
        Error::BodyTooLarge(_) => (StatusCode::PAYLOAD_TOO_LARGE, "body_too_large"),
        Error::TooManyRows { .. } => (StatusCode::PAYLOAD_TOO_LARGE, "too_many_rows"),
        Error::NoSuchMachine(_) => (StatusCode::NOT_FOUND, "machine_not_found"),
        Error::NoSuchWorkspace(_) => (StatusCode::NOT_FOUND, "workspace_not_found"),
        Error::NoMesh(_) => (StatusCode::NOT_FOUND, "no_mesh"),
        Error::NoSlice(_) => (StatusCode::NOT_FOUND, "no_slice"),
        Error::NoCells(_) => (StatusCode::NOT_FOUND, "no_cells"),
        Error::NoSuchJob(_) => (StatusCode::NOT_FOUND, "job_not_found"),
        Error::QueueFull(_) => (StatusCode::SERVICE_UNAVAILABLE, "queue_full"),
        Error::Stopping => (StatusCode::SERVICE_UNAVAILABLE, "stopping"),
        Error::JobsUnavailable => (StatusCode::SERVICE_UNAVAILABLE, "jobs_unavailable"),
        Error::DiskFailing => (StatusCode::SERVICE_UNAVAILABLE, "disk_failing"),
        Error::Cancelled | Error::JobCancelled => (StatusCode::CONFLICT, "job_cancelled"),
        Error::JobTooLong => (StatusCode::SERVICE_UNAVAILABLE, "job_too_long"),
        Error::OtherVersion => (StatusCode::CONFLICT, "other_version"),
        Error::NoRoom => (StatusCode::INSUFFICIENT_STORAGE, "no_room"),
        Error::NotAcceptable(_) | Error::NoEncoding => (StatusCode::NOT_ACCEPTABLE, "not_acceptable"),
        Error::RangeNotSatisfiable(_) => (StatusCode::RANGE_NOT_SATISFIABLE, "range_not_satisfiable"),
        Error::NoSuchPath => (StatusCode::NOT_FOUND, "not_found"),
        Error::MethodNotAllowed => (StatusCode::METHOD_NOT_ALLOWED, "method_not_allowed"),
        Error::TimedOut => (StatusCode::SERVICE_UNAVAILABLE, "timed_out"),
        Error::Internal => (StatusCode::INTERNAL_SERVER_ERROR, "internal"),
    }
}

impl Problem {
    /// The HTTP status.
    pub(crate) fn status(&self) -> u16 {
        self.status
    }
}

/// The error behind a bare status that the framework answered by itself.
fn error_behind(status: StatusCode) -> Error {
    match status {
        StatusCode::METHOD_NOT_ALLOWED => Error::MethodNotAllowed,
        StatusCode::NOT_FOUND => Error::NoSuchPath,
        StatusCode::NOT_ACCEPTABLE => Error::NoEncoding,
        StatusCode::SERVICE_UNAVAILABLE => Error::TimedOut,
        StatusCode::INTERNAL_SERVER_ERROR => Error::Internal,
        _ => Error::BodyLost(status.to_string()),
    }
}

impl From<Error> for Problem {
    fn from(error: Error) -> Self {
        let (status, code) = status_and_code(&error);
        let title = status.canonical_reason().unwrap_or("Error").to_owned();
        let detail = error.to_string();
        let errors = match error {
            Error::Fields(faults) => faults.into_iter().map(FieldProblem::from).collect(),
            _ => Vec::new(),
        };
        Self { kind: "about:blank", title, status: status.as_u16(), code, detail, errors }
    }
}

/// The status that a response's document speaks of.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Documented(StatusCode);

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let body = serde_json::to_vec(&self).unwrap_or_default();
        let media = [(header::CONTENT_TYPE, HeaderValue::from_static(PROBLEM_JSON))];
        (status, Extension(Documented(status)), media, body).into_response()
    }
}

impl IntoResponse for Error {
    fn into_response(self) -> Response {
        let keyless = self == Self::Unauthorized;
        let length = if let Self::RangeNotSatisfiable(length) = self { Some(length) } else { None };
        let pause = match self {
            Self::QueueFull(seconds) | Self::TooManyRequests(seconds) => Some(seconds),
            Self::Overloaded => Some(1),
            Self::Stopping | Self::JobsUnavailable | Self::DiskFailing => Some(PAUSE),
            _ => None,
        };
        let mut response = Problem::from(self).into_response();
        if let Some(length) = length {
            response.headers_mut().typed_insert(ContentRange::unsatisfied_bytes(length));
        }
        if keyless {
            response.headers_mut().insert(header::WWW_AUTHENTICATE, HeaderValue::from_static("Bearer"));
        }
        if let Some(pause) = pause {
            response.headers_mut().insert(header::RETRY_AFTER, pause.into());
        }
        response
    }
}

/// Gives a problem document to every failure that the framework answered without one (a method
/// that is not allowed, a time-out, a panic, no encoding that is accepted); headers such as Allow stay.
pub(crate) fn give_every_failure_a_document<B>(response: axum::http::Response<B>) -> Response
where
    B: HttpBody<Data = Bytes> + Send + 'static,
    B::Error: Into<BoxError>,
{
    let status = response.status();
    if !(status.is_client_error() || status.is_server_error()) || is_documented(&response) {
        return response.map(Body::new);
    }
    let (mut parts, _) = response.into_parts();
    let (document, body) = error_behind(status).into_response().into_parts();
    // Those of the answer that is not sent.
    for name in [header::CONTENT_LENGTH, header::CACHE_CONTROL, header::ETAG] {
        parts.headers.remove(name);
    }
    parts.headers.extend(document.headers);
    parts.status = document.status;
    Response::from_parts(parts, body)
}

fn is_documented<B>(response: &axum::http::Response<B>) -> bool {
    response.extensions().get() == Some(&Documented(response.status()))
}
