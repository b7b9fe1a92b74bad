//! Headers for browsers: CORS, and the security policy of the service's own pages.

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

/// How long a browser may cache a preflight response.
const PREFLIGHT_AGE: Duration = Duration::from_hours(1);

/// Request headers that pages of other origins may send.
const ALLOWED_HEADERS: [HeaderName; 11] = [
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

/// Response headers that pages of other origins may read, in addition to the safelisted ones.
const EXPOSED_HEADERS: [HeaderName; 9] = [
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

/// Content-Security-Policy of responses that are not pages: a browser that displays one loads nothing.
const NO_PAGE: &str = "default-src 'none'; frame-ancestors 'none'";

/// Content-Security-Policy of the viewer: its own files, and images that it draws.
pub(crate) const VIEWER: &str = "default-src 'none'; script-src 'self'; style-src 'self'; \
     img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Content-Security-Policy of Swagger UI, which writes styles into its page.
pub(crate) const DOCS: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; \
     img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Content-Security-Policy of the guide, which colours code by styles, and frames its own list of chapters where no
/// script runs.
pub(crate) const GUIDE: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; \
     img-src 'self' data:; connect-src 'self'; frame-src 'self'; base-uri 'none'; form-action 'none'; \
     frame-ancestors 'self'";

/// Permissions-Policy of the pages: they use none of these devices.
const PERMISSIONS: &str = "accelerometer=(), bluetooth=(), camera=(), display-capture=(), geolocation=(), \
     gyroscope=(), hid=(), magnetometer=(), microphone=(), midi=(), payment=(), serial=(), usb=()";

const RESOURCE_POLICY: HeaderName = HeaderName::from_static("cross-origin-resource-policy");

const SAME_ORIGIN: &str = "same-origin";

/// A year, in seconds.
const HSTS: &str = "max-age=31536000";

/// The settings on which the headers depend.
#[derive(Clone, Debug, Default)]
pub(crate) struct BrowserPolicy {
    /// The origins whose pages may send requests and read responses.
    origins: Vec<Origin>,
    /// Whether the service has a certificate.
    is_https: bool,
}

impl BrowserPolicy {
    /// The policy for these settings.
    pub(crate) fn new(origins: &[Origin], is_https: bool) -> Self {
        Self { origins: origins.to_vec(), is_https }
    }

    /// The CORS layer; `None` without origins.
    pub(crate) fn cors(&self) -> Option<CorsLayer> {
        let origins = self.origins.iter().map(|origin| origin.0.clone());
        let any = self.origins.iter().any(Origin::is_any);
        let allowed = if any { AllowOrigin::from(Any) } else { AllowOrigin::list(origins) };
        let cors = CorsLayer::new()
            .allow_origin(allowed)
            .allow_methods([Method::GET, Method::HEAD, Method::POST, Method::DELETE])
            .allow_headers(ALLOWED_HEADERS)
            .expose_headers(EXPOSED_HEADERS)
            .max_age(PREFLIGHT_AGE);
        (!self.origins.is_empty()).then_some(cors)
    }

    /// Adds the headers of every response. Pages have set stricter ones already.
    pub(crate) fn add_headers<B>(&self) -> impl Fn(Response<B>) -> Response<B> + Clone + use<B> {
        let is_https = self.is_https;
        // Pages that are isolated load only resources with this header. It cannot name origins.
        let resource_policy = if self.origins.is_empty() { SAME_ORIGIN } else { "cross-origin" };
        move |mut response| {
            let headers = response.headers_mut();
            headers.insert(X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff"));
            headers.entry(RESOURCE_POLICY).or_insert(HeaderValue::from_static(resource_policy));
            headers.entry(CONTENT_SECURITY_POLICY).or_insert(HeaderValue::from_static(NO_PAGE));
            if is_https {
                headers.insert(STRICT_TRANSPORT_SECURITY, HeaderValue::from_static(HSTS));
            }
            response
        }
    }
}

/// The routes of pages with their Content-Security-Policy and the other headers of pages.
pub(crate) fn pages<S: Clone + Send + Sync + 'static>(routes: Router<S>, policy: &'static str) -> Router<S> {
    let headers = [
        (CONTENT_SECURITY_POLICY, policy),
        (REFERRER_POLICY, "no-referrer"),
        (HeaderName::from_static("permissions-policy"), PERMISSIONS),
        (HeaderName::from_static("cross-origin-opener-policy"), SAME_ORIGIN),
        (RESOURCE_POLICY, SAME_ORIGIN),
    ];
    routes.layer(MapResponseLayer::new(move |mut response: axum::response::Response| {
        let headers = headers.clone().map(|(name, value)| (name, HeaderValue::from_static(value)));
        response.headers_mut().extend(headers);
        response
    }))
}
