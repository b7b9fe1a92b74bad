//! Opens the broker and the result store of a service with many processes.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::JetStream;
use verne_jobs::jetstream::{self, ConnectError};
use verne_store::Store;

use crate::operations::results::Results;
use crate::process::config::cluster::{BrokerConfig, StoreConfig};
use crate::process::storage::error::StorageError;

/// A job that was running this many times when its process died is likely the cause.
pub(crate) const MAX_ATTEMPTS: u32 = 10;

/// The broker gives a job to another worker if the first one has not confirmed for so long that it still runs. Workers
/// confirm three times as often.
const ACK_WAIT: Duration = Duration::from_secs(15);

/// How long a process that starts waits for the broker, which may start at the same time.
const CONNECT_TIMEOUT: Duration = Duration::from_mins(1);

/// Pause between two attempts to connect to the broker.
const RETRY_PAUSE: Duration = Duration::from_secs(1);

/// Connects to the broker and opens the store. Checks the settings of the broker before it waits for either.
pub(crate) async fn open(
    broker: &BrokerConfig,
    store: &StoreConfig,
    memory_bytes: u64,
    queue: usize,
) -> Result<(Results, Arc<JetStream>), StorageError> {
    let broker = broker_config(broker, queue)?;
    broker.check().await.map_err(StorageError::Broker)?;
    let results = open_store(store, memory_bytes).await?.ok_or(StorageError::NoStore)?;
    Ok((results, connect(broker).await?))
}

/// Opens the store, if the settings name one.
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
            tokio::time::sleep(RETRY_PAUSE).await;
        }
    };
    let missing = |_| StorageError::BrokerMissing(CONNECT_TIMEOUT);
    tokio::time::timeout(CONNECT_TIMEOUT, connected).await.map_err(missing)?
}

fn broker_config(config: &BrokerConfig, queue: usize) -> Result<jetstream::Config, StorageError> {
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
        max_attempts: MAX_ATTEMPTS,
        ..jetstream::Config::at(url)
    })
}
