//! Problem documents (RFC 9457): the response to each [`HttpError`], with status, stable `code` and headers.

pub(crate) mod code;

use axum::body::{Body, Bytes, HttpBody};
use axum::http::{HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::{BoxError, Extension};
use serde::Serialize;
use utoipa::ToSchema;

use crate::http::content_coding::Coding;
use crate::http::error::{AccessError, HttpError, JobError, RequestError};
use crate::http::problem::code::Code;
use crate::limits::error::LimitError;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::program::ProgramFault;

/// Retry-After of a service that may be restarting, in seconds.
const RESTART_SECONDS: u64 = 5;

/// Media type of problem documents.
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
    /// The invalid fields, or the faults of the program.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<ErrorEntry>,
}

/// An entry of `errors`.
#[derive(Debug, Serialize, ToSchema)]
#[serde(untagged)]
pub(crate) enum ErrorEntry {
    /// An invalid field.
    Field(FieldError),
    /// A fault of a program.
    Program(ProgramFault),
}

/// The error of a bare status that axum or tower returned.
fn error_of_status(status: StatusCode) -> HttpError {
    match status {
        StatusCode::METHOD_NOT_ALLOWED => HttpError::MethodNotAllowed,
        StatusCode::NOT_FOUND => HttpError::UnknownPath,
        StatusCode::NOT_ACCEPTABLE => HttpError::NoAcceptableCoding,
        StatusCode::INTERNAL_SERVER_ERROR => OperationError::Internal.into(),
        _ => RequestError::UnreadableBody(status.to_string()).into(),
    }
}

impl From<HttpError> for Problem {
    fn from(error: HttpError) -> Self {
        let code = Code::from(&error);
        let status = code.status();
        let title = status.canonical_reason().unwrap_or("Error").to_owned();
        let detail = error.to_string();
        let errors = match error {
            HttpError::Operation(OperationError::Fields(errors)) => {
                errors.into_iter().map(ErrorEntry::Field).collect()
            }
            HttpError::Operation(OperationError::ProgramFaults(refused)) => {
                refused.errors.into_iter().map(|fault| ErrorEntry::Program(fault.into())).collect()
            }
            _ => Vec::new(),
        };
        Self { kind: "about:blank", title, status: status.as_u16(), code: code.name(), detail, errors }
    }
}

/// Extension of a response with a problem document: the status in the document. tower-http's compression may replace
/// the status of the response by 406.
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

impl IntoResponse for HttpError {
    fn into_response(self) -> Response {
        if let Self::Job(JobError::RecordsUnavailable(unavailable)) = &self {
            tracing::error!(%unavailable, "cannot read or write job records");
        }
        let header = header_of(&self);
        let mut response = Problem::from(self).into_response();
        response.headers_mut().extend(header);
        response
    }
}

/// The header that an error adds to its document.
fn header_of(error: &HttpError) -> Option<(HeaderName, HeaderValue)> {
    let retry_after = |seconds: u64| Some((header::RETRY_AFTER, seconds.into()));
    match error {
        HttpError::Job(JobError::QueueFull(seconds))
        | HttpError::Limit(LimitError::TooManyRequests(seconds)) => retry_after(*seconds),
        HttpError::Limit(LimitError::Overloaded) => retry_after(1),
        HttpError::Job(JobError::Stopping | JobError::RecordsUnavailable(_))
        | HttpError::Operation(OperationError::StoreUnavailable) => retry_after(RESTART_SECONDS),
        HttpError::Access(AccessError::Unauthorized) => {
            Some((header::WWW_AUTHENTICATE, HeaderValue::from_static("Bearer")))
        }
        HttpError::Request(RequestError::UnsupportedCoding(_)) => {
            Some((header::ACCEPT_ENCODING, HeaderValue::from_static(Coding::ACCEPTED)))
        }
        HttpError::RangeNotSatisfiable(length) => {
            let range = HeaderValue::try_from(format!("bytes */{length}")).ok()?;
            Some((header::CONTENT_RANGE, range))
        }
        _ => None,
    }
}

/// Adds a problem document to an error response of axum or tower that has none: wrong method, panic, no
/// acceptable coding. Headers such as Allow stay.
pub(crate) fn add_missing_problem<B>(response: axum::http::Response<B>) -> Response
where
    B: HttpBody<Data = Bytes> + Send + 'static,
    B::Error: Into<BoxError>,
{
    let status = response.status();
    let is_documented = response.extensions().get() == Some(&Documented(status));
    if !(status.is_client_error() || status.is_server_error()) || is_documented {
        return response.map(Body::new);
    }
    let (mut parts, _) = response.into_parts();
    let (document, body) = error_of_status(status).into_response().into_parts();
    // These describe the body that is replaced.
    for name in [header::CONTENT_LENGTH, header::CACHE_CONTROL, header::ETAG] {
        parts.headers.remove(name);
    }
    parts.headers.extend(document.headers);
    parts.status = document.status;
    Response::from_parts(parts, body)
}
