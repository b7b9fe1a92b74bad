//! Opens the result store and the job queue.
//!
//! - This module opens those of one process.
//! - `shared` opens those of a service with many processes: a broker and a shared store.

pub(crate) mod error;
pub(crate) mod shared;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tokio::runtime::Handle;
use verne_jobs::{Backend, Embedded, embedded};
use verne_store::Store;

use crate::operations::job_executor::JobExecutor;
use crate::operations::results::Results;
use crate::process::config::ServeConfig;
use crate::process::storage::error::StorageError;
use crate::process::storage::shared::{MAX_ATTEMPTS, open_store};
use crate::telemetry::metrics::computations::ComputationMetrics;

/// Results and jobs.
pub(crate) struct Storage {
    /// The results.
    pub results: Results,
    /// The job queue.
    pub jobs: Arc<dyn Backend>,
    /// The job queue, if this process runs the jobs.
    pub embedded: Option<Arc<Embedded>>,
    /// Counts the computations of this process.
    pub computations: ComputationMetrics,
}

impl Storage {
    /// Opens them as the settings say. A directory in the settings must be usable. If the default directory is not,
    /// jobs and results are in memory, and the log warns.
    pub(crate) async fn open(config: &ServeConfig) -> Result<Self, StorageError> {
        if config.broker.broker.is_some() {
            let opened = shared::open(&config.broker, &config.store, config.cache_bytes, config.queue);
            let (results, jobs) = opened.await?;
            return Ok(Self { results, jobs, embedded: None, computations: ComputationMetrics::default() });
        }
        // Before any directory: memory does not replace a store in the settings.
        let store = open_store(&config.store, config.cache_bytes).await?;
        if config.memory_only {
            if let Some(directory) = &config.data {
                tracing::warn!(data = %directory.display(), "the data directory is not used: memory_only is set");
            }
            return Self::open_in(config, None, store).await;
        }
        if let Some(directory) = &config.data {
            return Self::open_in(config, Some(directory), store).await;
        }
        let Some(directory) = dirs::data_dir().map(|data| data.join("verne")) else {
            tracing::warn!("found no data directory: jobs and results are lost when this process ends");
            return Self::open_in(config, None, store).await;
        };
        match Self::open_in(config, Some(&directory), store.clone()).await {
            Err(error) => {
                tracing::warn!(
                    %error,
                    "cannot use the default data directory: jobs and results are lost when this process ends; set \
                     --data to another directory"
                );
                Self::open_in(config, None, store).await
            }
            opened => opened,
        }
    }

    /// Opens the jobs in `directory`, or in memory; the results are in `store`, or beside the jobs.
    async fn open_in(
        config: &ServeConfig,
        directory: Option<&Path>,
        store: Option<Results>,
    ) -> Result<Self, StorageError> {
        let below = |name| directory.map(|directory| directory.join(name));
        let results = if let Some(results) = store {
            results
        } else {
            let store = verne_store::Config {
                directory: below("results"),
                memory_bytes: config.cache_bytes,
                disk_bytes: config.disk_bytes,
            };
            Results::new(Store::open(&store).await.map_err(StorageError::Results)?)
        };
        let computations = ComputationMetrics::default();
        let tasks = JobExecutor::new(results.clone(), computations.clone(), Handle::current());
        let jobs = Arc::new(open_jobs(config, below("jobs"), tasks).await?);
        if let Some(damaged) = jobs.damaged_database() {
            tracing::error!(
                path = %damaged.display(),
                "the job records were damaged: moved them aside and started new ones"
            );
        }
        if let Some(directory) = directory {
            tracing::info!(
                "jobs, and results without a store of their own, are stored in {}",
                directory.display()
            );
        }
        let embedded = Some(Arc::clone(&jobs));
        Ok(Self { results, jobs, embedded, computations })
    }
}

async fn open_jobs(
    config: &ServeConfig,
    directory: Option<PathBuf>,
    tasks: JobExecutor,
) -> Result<Embedded, StorageError> {
    let jobs = embedded::Config {
        directory,
        threads: config.job_cores(),
        queue: config.queue,
        max_attempts: MAX_ATTEMPTS,
        ..embedded::Config::default()
    };
    let opened = tokio::task::spawn_blocking(move || Embedded::open(jobs, Arc::new(tasks)));
    opened.await.map_err(|_| StorageError::Lost)?.map_err(StorageError::Jobs)
}
