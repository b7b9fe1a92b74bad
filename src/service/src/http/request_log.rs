//! What is told of each request: a span with its id and who sent it, a line where it failed or its sender may not, and its
//! share of the metrics.

use std::sync::Arc;
use std::time::Instant;

use axum::extract::{MatchedPath, Request, State};
use axum::http::{HeaderMap, StatusCode};
use axum::middleware::Next;
use axum::response::Response;
use opentelemetry::global;
use opentelemetry_http::HeaderExtractor;
use tracing::{Instrument, Span, debug, error, field, info, info_span};
use tracing_opentelemetry::OpenTelemetrySpanExt;

use crate::http::refusal_log::Refusals;
use crate::telemetry::metrics::requests::RequestMetrics;

/// Paths that are no route of the API: the viewer's files, and what does not exist.
const ELSEWHERE: &str = "other";

/// The header with a request's id.
const ID: &str = "x-request-id";

/// Most bytes of what a client sends that are repeated in the log.
const LONGEST: usize = 128;

/// Where what is observed goes.
#[derive(Clone)]
pub(crate) struct Observer {
    requests: Arc<RequestMetrics>,
    /// Whose key is not known.
    unknown: Arc<Refusals>,
    /// Who may not what was asked for, or not from where.
    forbidden: Arc<Refusals>,
}

impl Observer {
    /// Counts requests.
    pub(crate) fn new(requests: Arc<RequestMetrics>) -> Self {
        Self { requests, unknown: Arc::default(), forbidden: Arc::default() }
    }

    /// Whether an answer with this status has a line in the log that its sender was refused.
    fn tells(&self, status: StatusCode) -> bool {
        match status {
            StatusCode::UNAUTHORIZED => self.unknown.has_line(status.as_u16()),
            _ => self.forbidden.has_line(status.as_u16()),
        }
    }
}

/// Observes a request until the head of its answer is there.
pub(crate) async fn observe(State(observer): State<Observer>, request: Request, next: Next) -> Response {
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
        client = field::Empty,
        http.route = route,
        http.response.status_code = field::Empty,
    );
    continued(&span, request.headers());
    let answering = observer.requests.begin(&method, route);
    let began = Instant::now();
    let response = next.run(request).instrument(span.clone()).await;
    let (status, latency) = (response.status(), began.elapsed());
    answering.end(status.as_u16(), latency);
    span.record("http.response.status_code", status.as_u16());
    span.in_scope(|| {
        match status {
            StatusCode::UNAUTHORIZED | StatusCode::FORBIDDEN | StatusCode::MISDIRECTED_REQUEST
                if observer.tells(status) =>
            {
                info!(status = status.as_u16(), ?latency, "refused");
            }
            // Refusing for want of room is no failure, and must not be slowed down by telling of it: the metrics do.
            status if status.is_server_error() && status != StatusCode::SERVICE_UNAVAILABLE => {
                error!(status = status.as_u16(), ?latency, "failed");
            }
            _ => debug!(status = status.as_u16(), ?latency, "answered"),
        }
    });
    response
}

/// Who sends the request at hand, once that is known: the name of a key, or an address.
pub(crate) fn sent_by(client: &str) {
    Span::current().record("client", client);
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::net::SocketAddr;

    use axum::body::Body;
    use axum::extract::{ConnectInfo, Request};
    use axum::http::header::AUTHORIZATION;
    use clap::{Args, Command, FromArgMatches};
    use serde_json::Value;
    use tempfile::TempDir;
    use tower::ServiceExt;

    use crate::limits::key::Key;
    use crate::process::config::ServeConfig;
    use crate::process::service::Service;
    use crate::telemetry::captured_log::CapturedLog;

    /// A service with one key, which may read, and the key.
    async fn service() -> (Service, Key) {
        let key = Key::fresh().unwrap();
        let place = TempDir::new().unwrap();
        let keys = place.path().join("keys.toml");
        let entry = format!("[[key]]\nname = 'ada'\nrole = 'read'\nhash = '{}'\n", key.hash());
        std::fs::write(&keys, entry).unwrap();
        let command = ServeConfig::augment_args(Command::new("verne").no_binary_name(true));
        let config = ServeConfig::from_arg_matches(&command.get_matches_from(["--memory-only"])).unwrap();
        (Service::open(&ServeConfig { keys: Some(keys), ..config }).await.unwrap(), key)
    }

    #[tokio::test]
    async fn a_flood_of_refusals_is_a_few_lines() {
        let (service, known) = service().await;
        let logged = CapturedLog::begin();
        for _ in 0..200 {
            let request = Request::get("/machines").body(Body::empty()).unwrap();
            assert_eq!(service.router.clone().oneshot(request).await.unwrap().status(), 401);
        }
        assert_eq!(logged.text().lines().count(), 10);
        // They hide no other refusal.
        let request = Request::get("/workspace").header(AUTHORIZATION, format!("Bearer {known}"));
        service.router.oneshot(request.body(Body::empty()).unwrap()).await.unwrap();
        assert_eq!(logged.text().lines().count(), 11);
    }

    #[tokio::test]
    async fn a_refusal_tells_who_was_refused_and_no_secret() {
        let ((service, known), unknown) = (service().await, Key::fresh().unwrap());
        let peer: SocketAddr = "10.0.0.7:4000".parse().unwrap();
        for (key, path, refused) in [
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
            let told = |line: &Value| {
                let client = line["span"]["client"].as_str().unwrap().to_owned();
                (line["level"].to_string(), client, line["status"].as_u64().unwrap())
            };
            let expected = refused.map(|(client, status)| ("\"INFO\"".to_owned(), client.to_owned(), status));
            assert_eq!(lines.iter().map(told).collect::<Vec<_>>(), Vec::from_iter(expected), "{text}");
        }
    }
}
