//! Metrics of the job queue, the result store and the job slots.

use std::fmt;

use prometheus_client::encoding::DescriptorEncoder;
use verne_jobs::jetstream::Occupancy;
use verne_jobs::{Counts, Slots};
use verne_store::Stats;

use crate::telemetry::metrics::encoding::{counter, gauge};

/// The job queue.
pub(crate) fn encode_jobs(encoder: &mut DescriptorEncoder<'_>, jobs: Counts) -> fmt::Result {
    gauge(encoder, "jobs_queued", "Jobs in the queue", jobs.queued)?;
    gauge(encoder, "jobs_running", "Jobs that are running", jobs.running)?;
    counter(encoder, "jobs_started", "Runs of jobs and of their subtasks", jobs.started)?;
    counter(encoder, "jobs_succeeded", "Jobs that have a result", jobs.succeeded)?;
    counter(encoder, "jobs_failed", "Jobs that failed", jobs.failed)?;
    counter(encoder, "jobs_cancelled", "Jobs that were cancelled", jobs.cancelled)
}

/// The result store.
pub(crate) fn encode_results(encoder: &mut DescriptorEncoder<'_>, results: &Stats) -> fmt::Result {
    gauge(encoder, "results_memory_bytes", "Bytes of results in memory", results.memory_bytes)?;
    // The size of a shared store is unknown.
    if let Some(bytes) = results.disk_bytes {
        gauge(encoder, "results_disk_bytes", "Bytes of results on disk", bytes)?;
    }
    counter(encoder, "results_memory_hits", "Results found in memory", results.memory_hits)?;
    counter(encoder, "results_disk_hits", "Results found on disk", results.disk_hits)?;
    counter(encoder, "results_misses", "Results not found", results.misses)?;
    counter(encoder, "results_evictions", "Results evicted from disk", results.evictions)?;
    counter(encoder, "results_damaged", "Results found damaged on disk", results.damaged)?;
    counter(encoder, "results_read_failures", "Failed reads from disk", results.read_failures)?;
    counter(encoder, "results_write_failures", "Failed writes to disk", results.write_failures)
}

/// The job slots of a process.
pub(crate) fn encode_slots(encoder: &mut DescriptorEncoder<'_>, slots: Slots) -> fmt::Result {
    gauge(encoder, "worker_seats", "Job slots of this process", slots.total)?;
    gauge(encoder, "worker_seats_busy", "Job slots in use", slots.busy)
}

/// A worker.
pub(crate) fn encode_worker(encoder: &mut DescriptorEncoder<'_>, worker: Occupancy) -> fmt::Result {
    encode_slots(encoder, worker.slots)?;
    let redelivered = "Jobs redelivered after the loss of a worker";
    counter(encoder, "worker_redeliveries", redelivered, worker.redelivered)?;
    let handed_back = "Jobs that this worker returned to the queue";
    counter(encoder, "worker_handed_back", handed_back, worker.handed_back)
}
