//! The state that all handlers share.

use std::sync::Arc;
use std::time::Duration;

use moka::future::Cache;
use tokio_util::sync::CancellationToken;
use verne_jobs::{Backend, JobId};

use crate::http::openapi::versions::Documents;
use crate::http::proxy::BasePath;
use crate::http::readiness::Readiness;
use crate::limits::admission::Admission;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::results::Results;
use crate::telemetry::metrics::Metrics;

/// Limits of the size and the time of requests.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RequestLimits {
    /// Most bytes in the body of a batch.
    pub body_bytes: usize,
    /// Most bytes of a program.
    pub program_bytes: usize,
    /// Most rows in a batch.
    pub rows: usize,
    /// Most triangles of a mesh.
    pub triangles: u64,
    /// How long a request waits for a job by default.
    pub wait: Duration,
    /// How long a request may wait for a job.
    pub longest_wait: Duration,
    /// How long a job may take, including its time in the queue.
    pub job: Duration,
}

/// Most questions whose estimated work is cached.
pub(crate) const ESTIMATES: u64 = 10_000;

/// The state.
pub(crate) struct AppState {
    /// The published machines.
    pub machines: MachineRegistry,
    /// Limits of requests.
    pub limits: RequestLimits,
    /// Limits the requests, bodies and responses at once.
    pub admission: Arc<Admission>,
    /// The stored results.
    pub results: Results,
    /// The jobs.
    pub jobs: Arc<dyn Backend>,
    /// The estimated work of recent questions, seconds of one core. An estimate takes milliseconds.
    pub costs: Cache<JobId, f64>,
    /// Whether the service is ready.
    pub readiness: Readiness,
    /// The metrics.
    pub metrics: Metrics,
    /// The path under which the service is published.
    pub base: BasePath,
    /// The OpenAPI document.
    pub documents: Documents,
    /// Cancelled when the service stops.
    pub stopping: CancellationToken,
}

/// The state, shared.
pub(crate) type SharedState = Arc<AppState>;
