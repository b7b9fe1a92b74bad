//! What happens around every request: ids, traces, CORS, compression, time-outs, panics.

use std::time::Duration;

use axum::Router;
use axum::http::{Request, StatusCode};
use axum::middleware::map_response;
use tower::ServiceBuilder;
use tower_http::catch_panic::CatchPanicLayer;
use tower_http::compression::CompressionLayer;
use tower_http::cors::{Any, CorsLayer};
use tower_http::request_id::{MakeRequestUuid, PropagateRequestIdLayer, RequestId, SetRequestIdLayer};
use tower_http::timeout::TimeoutLayer;
use tower_http::trace::TraceLayer;
use tracing::{Span, info_span};

use crate::problem::give_every_failure_a_document;

/// Wraps the routes; the first layer here is the outermost.
pub(crate) fn wrap(routes: Router, time_limit: Duration) -> Router {
    let guarded = ServiceBuilder::new()
        .layer(TimeoutLayer::with_status_code(StatusCode::SERVICE_UNAVAILABLE, time_limit))
        .layer(CatchPanicLayer::new());
    let answered = routes.layer(guarded).layer(map_response(give_every_failure_a_document));
    answered.layer(
        ServiceBuilder::new()
            .layer(SetRequestIdLayer::x_request_id(MakeRequestUuid))
            .layer(TraceLayer::new_for_http().make_span_with(span))
            .layer(PropagateRequestIdLayer::x_request_id())
            .layer(open_to_browsers())
            .layer(CompressionLayer::new()),
    )
}

/// The service keeps no secrets and no sessions: any page may ask.
fn open_to_browsers() -> CorsLayer {
    CorsLayer::new().allow_origin(Any).allow_methods(Any).allow_headers(Any).expose_headers(Any)
}

fn span<B>(request: &Request<B>) -> Span {
    let id = request.extensions().get::<RequestId>().and_then(|id| id.header_value().to_str().ok());
    info_span!("request", method = %request.method(), path = request.uri().path(), id)
}
