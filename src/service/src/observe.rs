//! What is told of each request: a span with its id, a line where it failed, and its share of the metrics.

use std::sync::Arc;
use std::time::Instant;

use axum::extract::{MatchedPath, Request, State};
use axum::http::{HeaderMap, StatusCode};
use axum::middleware::Next;
use axum::response::Response;
use opentelemetry::global;
use opentelemetry_http::HeaderExtractor;
use tracing::{Instrument, Span, debug, error, field, info_span};
use tracing_opentelemetry::OpenTelemetrySpanExt;

use crate::metrics::Requests;

/// Paths that are no route of the API: the viewer's files, and what does not exist.
const ELSEWHERE: &str = "other";

/// The header with a request's id.
const ID: &str = "x-request-id";

/// Most bytes of what a client sends that are repeated in the log.
const LONGEST: usize = 128;

/// Observes a request until the head of its answer is there.
pub(crate) async fn observe(State(requests): State<Arc<Requests>>, request: Request, next: Next) -> Response {
    let route = request.extensions().get::<MatchedPath>().map(|path| path.as_str().to_owned());
    let route = route.unwrap_or_else(|| ELSEWHERE.to_owned());
    let method = request.method().clone();
    let id = request.headers().get(ID).and_then(|id| id.to_str().ok()).unwrap_or_default();
    let span = info_span!(
        "request",
        id,
        %method,
        path = shortened(request.uri().path()),
        otel.name = format!("{method} {route}"),
        otel.kind = "server",
        http.route = route,
        http.response.status_code = field::Empty,
    );
    continued(&span, request.headers());
    let answering = requests.begin(&method, route);
    let began = Instant::now();
    let response = next.run(request).instrument(span.clone()).await;
    let (status, latency) = (response.status(), began.elapsed());
    answering.end(status.as_u16(), latency);
    span.record("http.response.status_code", status.as_u16());
    span.in_scope(|| {
        // Refusing is no failure, and must not be slowed down by telling of it: the metrics do.
        if status.is_server_error() && status != StatusCode::SERVICE_UNAVAILABLE {
            error!(status = status.as_u16(), ?latency, "failed");
        } else {
            debug!(status = status.as_u16(), ?latency, "answered");
        }
    });
    response
}

/// Takes a client's own id of its request away if it is too long for the log.
pub(crate) fn without_long_id(mut request: Request) -> Request {
    if request.headers().get(ID).is_some_and(|id| id.len() > LONGEST) {
        request.headers_mut().remove(ID);
    }
    request
}

/// A path for the log.
fn shortened(path: &str) -> &str {
    path.get(..LONGEST).unwrap_or(path)
}

/// The trace of the caller goes on, if it sent one (W3C Trace Context) and traces are collected.
fn continued(span: &Span, headers: &HeaderMap) {
    if headers.contains_key("traceparent") {
        let caller = global::get_text_map_propagator(|known| known.extract(&HeaderExtractor(headers)));
        // Refused where nobody collects.
        drop(span.set_parent(caller));
    }
}
