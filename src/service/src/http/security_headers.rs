//! What browsers are told: whose pages may ask, and what our own pages may do.

use std::time::Duration;

use axum::Router;
use axum::http::header::{
    ACCEPT, AUTHORIZATION, CONTENT_DISPOSITION, CONTENT_ENCODING, CONTENT_LOCATION, CONTENT_RANGE,
    CONTENT_SECURITY_POLICY, CONTENT_TYPE, ETAG, HeaderName, IF_NONE_MATCH, LOCATION, RANGE, REFERRER_POLICY,
    RETRY_AFTER, STRICT_TRANSPORT_SECURITY, WWW_AUTHENTICATE, X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{HeaderValue, Method, Response};
use tower::util::MapResponseLayer;
use tower_http::cors::{AllowOrigin, Any, CorsLayer};

use crate::http::origin::Origin;

/// How long a browser may remember whose pages may ask.
const REMEMBERED: Duration = Duration::from_hours(1);

/// What requests of other pages may carry.
const ALLOWED: [HeaderName; 11] = [
    ACCEPT,
    AUTHORIZATION,
    CONTENT_ENCODING,
    CONTENT_TYPE,
    IF_NONE_MATCH,
    RANGE,
    HeaderName::from_static("last-event-id"),
    HeaderName::from_static("prefer"),
    HeaderName::from_static("traceparent"),
    HeaderName::from_static("tracestate"),
    REQUEST_ID,
];

/// What other pages may read of an answer, beside what they always may.
const EXPOSED: [HeaderName; 9] = [
    CONTENT_DISPOSITION,
    CONTENT_LOCATION,
    CONTENT_RANGE,
    ETAG,
    LOCATION,
    RETRY_AFTER,
    WWW_AUTHENTICATE,
    HeaderName::from_static("preference-applied"),
    REQUEST_ID,
];

const REQUEST_ID: HeaderName = HeaderName::from_static("x-request-id");

/// Of what is no page: nothing is loaded, should a browser show it.
const NOTHING: &str = "default-src 'none'; frame-ancestors 'none'";

/// Of the viewer: its own files, and pictures that it draws.
pub(crate) const VIEWER: &str = "default-src 'none'; script-src 'self'; style-src 'self'; \
     img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Of Swagger UI, which writes styles into its page.
pub(crate) const DOCS: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; \
     img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// What a page of ours never asks for.
const DEVICES: &str = "accelerometer=(), bluetooth=(), camera=(), display-capture=(), geolocation=(), gyroscope=(), hid=(), \
     magnetometer=(), microphone=(), midi=(), payment=(), serial=(), usb=()";

const RESOURCE_POLICY: HeaderName = HeaderName::from_static("cross-origin-resource-policy");

const SAME_ORIGIN: &str = "same-origin";

const YEAR: &str = "max-age=31536000";

/// What the operator wants browsers to be told.
#[derive(Clone, Debug, Default)]
pub(crate) struct Browsers {
    origins: Vec<Origin>,
    secure: bool,
}

impl Browsers {
    /// As the settings have it.
    pub(crate) fn new(origins: &[Origin], secure: bool) -> Self {
        Self { origins: origins.to_vec(), secure }
    }

    /// Lets pages of these origins ask; nothing when there are none.
    pub(crate) fn cors(&self) -> Option<CorsLayer> {
        let origins = self.origins.iter().map(|origin| origin.0.clone());
        let any = self.origins.iter().any(Origin::is_any);
        let allowed = if any { AllowOrigin::from(Any) } else { AllowOrigin::list(origins) };
        let cors = CorsLayer::new()
            .allow_origin(allowed)
            .allow_methods([Method::GET, Method::HEAD, Method::POST, Method::DELETE])
            .allow_headers(ALLOWED)
            .expose_headers(EXPOSED)
            .max_age(REMEMBERED);
        (!self.origins.is_empty()).then_some(cors)
    }

    /// What every answer says; pages have said more already.
    pub(crate) fn protect<B>(&self) -> impl Fn(Response<B>) -> Response<B> + Clone + use<B> {
        let secure = self.secure;
        // A page that isolates itself loads only what allows it. The header cannot name origins.
        let loaded_by = if self.origins.is_empty() { SAME_ORIGIN } else { "cross-origin" };
        move |mut response| {
            let headers = response.headers_mut();
            headers.insert(X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
            headers.entry(RESOURCE_POLICY).or_insert(HeaderValue::from_static(loaded_by));
            headers.entry(CONTENT_SECURITY_POLICY).or_insert(HeaderValue::from_static(NOTHING));
            if secure {
                headers.insert(STRICT_TRANSPORT_SECURITY, HeaderValue::from_static(YEAR));
            }
            response
        }
    }
}

/// Routes of pages, which browsers are told how to treat.
pub(crate) fn pages<S: Clone + Send + Sync + 'static>(routes: Router<S>, policy: &'static str) -> Router<S> {
    let about = [
        (CONTENT_SECURITY_POLICY, policy),
        (REFERRER_POLICY, "no-referrer"),
        (HeaderName::from_static("permissions-policy"), DEVICES),
        (HeaderName::from_static("cross-origin-opener-policy"), SAME_ORIGIN),
        (RESOURCE_POLICY, SAME_ORIGIN),
    ];
    routes.layer(MapResponseLayer::new(move |mut response: axum::response::Response| {
        let about = about.clone().map(|(name, value)| (name, HeaderValue::from_static(value)));
        response.headers_mut().extend(about);
        response
    }))
}
