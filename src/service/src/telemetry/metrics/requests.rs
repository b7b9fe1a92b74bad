//! Requests: how many, how long, and how many at this moment.

use std::sync::Arc;
use std::time::Duration;

use axum::http::Method;
use prometheus_client::encoding::EncodeLabelSet;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::registry::{Registry, Unit};

/// Upper bounds of the histogram, seconds: from a question to what may wait for a job.
const BOUNDS: [f64; 16] =
    [0.000_25, 0.000_5, 0.001, 0.002_5, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0];

/// Counts the requests of a service.
pub(crate) struct Requests {
    answered: Family<Answered, Counter>,
    seconds: Family<Asked, Histogram, fn() -> Histogram>,
    under_way: Gauge,
}

/// What was asked.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct Asked {
    method: &'static str,
    route: String,
}

/// What was answered.
#[derive(Clone, Debug, PartialEq, Eq, Hash, EncodeLabelSet)]
struct Answered {
    method: &'static str,
    route: String,
    status: u16,
}

/// A request that has no answer yet; it may never have one, if its client leaves.
pub(crate) struct Answering {
    requests: Arc<Requests>,
    asked: Asked,
}

impl Requests {
    /// Counts, told of in a registry.
    pub(crate) fn registered(registry: &mut Registry) -> Arc<Self> {
        let histogram: fn() -> Histogram = || Histogram::new(BOUNDS);
        let seconds = Family::new_with_constructor(histogram);
        let requests = Self { answered: Family::default(), seconds, under_way: Gauge::default() };
        registry.register("http_requests", "Requests answered", requests.answered.clone());
        let seconds = "Time from a request to the headers of its response";
        registry.register_with_unit("http_request", seconds, Unit::Seconds, requests.seconds.clone());
        let under_way = "Requests in progress";
        registry.register("http_requests_under_way", under_way, requests.under_way.clone());
        Arc::new(requests)
    }

    /// A request has come.
    pub(crate) fn begin(self: &Arc<Self>, method: &Method, route: String) -> Answering {
        self.under_way.inc();
        Answering { requests: Arc::clone(self), asked: Asked { method: known(method), route } }
    }
}

impl Answering {
    /// It was answered so, after so long.
    pub(crate) fn end(self, status: u16, latency: Duration) {
        let Asked { method, route } = self.asked.clone();
        self.requests.answered.get_or_create(&Answered { method, route, status }).inc();
        self.requests.seconds.get_or_create(&self.asked).observe(latency.as_secs_f64());
    }
}

impl Drop for Answering {
    fn drop(&mut self) {
        self.requests.under_way.dec();
    }
}

/// A client may invent methods; each would be a series of its own.
fn known(method: &Method) -> &'static str {
    match *method {
        Method::GET => "GET",
        Method::POST => "POST",
        Method::DELETE => "DELETE",
        Method::HEAD => "HEAD",
        Method::OPTIONS => "OPTIONS",
        _ => "other",
    }
}
