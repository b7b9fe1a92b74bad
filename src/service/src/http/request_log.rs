//! Records each request: a span with its id and client, a line in the log if it fails or is rejected, and the metrics.

use std::num::NonZeroU32;
use std::sync::Arc;
use std::time::Instant;

use axum::extract::{MatchedPath, Request, State};
use axum::http::{HeaderMap, StatusCode};
use axum::middleware::Next;
use axum::response::Response;
use governor::{DefaultDirectRateLimiter, Quota, RateLimiter};
use opentelemetry::global;
use opentelemetry_http::HeaderExtractor;
use tracing::{Instrument, Span, debug, error, field, info, info_span};
use tracing_opentelemetry::OpenTelemetrySpanExt;

use crate::telemetry::metrics::requests::RequestMetrics;

/// The route of paths outside the API, such as the viewer's files and unknown paths.
const OTHER_ROUTE: &str = "other";

/// The header with a request's id.
const ID: &str = "x-request-id";

/// Most bytes of a value from the client in the log.
const MOST_BYTES: usize = 128;

/// Ten: most lines at once for a kind of rejection, and per minute after that. The metrics count all rejections.
const REJECTIONS_PER_MINUTE: NonZeroU32 = NonZeroU32::MIN.saturating_add(9);

/// Counts and logs requests.
#[derive(Clone)]
pub(crate) struct RequestObserver {
    requests: Arc<RequestMetrics>,
    /// Requests without a valid key.
    unauthorized: Arc<DefaultDirectRateLimiter>,
    /// Requests that the role, the origin or the host name forbids.
    forbidden: Arc<DefaultDirectRateLimiter>,
}

impl RequestObserver {
    /// Counts requests in these metrics.
    pub(crate) fn new(requests: Arc<RequestMetrics>) -> Self {
        let limiter = || Arc::new(RateLimiter::direct(Quota::per_minute(REJECTIONS_PER_MINUTE)));
        Self { requests, unauthorized: limiter(), forbidden: limiter() }
    }

    /// Whether a response with this status gets a line in the log about a rejection.
    fn logs_rejection(&self, status: StatusCode) -> bool {
        match status {
            StatusCode::UNAUTHORIZED => self.unauthorized.check().is_ok(),
            StatusCode::FORBIDDEN | StatusCode::MISDIRECTED_REQUEST => self.forbidden.check().is_ok(),
            _ => false,
        }
    }
}

/// Records a request when the head of its response is complete.
pub(crate) async fn observe(
    State(observer): State<RequestObserver>,
    request: Request,
    next: Next,
) -> Response {
    let route = request.extensions().get::<MatchedPath>().map(|path| path.as_str().to_owned());
    let route = route.unwrap_or_else(|| OTHER_ROUTE.to_owned());
    let method = request.method().clone();
    let id = request.headers().get(ID).and_then(|id| id.to_str().ok()).unwrap_or_default();
    let span = info_span!(
        "request",
        id,
        %method,
        path = shortened(request.uri().path()),
        otel.name = format!("{method} {route}"),
        otel.kind = "server",
        client = field::Empty,
        http.route = route,
        http.response.status_code = field::Empty,
    );
    continue_trace(&span, request.headers());
    let answering = observer.requests.begin(&method, route);
    let began = Instant::now();
    let response = next.run(request).instrument(span.clone()).await;
    let (status, latency) = (response.status(), began.elapsed());
    answering.end(status.as_u16(), latency);
    span.record("http.response.status_code", status.as_u16());
    span.in_scope(|| {
        if observer.logs_rejection(status) {
            info!(status = status.as_u16(), ?latency, "refused");
        } else if status.is_server_error() && status != StatusCode::SERVICE_UNAVAILABLE {
            error!(status = status.as_u16(), ?latency, "failed");
        } else {
            // Full services reject requests with 503. This must be fast, so only the metrics record it.
            debug!(status = status.as_u16(), ?latency, "answered");
        }
    });
    response
}

/// Records the client of the current request: the name of a key, or an address.
pub(crate) fn record_client(client: &str) {
    Span::current().record("client", client);
}

/// Removes the client's own request id if it is too long for the log.
pub(crate) fn remove_long_id(mut request: Request) -> Request {
    if request.headers().get(ID).is_some_and(|id| id.len() > MOST_BYTES) {
        request.headers_mut().remove(ID);
    }
    request
}

/// A path for the log.
fn shortened(path: &str) -> &str {
    path.get(..MOST_BYTES).unwrap_or(path)
}

/// Continues the trace of the client (W3C Trace Context), if it sent one and traces are collected.
fn continue_trace(span: &Span, headers: &HeaderMap) {
    if headers.contains_key("traceparent") {
        let parent = global::get_text_map_propagator(|known| known.extract(&HeaderExtractor(headers)));
        // Fails if no traces are collected.
        drop(span.set_parent(parent));
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::net::SocketAddr;

    use axum::body::Body;
    use axum::extract::{ConnectInfo, Request};
    use axum::http::header::AUTHORIZATION;
    use serde_json::Value;
    use tempfile::TempDir;
    use tower::ServiceExt;

    use crate::limits::key::Key;
    use crate::process::config::ServeConfig;
    use crate::process::service::Service;
    use crate::telemetry::captured_log::CapturedLog;
    use crate::test_service::settings;

    /// A service with one key with the role read, and the key.
    async fn service() -> (Service, Key) {
        let key = Key::generate().unwrap();
        let directory = TempDir::new().unwrap();
        let keys = directory.path().join("keys.toml");
        let entry = format!("[[key]]\nname = 'ada'\nrole = 'read'\nhash = '{}'\n", key.hash());
        std::fs::write(&keys, entry).unwrap();
        (Service::open(&ServeConfig { keys: Some(keys), ..settings("") }).await.unwrap(), key)
    }

    #[tokio::test]
    async fn many_rejections_write_few_lines() {
        let (service, known) = service().await;
        let logged = CapturedLog::begin();
        for _ in 0..200 {
            let request = Request::get("/machines").body(Body::empty()).unwrap();
            assert_eq!(service.router.clone().oneshot(request).await.unwrap().status(), 401);
        }
        // Ten at once, and then one every six seconds.
        let lines = logged.text().lines().count();
        assert!((10..30).contains(&lines), "{lines}");
        assert!(!logged.text().contains("\"status\":403"));
        // Another kind of rejection has lines of its own.
        let request = Request::get("/workspace").header(AUTHORIZATION, format!("Bearer {known}"));
        service.router.oneshot(request.body(Body::empty()).unwrap()).await.unwrap();
        assert!(logged.text().contains("\"status\":403"));
    }

    #[tokio::test]
    async fn the_line_of_a_rejection_names_the_client_and_no_secret() {
        let ((service, known), unknown) = (service().await, Key::generate().unwrap());
        let peer: SocketAddr = "10.0.0.7:4000".parse().unwrap();
        for (key, path, rejected) in [
            (&unknown, "/machines", Some(("10.0.0.7", 401))),
            (&known, "/workspace", Some(("ada", 403))),
            (&known, "/machines", None),
        ] {
            let logged = CapturedLog::begin();
            let request = Request::get(format!("{path}?hidden=1"))
                .header(AUTHORIZATION, format!("Bearer {key}"))
                .extension(ConnectInfo(peer));
            service.router.clone().oneshot(request.body(Body::empty()).unwrap()).await.unwrap();
            let text = logged.text();
            assert!(!text.contains(&key.to_string()) && !text.contains("hidden"), "{text}");
            let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
            let fields = |line: &Value| {
                let client = line["span"]["client"].as_str().unwrap().to_owned();
                (line["level"].to_string(), client, line["status"].as_u64().unwrap())
            };
            let expected =
                rejected.map(|(client, status)| ("\"INFO\"".to_owned(), client.to_owned(), status));
            assert_eq!(lines.iter().map(fields).collect::<Vec<_>>(), Vec::from_iter(expected), "{text}");
        }
    }
}
