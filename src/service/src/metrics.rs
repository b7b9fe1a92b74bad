//! What is measured, in the text format of Prometheus (OpenMetrics).

use std::fmt;
use std::sync::Arc;

use prometheus_client::collector::Collector;
use prometheus_client::encoding::{DescriptorEncoder, EncodeMetric};
use prometheus_client::metrics::counter::{ConstCounter, Counter};
use prometheus_client::metrics::gauge::ConstGauge;
use prometheus_client::registry::Registry;
use verne_jobs::Backend;
use verne_store::Store;

/// Media type of the text.
pub(crate) const OPEN_METRICS: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// Every metric of the service. A registry of its own and not one of the process: tests have several services.
pub(crate) struct Metrics(Registry);

impl Metrics {
    /// What jobs and results say of themselves whenever they are asked.
    pub(crate) fn of(jobs: Arc<dyn Backend>, store: Store, computed: Counter) -> Self {
        let mut registry = Registry::with_prefix("verne");
        registry.register("computations", "Workspaces and pieces of maps computed", computed);
        registry.register_collector(Box::new(Jobs(jobs)));
        registry.register_collector(Box::new(Results(store)));
        Self(registry)
    }

    /// The text.
    pub(crate) fn text(&self) -> Result<String, fmt::Error> {
        let mut text = String::new();
        prometheus_client::encoding::text::encode(&mut text, &self.0)?;
        Ok(text)
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
        gauge(&mut encoder, "jobs_queued", "Jobs that wait for their turn", number(counts.queued))?;
        gauge(&mut encoder, "jobs_running", "Jobs that are being computed", number(counts.running))?;
        counter(&mut encoder, "jobs_started", "Runs of jobs and of their parts", counts.started)?;
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
        gauge(&mut encoder, "results_disk_bytes", "Bytes of results on disk", number(stats.disk_bytes))?;
        counter(&mut encoder, "results_memory_hits", "Results found in memory", stats.memory_hits)?;
        counter(&mut encoder, "results_disk_hits", "Results found on disk", stats.disk_hits)?;
        counter(&mut encoder, "results_misses", "Results not found", stats.misses)?;
        counter(&mut encoder, "results_evictions", "Results that made room on disk", stats.evictions)?;
        counter(&mut encoder, "results_damaged", "Results found damaged on disk", stats.damaged)?;
        counter(&mut encoder, "results_read_failures", "Reads that the disk refused", stats.read_failures)?;
        counter(&mut encoder, "results_write_failures", "Writes that the disk refused", stats.write_failures)
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
