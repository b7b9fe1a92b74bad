//! From errors to HTTP: the problem document (RFC 9457) with status and stable `code`, and its headers.

pub(crate) mod code;

use axum::body::{Body, Bytes, HttpBody};
use axum::http::{HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::{BoxError, Extension};
use serde::Serialize;
use utoipa::ToSchema;

use crate::http::content_coding::Coding;
use crate::http::problem::code::Code;
use crate::wire::error::{Error, Fault};

/// Seconds after which a service that is being restarted is worth asking again.
const PAUSE: u64 = 5;

/// Media type of every failure.
pub(crate) const PROBLEM_JSON: &str = "application/problem+json";

/// A problem document (RFC 9457).
#[derive(Debug, Serialize, ToSchema)]
pub(crate) struct Problem {
    /// Always `about:blank`. `code` identifies the problem.
    #[serde(rename = "type")]
    #[schema(example = "about:blank")]
    kind: &'static str,
    /// The name of the HTTP status.
    title: String,
    /// The HTTP status.
    status: u16,
    /// Stable name of the problem, for programs.
    code: &'static str,
    /// Description of the problem, for people.
    detail: String,
    /// The invalid fields.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<FieldProblem>,
}

/// One invalid field.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FieldProblem)]
struct FieldProblem {
    /// JSON Pointer into the body, such as `/machine/limits/stroke/0`; `/query/<name>` for a query parameter.
    pointer: String,
    /// The error, and the accepted values.
    detail: String,
}

impl From<Fault> for FieldProblem {
    fn from(Fault { pointer, detail }: Fault) -> Self {
        Self { pointer, detail }
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
        let code = Code::from(&error);
        let status = code.status();
        let title = status.canonical_reason().unwrap_or("Error").to_owned();
        let detail = error.to_string();
        let errors = match error {
            Error::Fields(faults) => faults.into_iter().map(FieldProblem::from).collect(),
            _ => Vec::new(),
        };
        Self { kind: "about:blank", title, status: status.as_u16(), code: code.name(), detail, errors }
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
        let header = header_of(&self);
        let mut response = Problem::from(self).into_response();
        response.headers_mut().extend(header);
        response
    }
}

/// What an error says in a header.
fn header_of(error: &Error) -> Option<(HeaderName, HeaderValue)> {
    let pause = |seconds: u64| Some((header::RETRY_AFTER, seconds.into()));
    match error {
        Error::QueueFull(seconds) | Error::TooManyRequests(seconds) => pause(*seconds),
        Error::Overloaded => pause(1),
        Error::Stopping | Error::JobsUnavailable | Error::DiskFailing => pause(PAUSE),
        Error::Unauthorized => Some((header::WWW_AUTHENTICATE, HeaderValue::from_static("Bearer"))),
        Error::UnknownCoding(_) => {
            Some((header::ACCEPT_ENCODING, HeaderValue::from_static(Coding::ACCEPTED)))
        }
        Error::RangeNotSatisfiable(length) => {
            let range = HeaderValue::try_from(format!("bytes */{length}")).ok()?;
            Some((header::CONTENT_RANGE, range))
        }
        _ => None,
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
