//! What happens around every request: ids, traces, CORS, compression, time-outs, panics.

use std::time::Duration;

use axum::Router;
use axum::body::HttpBody;
use axum::http::header::ETAG;
use axum::http::{Request, Response, StatusCode};
use tower::ServiceBuilder;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::compression::CompressionLayer;
use tower_http::compression::predicate::{DefaultPredicate, Predicate};
use tower_http::cors::{Any, CorsLayer};
use tower_http::request_id::{MakeRequestUuid, PropagateRequestIdLayer, SetRequestIdLayer};
use tower_http::timeout::TimeoutLayer;
use tower_http::trace::TraceLayer;
use tracing::{Span, debug, debug_span, error};

use crate::problem::give_every_failure_a_document;

/// Wraps the routes; the first layer here is the outermost. One stack: each call of `Router::layer` would box every
/// request once more.
pub(crate) fn wrap(routes: Router, time_limit: Duration) -> Router {
    routes.layer(
        ServiceBuilder::new()
            .layer(SetRequestIdLayer::x_request_id(MakeRequestUuid))
            .layer(TraceLayer::new_for_http().make_span_with(span).on_response(report).on_failure(()))
            .layer(PropagateRequestIdLayer::x_request_id())
            .layer(open_to_browsers())
            .layer(CompressionLayer::new().compress_when(DefaultPredicate::new().and(Untagged)))
            .map_response(give_every_failure_a_document)
            .layer(TimeoutLayer::with_status_code(StatusCode::SERVICE_UNAVAILABLE, time_limit))
            .layer(CatchPanicLayer::new()),
    )
}

/// A strong ETag promises these very bytes, and ranges count them: what carries one is sent as it is.
#[derive(Clone, Copy)]
struct Untagged;

impl Predicate for Untagged {
    fn should_compress<B: HttpBody>(&self, response: &Response<B>) -> bool {
        !response.headers().contains_key(ETAG)
    }
}

/// The service keeps no secrets and no state of its callers: any page may ask.
fn open_to_browsers() -> CorsLayer {
    CorsLayer::new().allow_origin(Any).allow_methods(Any).allow_headers(Any).expose_headers(Any)
}

/// Every request at level debug.
fn span<B>(request: &Request<B>) -> Span {
    debug_span!("request", method = %request.method(), uri = %request.uri())
}

/// Every answer at level debug, the service's own failures as errors; the id leads from one to the other.
fn report<B>(response: &Response<B>, latency: Duration, _: &Span) {
    let id = response.headers().get("x-request-id").and_then(|id| id.to_str().ok());
    let status = response.status().as_u16();
    if response.status().is_server_error() {
        error!(status, id, ?latency, "failed");
    } else {
        debug!(status, id, ?latency, "answered");
    }
}
