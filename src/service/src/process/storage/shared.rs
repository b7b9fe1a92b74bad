//! Results and jobs of a service of many processes.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::JetStream;
use verne_jobs::jetstream::{self, ConnectError, Setting};
use verne_store::Store;

use crate::operations::results::Results;
use crate::process::config::cluster::{BrokerConfig, StoreConfig};
use crate::process::storage::{ATTEMPTS, StorageError};

/// How long the broker waits for a sign of life of who runs a job. A sign comes every third of it.
const ACK_WAIT: Duration = Duration::from_secs(15);

/// How long a broker that is not there is waited for when a process starts: both may have been started together.
const PATIENCE: Duration = Duration::from_mins(1);

/// How soon it is tried again.
const RETRY: Duration = Duration::from_secs(1);

/// Connects to the broker and opens the store that the settings name. What of the broker's cannot be used is told before
/// either is waited for.
pub(crate) async fn open(
    broker: &BrokerConfig,
    store: &StoreConfig,
    memory_bytes: u64,
    queue: usize,
) -> Result<(Results, Arc<JetStream>), StorageError> {
    let broker = settings(broker, queue)?;
    broker.check().await.map_err(StorageError::Broker)?;
    let results = open_store(store, memory_bytes).await?.ok_or(StorageError::NoStore)?;
    Ok((results, connect(broker).await?))
}

/// Opens the store that the settings name, if they name one.
pub(crate) async fn open_store(
    config: &StoreConfig,
    memory_bytes: u64,
) -> Result<Option<Results>, StorageError> {
    let Some(url) = &config.store else { return Ok(None) };
    let store = Store::open_shared(url, memory_bytes).await.map_err(StorageError::Store)?;
    tracing::info!("results are stored in {url}");
    Ok(Some(Results::new(store)))
}

async fn connect(config: jetstream::Config) -> Result<Arc<JetStream>, StorageError> {
    let connected = async {
        loop {
            match JetStream::connect(config.clone()).await {
                Ok(jobs) => return Ok(Arc::new(jobs)),
                Err(ConnectError::Broker(reason)) => {
                    tracing::warn!(reason, "waiting for the job broker");
                }
                Err(error) => return Err(StorageError::Broker(error)),
            }
            tokio::time::sleep(RETRY).await;
        }
    };
    let missing = |_| StorageError::BrokerMissing(PATIENCE);
    tokio::time::timeout(PATIENCE, connected).await.map_err(missing)?
}

fn settings(config: &BrokerConfig, queue: usize) -> Result<jetstream::Config, StorageError> {
    let url = config.broker.clone().ok_or(StorageError::NoBroker)?;
    Ok(jetstream::Config {
        credentials: config.broker_credentials.clone(),
        nkey: config.broker_nkey.clone(),
        authorities: config.broker_ca.clone(),
        certificate: config.broker_certificate.clone().zip(config.broker_key.clone()),
        name: config.broker_name.clone(),
        replicas: usize::from(config.broker_replicas),
        queue,
        ack_wait: ACK_WAIT,
        max_attempts: ATTEMPTS,
        ..jetstream::Config::at(url)
    })
}

/// The key of what cannot be used.
pub(crate) fn key(error: &ConnectError) -> &'static str {
    match error {
        ConnectError::Unusable { setting, .. } => match setting {
            Setting::Url => "broker",
            Setting::Name => "broker_name",
            Setting::Credentials => "broker_credentials",
            Setting::Nkey => "broker_nkey",
            Setting::Authorities => "broker_ca",
            Setting::Certificate => "broker_certificate",
            Setting::Key => "broker_key",
        },
        ConnectError::Broker(_) | ConnectError::Refused(_) => "broker",
        ConnectError::Threads(_) => "job_threads",
    }
}
