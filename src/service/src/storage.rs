//! Opens what outlives requests: the results and the queue of jobs.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use prometheus_client::metrics::counter::Counter;
use tokio::runtime::Handle;
use verne_jobs::{Backend, Embedded, embedded};
use verne_store::Store;

use crate::config::ServeConfig;
use crate::results::Results;
use crate::tasks::Tasks;

/// A job that was running when the process died so often is likely the cause.
const ATTEMPTS: u32 = 10;

/// Why a directory cannot hold jobs and results.
#[derive(Debug)]
pub enum StorageError {
    /// The results.
    Results(verne_store::OpenError),
    /// The jobs.
    Jobs(embedded::OpenError),
    /// The thread that opened them was lost.
    Lost,
}

impl fmt::Display for StorageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Results(error) => error.fmt(f),
            Self::Jobs(error) => write!(f, "jobs cannot be kept: {error}"),
            Self::Lost => write!(f, "jobs cannot be kept: opening them failed"),
        }
    }
}

impl std::error::Error for StorageError {}

/// Results and jobs.
pub(crate) struct Storage {
    /// What has been answered.
    pub results: Results,
    /// What is being computed.
    pub jobs: Arc<dyn Backend>,
    /// How much was computed.
    pub computed: Counter,
}

impl Storage {
    /// Opens them where the settings say. A directory that was asked for must be usable; where it was not, memory will
    /// do, loudly.
    pub(crate) async fn open(config: &ServeConfig) -> Result<Self, StorageError> {
        if config.memory_only {
            if let Some(directory) = &config.data {
                tracing::warn!(data = %directory.display(), "not used: memory_only is set");
            }
            return Self::open_in(config, None).await;
        }
        if let Some(directory) = &config.data {
            return Self::open_in(config, Some(directory)).await;
        }
        let Some(directory) = dirs::data_dir().map(|data| data.join("verne")) else {
            tracing::warn!("there is no directory for data: jobs and results end with this process");
            return Self::open_in(config, None).await;
        };
        match Self::open_in(config, Some(&directory)).await {
            Err(error) => {
                tracing::warn!(%error, "jobs and results end with this process; --data names another directory");
                Self::open_in(config, None).await
            }
            opened => opened,
        }
    }

    async fn open_in(config: &ServeConfig, directory: Option<&Path>) -> Result<Self, StorageError> {
        let below = |name| directory.map(|directory| directory.join(name));
        let kept = verne_store::Config {
            directory: below("results"),
            memory_bytes: config.cache_bytes,
            disk_bytes: config.disk_bytes,
        };
        let results = Results::new(Store::open(&kept).await.map_err(StorageError::Results)?);
        let computed = Counter::default();
        let tasks = Tasks::new(results.clone(), computed.clone(), Handle::current());
        let jobs = open_jobs(config, below("jobs"), tasks).await?;
        if let Some(damaged) = jobs.set_aside() {
            tracing::error!(path = %damaged.display(), "the records of jobs were damaged: set aside, begun anew");
        }
        if let Some(directory) = directory {
            tracing::info!("jobs and results are kept in {}", directory.display());
        }
        Ok(Self { results, jobs: Arc::new(jobs), computed })
    }
}

async fn open_jobs(
    config: &ServeConfig,
    directory: Option<PathBuf>,
    tasks: Tasks,
) -> Result<Embedded, StorageError> {
    let jobs = embedded::Config {
        directory,
        threads: config.job_cores(),
        queue: config.queue,
        max_attempts: ATTEMPTS,
        ..embedded::Config::default()
    };
    let opened = tokio::task::spawn_blocking(move || Embedded::open(jobs, Arc::new(tasks)));
    opened.await.map_err(|_| StorageError::Lost)?.map_err(StorageError::Jobs)
}
