//! What happens around every request: ids, observation, CORS, compression, time-outs, panics.

use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::body::HttpBody;
use axum::http::header::ETAG;
use axum::http::{Response, StatusCode};
use axum::middleware::from_fn_with_state;
use tower::ServiceBuilder;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::compression::CompressionLayer;
use tower_http::compression::predicate::{DefaultPredicate, Predicate};
use tower_http::request_id::{MakeRequestUuid, PropagateRequestIdLayer, SetRequestIdLayer};
use tower_http::timeout::TimeoutLayer;

use crate::browsers::Browsers;
use crate::metrics::Requests;
use crate::observe::{observe, without_long_id};
use crate::problem::give_every_failure_a_document;

/// Wraps the routes; the first layer here is the outermost. One stack: each call of `Router::layer` would box every
/// request once more.
pub(crate) fn wrap(
    routes: Router,
    requests: Arc<Requests>,
    time_limit: Duration,
    browsers: &Browsers,
) -> Router {
    routes.layer(
        ServiceBuilder::new()
            .map_request(without_long_id)
            .layer(SetRequestIdLayer::x_request_id(MakeRequestUuid))
            .layer(from_fn_with_state(requests, observe))
            .layer(PropagateRequestIdLayer::x_request_id())
            .option_layer(browsers.cors())
            .map_response(browsers.protect())
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
