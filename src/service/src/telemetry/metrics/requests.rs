//! Metrics of requests: their number and duration, and how many are in progress.

use std::sync::Arc;
use std::time::Duration;

use axum::http::Method;
use prometheus_client::encoding::EncodeLabelSet;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::registry::{Registry, Unit};

/// Upper bounds of the histogram in seconds: from one pose to a request that waits for a job.
const BOUNDS: [f64; 16] =
    [0.000_25, 0.000_5, 0.001, 0.002_5, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0];

/// Counts the requests of a service.
pub(crate) struct RequestMetrics {
    answered: Family<Response, Counter>,
    seconds: Family<Request, Histogram, fn() -> Histogram>,
    in_progress: Gauge,
}

/// The labels of a request.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct Request {
    method: &'static str,
    route: String,
}

/// The labels of a response.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct Response {
    method: &'static str,
    route: String,
    status: u16,
}

/// A request in progress. If its client disconnects, the request has no response.
pub(crate) struct RequestInProgress {
    metrics: Arc<RequestMetrics>,
    request: Request,
}

impl Default for RequestMetrics {
    fn default() -> Self {
        let histogram: fn() -> Histogram = || Histogram::new(BOUNDS);
        let seconds = Family::new_with_constructor(histogram);
        Self { answered: Family::default(), seconds, in_progress: Gauge::default() }
    }
}

impl RequestMetrics {
    /// Adds the metrics to a registry.
    pub(crate) fn register(&self, registry: &mut Registry) {
        registry.register("http_requests", "Requests answered", self.answered.clone());
        let seconds = "Time from a request to the headers of its response";
        registry.register_with_unit("http_request", seconds, Unit::Seconds, self.seconds.clone());
        registry.register("http_requests_under_way", "Requests in progress", self.in_progress.clone());
    }

    /// Counts a request as in progress.
    pub(crate) fn begin(self: &Arc<Self>, method: &Method, route: String) -> RequestInProgress {
        self.in_progress.inc();
        RequestInProgress { metrics: Arc::clone(self), request: Request { method: label(method), route } }
    }
}

impl RequestInProgress {
    /// Counts the response.
    pub(crate) fn end(self, status: u16, latency: Duration) {
        let Request { method, route } = self.request.clone();
        self.metrics.answered.get_or_create(&Response { method, route, status }).inc();
        self.metrics.seconds.get_or_create(&self.request).observe(latency.as_secs_f64());
    }
}

impl Drop for RequestInProgress {
    fn drop(&mut self) {
        self.metrics.in_progress.dec();
    }
}

/// The label of a method. Clients may invent methods, and each label is a time series.
fn label(method: &Method) -> &'static str {
    match *method {
        Method::GET => "GET",
        Method::POST => "POST",
        Method::DELETE => "DELETE",
        Method::HEAD => "HEAD",
        Method::OPTIONS => "OPTIONS",
        _ => "other",
    }
}
