//! Results and jobs of a service of many processes.

use std::sync::Arc;
use std::time::Duration;

use verne_jobs::JetStream;
use verne_jobs::jetstream::{self, ConnectError};
use verne_store::Store;

use super::{ATTEMPTS, StorageError};
use crate::config::sharing::{BrokerConfig, StoreConfig};
use crate::results::Results;

/// How long the broker waits for a sign of life of who runs a job. A sign comes every third of it.
const ACK_WAIT: Duration = Duration::from_secs(15);

/// How long a broker that is not there is waited for when a process starts: both may have been started together.
const PATIENCE: Duration = Duration::from_mins(1);

/// How soon it is tried again.
const RETRY: Duration = Duration::from_secs(1);

/// Opens the store that the settings name.
pub(crate) async fn open_store(config: &StoreConfig, memory_bytes: u64) -> Result<Results, StorageError> {
    let url = config.store.as_ref().ok_or(StorageError::NoStore)?;
    let store = Store::open_shared(url, memory_bytes).await.map_err(StorageError::Results)?;
    tracing::info!("results are kept in {url}");
    Ok(Results::new(store))
}

/// Connects to the broker that the settings name.
pub(crate) async fn connect(config: &BrokerConfig, queue: usize) -> Result<Arc<JetStream>, StorageError> {
    let config = settings(config, queue)?;
    let connected = async {
        loop {
            match JetStream::connect(config.clone()).await {
                Ok(jobs) => return Ok(Arc::new(jobs)),
                Err(ConnectError::Broker(reason)) => {
                    tracing::warn!(reason, "the broker of jobs is waited for");
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
