//! Whether the service can do what it is for.

use std::sync::Arc;

use axum::Json;
use tokio_util::sync::CancellationToken;
use verne_jobs::Backend;

use crate::error::Error;
use crate::results::Results;
use crate::wire::catalogue::{Health, Part, Status};

/// Asked by `/readyz`.
pub(crate) struct Readiness {
    results: Results,
    jobs: Arc<dyn Backend>,
    stopping: CancellationToken,
}

impl Readiness {
    /// Of these parts of the service.
    pub(crate) fn new(results: Results, jobs: Arc<dyn Backend>, stopping: CancellationToken) -> Self {
        Self { results, jobs, stopping }
    }

    /// Ready, or why not. What all processes share is told of and no reason to turn requests away: they would be turned
    /// away everywhere at once, those too that need none of it.
    pub(crate) async fn told(&self) -> Result<Json<Health>, Error> {
        if self.stopping.is_cancelled() {
            return Err(Error::Stopping);
        }
        let mut failing = Vec::new();
        if let Err(error) = self.results.healthy().await {
            if !self.results.are_shared() {
                return Err(error);
            }
            failing.push(Part::Store);
        }
        if let Err(unavailable) = self.jobs.reachable() {
            tracing::error!(%unavailable, "jobs");
            failing.push(Part::Broker);
        }
        let status = if failing.is_empty() { Status::Ok } else { Status::Degraded };
        Ok(Json(Health { status, failing }))
    }
}
