//! Whether the service is ready: it accepts jobs and stores results.

use std::sync::Arc;

use axum::Json;
use tokio_util::sync::CancellationToken;
use verne_jobs::Backend;

use crate::http::error::{HttpError, JobError};
use crate::operations::results::Results;
use crate::wire::health::{Health, HealthStatus, SharedPart};

/// The state behind `/readyz`.
pub(crate) struct Readiness {
    results: Results,
    jobs: Arc<dyn Backend>,
    stopping: CancellationToken,
}

impl Readiness {
    /// Checks these parts of the service.
    pub(crate) fn new(results: Results, jobs: Arc<dyn Backend>, stopping: CancellationToken) -> Self {
        Self { results, jobs, stopping }
    }

    /// Returns the health, or the reason why the service is not ready. If a part fails that all processes share, the
    /// service reports it and stays ready: otherwise all processes would reject all requests, even those that do not
    /// need the part.
    pub(crate) async fn check(&self) -> Result<Json<Health>, HttpError> {
        if self.stopping.is_cancelled() {
            return Err(JobError::Stopping.into());
        }
        let mut failing = Vec::new();
        if let Err(error) = self.results.healthy().await {
            if !self.results.are_shared() {
                return Err(error.into());
            }
            failing.push(SharedPart::Store);
        }
        if let Err(unavailable) = self.jobs.reachable().await {
            if !self.jobs.is_shared() {
                return Err(unavailable.into());
            }
            tracing::error!(%unavailable, "cannot reach the job records");
            failing.push(SharedPart::Broker);
        }
        let status = if failing.is_empty() { HealthStatus::Ok } else { HealthStatus::Degraded };
        Ok(Json(Health { status, failing }))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use std::sync::Arc;
    use std::time::Duration;

    use async_trait::async_trait;
    use serde_json::json;
    use tokio_util::sync::CancellationToken;
    use verne_jobs::{
        Backend, Claim, Counts, Filter, Job, JobId, Page, Submission, SubmitError, UnavailableError, Watcher,
    };
    use verne_store::Store;

    use super::Readiness;
    use crate::http::error::{HttpError, JobError};
    use crate::operations::results::Results;

    /// Job records that cannot be read or written.
    struct UnavailableJobs {
        shared: bool,
    }

    fn unavailable<T>() -> Result<T, UnavailableError> {
        Err(UnavailableError("the disk is full".to_owned()))
    }

    #[async_trait]
    impl Backend for UnavailableJobs {
        async fn submit(&self, _: Submission) -> Result<Claim, SubmitError> {
            Ok(unavailable()?)
        }
        async fn get(&self, _: JobId) -> Result<Option<Job>, UnavailableError> {
            unavailable()
        }
        async fn list(&self, _: Filter) -> Result<Page, UnavailableError> {
            unavailable()
        }
        async fn watch(&self, _: JobId) -> Result<Option<Watcher>, UnavailableError> {
            unavailable()
        }
        async fn cancel(&self, _: JobId) -> Result<Option<Job>, UnavailableError> {
            unavailable()
        }
        async fn leave(&self, _: JobId, _: &str) -> Result<Option<Job>, UnavailableError> {
            unavailable()
        }
        async fn reachable(&self) -> Result<(), UnavailableError> {
            unavailable()
        }
        fn is_shared(&self) -> bool {
            self.shared
        }
        fn counts(&self) -> Counts {
            Counts::default()
        }
        async fn drain(&self, _: Duration) {}
    }

    fn readiness(shared: bool) -> Readiness {
        let results = Results::new(Store::in_memory(1));
        Readiness::new(results, Arc::new(UnavailableJobs { shared }), CancellationToken::new())
    }

    #[tokio::test]
    async fn a_process_that_cannot_record_its_jobs_is_not_ready() {
        let error = readiness(false).check().await.map(drop).unwrap_err();
        assert!(matches!(error, HttpError::Job(JobError::RecordsUnavailable(_))), "{error:?}");
        let health = readiness(true).check().await.unwrap();
        assert_eq!(json!(*health), json!({"status": "degraded", "failing": ["broker"]}));
    }
}
