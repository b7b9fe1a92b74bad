//! What is measured, in the text format of Prometheus (OpenMetrics).

pub(crate) mod bounds;
pub(crate) mod computations;
pub(crate) mod connections;
pub(crate) mod requests;
pub(crate) mod seats;

use std::fmt;
use std::sync::Arc;

use axum::http::header::CONTENT_TYPE;
use axum::response::IntoResponse;
use prometheus_client::collector::Collector;
use prometheus_client::encoding::{DescriptorEncoder, EncodeMetric};
use prometheus_client::metrics::counter::ConstCounter;
use prometheus_client::metrics::gauge::ConstGauge;
use prometheus_client::registry::Registry;
use verne_jobs::jetstream::Occupancy;
use verne_jobs::{Backend, Slots};
use verne_store::Store;

use crate::limits::admission::Admission;
use crate::telemetry::metrics::bounds::Bounds;
use crate::telemetry::metrics::seats::{Here, OfWorker};
use crate::wire::error::OperationError;

use crate::telemetry::metrics::computations::Computations;
use crate::telemetry::metrics::connections::Connections;
use crate::telemetry::metrics::requests::Requests;

/// Media type of the text.
const OPEN_METRICS: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// Every metric of the service. A registry of its own and not one of the process: tests have several services.
pub(crate) struct Metrics {
    registry: Registry,
    /// To be told of requests.
    pub requests: Arc<Requests>,
    /// To be told of connections.
    pub connections: Connections,
}

impl Metrics {
    /// What jobs and results say of themselves whenever they are asked.
    pub(crate) fn of(jobs: Arc<dyn Backend>, store: Store, computations: &Computations) -> Self {
        let mut registry = Registry::with_prefix("verne");
        let requests = Requests::registered(&mut registry);
        let connections = Connections::default();
        connections.register(&mut registry);
        computations.register(&mut registry);
        registry.register_collector(Box::new(Jobs(jobs)));
        registry.register_collector(Box::new(Results(store)));
        Self { registry, requests, connections }
    }

    /// And how much is taken of what is bounded.
    pub(crate) fn tell_of_admission(&mut self, admission: Arc<Admission>) {
        self.registry.register_collector(Box::new(Bounds(admission)));
    }

    /// And how busy are those who run jobs in this process.
    pub(crate) fn tell_of_seats(&mut self, seats: impl Fn() -> Slots + Send + Sync + 'static) {
        self.registry.register_collector(Box::new(Here(Box::new(seats))));
    }

    /// And what a worker says of itself.
    pub(crate) fn tell_of_worker(&mut self, occupancy: impl Fn() -> Occupancy + Send + Sync + 'static) {
        self.registry.register_collector(Box::new(OfWorker(Box::new(occupancy))));
    }

    /// The text.
    pub(crate) fn answer(&self) -> Result<impl IntoResponse + use<>, OperationError> {
        let mut text = String::new();
        prometheus_client::encoding::text::encode(&mut text, &self.registry)
            .map_err(|_| OperationError::Internal)?;
        Ok(([(CONTENT_TYPE, OPEN_METRICS)], text))
    }
}

struct Jobs(Arc<dyn Backend>);

impl fmt::Debug for Jobs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Jobs")
    }
}

impl Collector for Jobs {
    fn encode(&self, mut encoder: DescriptorEncoder<'_>) -> fmt::Result {
        let counts = self.0.counts();
        gauge(&mut encoder, "jobs_queued", "Jobs in the queue", number(counts.queued))?;
        gauge(&mut encoder, "jobs_running", "Jobs that are running", number(counts.running))?;
        counter(&mut encoder, "jobs_started", "Runs of jobs and of their subtasks", counts.started)?;
        counter(&mut encoder, "jobs_succeeded", "Jobs that have a result", counts.succeeded)?;
        counter(&mut encoder, "jobs_failed", "Jobs that failed", counts.failed)?;
        counter(&mut encoder, "jobs_cancelled", "Jobs that were cancelled", counts.cancelled)
    }
}

struct Results(Store);

impl fmt::Debug for Results {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Results")
    }
}

impl Collector for Results {
    fn encode(&self, mut encoder: DescriptorEncoder<'_>) -> fmt::Result {
        let stats = self.0.stats();
        gauge(
            &mut encoder,
            "results_memory_bytes",
            "Bytes of results in memory",
            number(stats.memory_bytes),
        )?;
        // Of a shared store nobody knows.
        if let Some(bytes) = stats.disk_bytes {
            gauge(&mut encoder, "results_disk_bytes", "Bytes of results on disk", number(bytes))?;
        }
        counter(&mut encoder, "results_memory_hits", "Results found in memory", stats.memory_hits)?;
        counter(&mut encoder, "results_disk_hits", "Results found on disk", stats.disk_hits)?;
        counter(&mut encoder, "results_misses", "Results not found", stats.misses)?;
        counter(&mut encoder, "results_evictions", "Results evicted from disk", stats.evictions)?;
        counter(&mut encoder, "results_damaged", "Results found damaged on disk", stats.damaged)?;
        counter(&mut encoder, "results_read_failures", "Failed reads from disk", stats.read_failures)?;
        counter(&mut encoder, "results_write_failures", "Failed writes to disk", stats.write_failures)
    }
}

fn number(count: impl TryInto<i64>) -> i64 {
    count.try_into().unwrap_or(i64::MAX)
}

fn gauge(encoder: &mut DescriptorEncoder<'_>, name: &str, help: &str, value: i64) -> fmt::Result {
    use prometheus_client::metrics::TypedMetric;
    let metric = ConstGauge::new(value);
    metric.encode(encoder.encode_descriptor(name, help, None, ConstGauge::<i64>::TYPE)?)
}

fn counter(encoder: &mut DescriptorEncoder<'_>, name: &str, help: &str, value: u64) -> fmt::Result {
    use prometheus_client::metrics::TypedMetric;
    let metric = ConstCounter::new(value);
    metric.encode(encoder.encode_descriptor(name, help, None, ConstCounter::<u64>::TYPE)?)
}
