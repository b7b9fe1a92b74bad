//! Opens what outlives requests: the results and the queue of jobs.

pub(crate) mod shared;

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use tokio::runtime::Handle;
use verne_jobs::jetstream::ConnectError;
use verne_jobs::{Backend, Embedded, embedded};
use verne_store::Store;

use crate::operations::job_executor::JobExecutor;
use crate::operations::results::Results;
use crate::process::config::ServeConfig;
use crate::telemetry::metrics::computations::Computations;

/// A job that was running when the process died so often is likely the cause.
const ATTEMPTS: u32 = 10;

/// Why jobs and results cannot be kept.
#[derive(Debug)]
pub enum StorageError {
    /// The results, in the directory for data.
    Results(verne_store::OpenError),
    /// The results, where all processes reach them.
    Store(verne_store::OpenError),
    /// The jobs.
    Jobs(embedded::OpenError),
    /// The thread that opened them was lost.
    Lost,
    /// There are other processes, and no store that they reach.
    NoStore,
    /// There is no broker to take jobs from.
    NoBroker,
    /// The broker cannot be used.
    Broker(ConnectError),
    /// The broker did not come within so long.
    BrokerMissing(Duration),
}

impl fmt::Display for StorageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Results(error) => write!(f, "data: {error}"),
            Self::Store(error) => write!(f, "store: {error}"),
            Self::Jobs(error @ embedded::OpenError::Threads(_)) => write!(f, "job_threads: {error}"),
            Self::Jobs(error) => write!(f, "data: cannot store jobs: {error}"),
            Self::Lost => write!(f, "cannot store jobs: opening the records failed"),
            Self::NoStore => write!(f, "store: a broker needs a result store that all processes share"),
            Self::NoBroker => write!(f, "broker: a worker needs a broker"),
            Self::Broker(error) => write!(f, "{}: {error}", crate::process::storage::shared::key(error)),
            Self::BrokerMissing(waited) => {
                write!(f, "broker: no answer for {} s", waited.as_secs())
            }
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
    /// The same, where this process runs them.
    pub runs: Option<Arc<Embedded>>,
    /// How much was computed.
    pub computations: Computations,
}

impl Storage {
    /// Opens them where the settings say. A directory that was asked for must be usable; where it was not, memory will
    /// do, loudly.
    pub(crate) async fn open(config: &ServeConfig) -> Result<Self, StorageError> {
        if config.broker.broker.is_some() {
            let opened = shared::open(&config.broker, &config.store, config.cache_bytes, config.queue);
            let (results, jobs) = opened.await?;
            return Ok(Self { results, jobs, runs: None, computations: Computations::default() });
        }
        // Not by what falls back to memory: another directory would be of no use where the store is not.
        let store = crate::process::storage::shared::open_store(&config.store, config.cache_bytes).await?;
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

    /// `store`: where results are kept, if not in the directory.
    async fn open_in(
        config: &ServeConfig,
        directory: Option<&Path>,
        store: Option<Results>,
    ) -> Result<Self, StorageError> {
        let below = |name| directory.map(|directory| directory.join(name));
        let results = if let Some(results) = store {
            results
        } else {
            let kept = verne_store::Config {
                directory: below("results"),
                memory_bytes: config.cache_bytes,
                disk_bytes: config.disk_bytes,
            };
            Results::new(Store::open(&kept).await.map_err(StorageError::Results)?)
        };
        let computations = Computations::default();
        let tasks = JobExecutor::new(results.clone(), computations.clone(), Handle::current());
        let jobs = open_jobs(config, below("jobs"), tasks).await?;
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
        let jobs = Arc::new(jobs);
        let runs = Some(Arc::clone(&jobs));
        Ok(Self { results, jobs, runs, computations })
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
        max_attempts: ATTEMPTS,
        ..embedded::Config::default()
    };
    let opened = tokio::task::spawn_blocking(move || Embedded::open(jobs, Arc::new(tasks)));
    opened.await.map_err(|_| StorageError::Lost)?.map_err(StorageError::Jobs)
}
