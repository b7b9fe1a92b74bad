//! What every handler shares.

use std::sync::Arc;
use std::time::Duration;

use moka::future::Cache;
use tokio_util::sync::CancellationToken;
use verne_jobs::{Backend, JobId};

use crate::http::proxy::BasePath;
use crate::http::readiness::Readiness;
use crate::http::static_content::Fixed;
use crate::limits::admission::Admission;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::results::Results;
use crate::telemetry::metrics::Metrics;

/// The largest requests that are answered, and the longest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RequestLimits {
    /// Bytes in a batch's body.
    pub body_bytes: usize,
    /// Rows in a batch.
    pub rows: usize,
    /// Triangles of a mesh.
    pub triangles: u64,
    /// How long an answer is waited for unless the request says so.
    pub wait: Duration,
    /// How long it may at most.
    pub longest_wait: Duration,
    /// How long a job may take, queue included.
    pub job: Duration,
}

/// Most questions whose estimated work is remembered.
pub(crate) const ESTIMATES: u64 = 10_000;

/// Shared state.
pub(crate) struct State {
    /// The published machines.
    pub machines: MachineRegistry,
    /// The largest requests that are answered.
    pub limits: RequestLimits,
    /// How much is worked on at once.
    pub admission: Arc<Admission>,
    /// What has been answered.
    pub results: Results,
    /// What is being computed.
    pub jobs: Arc<dyn Backend>,
    /// The estimated work of the questions that were asked last, seconds of one core.
    pub costs: Cache<JobId, f64>,
    /// Whether all of it works.
    pub readiness: Readiness,
    /// What is measured.
    pub metrics: Metrics,
    /// The path under which the service is published.
    pub base: BasePath,
    /// The OpenAPI document.
    pub document: Fixed,
    /// Cancelled when the service is told to stop.
    pub stopping: CancellationToken,
}

/// A handle on the state.
pub(crate) type Shared = Arc<State>;
