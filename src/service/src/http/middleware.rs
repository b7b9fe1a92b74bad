//! What happens around every request: ids, observation, CORS, compression, time-outs, panics.

use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::body::HttpBody;
use axum::http::header::ETAG;
use axum::http::{Response, StatusCode};
use axum::middleware::from_fn_with_state;
use tower::ServiceBuilder;
use tower_http::CompressionLevel;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::compression::CompressionLayer;
use tower_http::compression::predicate::{DefaultPredicate, Predicate};
use tower_http::request_id::{MakeRequestUuid, PropagateRequestIdLayer, SetRequestIdLayer};
use tower_http::timeout::TimeoutLayer;

use crate::http::forwarded_for::client_behind;
use crate::http::problem::give_every_failure_a_document;
use crate::http::proxy::ProxyNetwork;
use crate::http::request_log::{Observer, observe, without_long_id};
use crate::http::security_headers::Browsers;
use crate::telemetry::metrics::requests::RequestMetrics;

/// Wraps the routes; the first layer here is the outermost. One stack: each call of `Router::layer` would box every
/// request once more.
pub(crate) fn wrap(
    routes: Router,
    requests: Arc<RequestMetrics>,
    time_limit: Duration,
    browsers: &Browsers,
    proxies: Vec<ProxyNetwork>,
) -> Router {
    routes.layer(
        ServiceBuilder::new()
            .map_request(client_behind(proxies))
            .map_request(without_long_id)
            .layer(SetRequestIdLayer::x_request_id(MakeRequestUuid))
            .layer(from_fn_with_state(Observer::new(requests), observe))
            .layer(PropagateRequestIdLayer::x_request_id())
            .option_layer(browsers.cors())
            .map_response(browsers.protect())
            .map_response(give_every_failure_a_document)
            .layer(compression())
            .layer(TimeoutLayer::with_status_code(StatusCode::SERVICE_UNAVAILABLE, time_limit))
            .layer(CatchPanicLayer::new()),
    )
}

/// Compresses what is small, and at the first level: a runtime's thread does it, in less than half a millisecond.
fn compression() -> CompressionLayer<impl Predicate> {
    let when = DefaultPredicate::new().and(Untagged).and(Small);
    CompressionLayer::new().quality(CompressionLevel::Fastest).compress_when(when)
}

/// Most bytes of a body that is compressed.
const SMALL: u64 = 48 * 1024;

/// Batches, for one, are sent as they are.
#[derive(Clone, Copy)]
struct Small;

impl Predicate for Small {
    fn should_compress<B: HttpBody>(&self, response: &Response<B>) -> bool {
        response.body().size_hint().upper().is_some_and(|bytes| bytes <= SMALL)
    }
}

/// A strong ETag promises these very bytes, and ranges count them: what carries one is sent as it is.
#[derive(Clone, Copy)]
struct Untagged;

impl Predicate for Untagged {
    fn should_compress<B: HttpBody>(&self, response: &Response<B>) -> bool {
        !response.headers().contains_key(ETAG)
    }
}
