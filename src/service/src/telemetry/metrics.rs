//! The metrics of the service in the text format of Prometheus (OpenMetrics).
//!
//! `requests`, `connections` and `computations` count events. `sampled` and `limits` read values from other modules
//! when the metrics are requested.

pub(crate) mod computations;
pub(crate) mod connections;
pub(crate) mod encoding;
pub(crate) mod limits;
pub(crate) mod requests;
pub(crate) mod sampled;

use std::fmt;
use std::sync::Arc;

use axum::http::header::CONTENT_TYPE;
use axum::response::IntoResponse;
use prometheus_client::encoding::DescriptorEncoder;
use prometheus_client::registry::Registry;
use verne_jobs::jetstream::Occupancy;
use verne_jobs::{Backend, Slots};
use verne_store::Store;

use crate::limits::admission::Admission;
use crate::telemetry::metrics::computations::ComputationMetrics;
use crate::telemetry::metrics::connections::ConnectionMetrics;
use crate::telemetry::metrics::encoding::Sampled;
use crate::telemetry::metrics::limits::encode_limits;
use crate::telemetry::metrics::requests::RequestMetrics;
use crate::telemetry::metrics::sampled::{encode_jobs, encode_results, encode_slots, encode_worker};
use crate::wire::error::OperationError;

/// Media type of the text.
const OPEN_METRICS: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// The metrics of one service. Tests run several services in one process, so the registry is not global.
pub(crate) struct Metrics {
    registry: Registry,
    /// Counts requests.
    pub requests: Arc<RequestMetrics>,
    /// Counts connections.
    pub connections: ConnectionMetrics,
}

impl Metrics {
    /// The metrics that every process has.
    pub(crate) fn new(jobs: Arc<dyn Backend>, store: Store, computations: &ComputationMetrics) -> Self {
        let mut registry = Registry::with_prefix("verne");
        let (requests, connections) = (Arc::<RequestMetrics>::default(), ConnectionMetrics::default());
        requests.register(&mut registry);
        connections.register(&mut registry);
        computations.register(&mut registry);
        let mut metrics = Self { registry, requests, connections };
        metrics.register(move |encoder| encode_jobs(encoder, jobs.counts()));
        metrics.register(move |encoder| encode_results(encoder, &store.stats()));
        metrics
    }

    /// Adds the use of the limits.
    pub(crate) fn register_limits(&mut self, admission: Arc<Admission>) {
        self.register(move |encoder| encode_limits(encoder, &admission));
    }

    /// Adds the job slots of a process that runs its own jobs.
    pub(crate) fn register_slots(&mut self, slots: impl Fn() -> Slots + Send + Sync + 'static) {
        self.register(move |encoder| encode_slots(encoder, slots()));
    }

    /// Adds the metrics of a worker.
    pub(crate) fn register_worker(&mut self, occupancy: impl Fn() -> Occupancy + Send + Sync + 'static) {
        self.register(move |encoder| encode_worker(encoder, occupancy()));
    }

    /// The text of all metrics.
    pub(crate) fn answer(&self) -> Result<impl IntoResponse + use<>, OperationError> {
        let mut text = String::new();
        prometheus_client::encoding::text::encode(&mut text, &self.registry)
            .map_err(|_| OperationError::Internal)?;
        Ok(([(CONTENT_TYPE, OPEN_METRICS)], text))
    }

    fn register(
        &mut self,
        encode: impl Fn(&mut DescriptorEncoder<'_>) -> fmt::Result + Send + Sync + 'static,
    ) {
        self.registry.register_collector(Box::new(Sampled(encode)));
    }
}
