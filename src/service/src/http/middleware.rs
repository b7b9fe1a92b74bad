//! The layers around all routes: request ids, log and metrics, CORS, problems, compression, time limit, panics.

use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::body::HttpBody;
use axum::http::Response;
use axum::http::header::ETAG;
use axum::middleware::from_fn_with_state;
use tower::ServiceBuilder;
use tower_http::CompressionLevel;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::compression::CompressionLayer;
use tower_http::compression::predicate::{DefaultPredicate, Predicate};
use tower_http::request_id::{MakeRequestUuid, PropagateRequestIdLayer, SetRequestIdLayer};

use crate::http::forwarded_for::client_behind;
use crate::http::problem::add_missing_problem;
use crate::http::proxy::ProxyNetwork;
use crate::http::request_log::{RequestObserver, observe, remove_long_id};
use crate::http::security_headers::BrowserPolicy;
use crate::http::time_limit::limit_time;
use crate::telemetry::metrics::requests::RequestMetrics;

/// Adds the layers to the routes. The first layer here is the outermost. They are one stack because each call of
/// `Router::layer` boxes every request once more.
pub(crate) fn wrap(
    routes: Router,
    requests: Arc<RequestMetrics>,
    time_limit: Duration,
    browsers: &BrowserPolicy,
    proxies: Vec<ProxyNetwork>,
) -> Router {
    routes.layer(
        ServiceBuilder::new()
            .map_request(client_behind(proxies))
            .map_request(remove_long_id)
            .layer(SetRequestIdLayer::x_request_id(MakeRequestUuid))
            .layer(from_fn_with_state(RequestObserver::new(requests), observe))
            .layer(PropagateRequestIdLayer::x_request_id())
            .option_layer(browsers.cors())
            .map_response(browsers.add_headers())
            .map_response(add_missing_problem)
            .layer(compression())
            .layer(from_fn_with_state(time_limit, limit_time))
            .layer(CatchPanicLayer::new()),
    )
}

/// Most bytes of a body that is compressed. Larger bodies, such as those of batches, are not.
const MOST_COMPRESSED_BYTES: u64 = 48 * 1024;

/// Compresses small bodies at the lowest level: a thread of the runtime needs less than half a millisecond for it.
fn compression() -> CompressionLayer<impl Predicate> {
    let when = DefaultPredicate::new().and(Compressible);
    CompressionLayer::new().quality(CompressionLevel::Fastest).compress_when(when)
}

#[derive(Clone, Copy)]
struct Compressible;

impl Predicate for Compressible {
    fn should_compress<B: HttpBody>(&self, response: &Response<B>) -> bool {
        // A strong ETag and byte ranges refer to the identical bytes.
        !response.headers().contains_key(ETAG)
            && response.body().size_hint().upper().is_some_and(|bytes| bytes <= MOST_COMPRESSED_BYTES)
    }
}
