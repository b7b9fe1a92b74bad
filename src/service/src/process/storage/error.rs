//! Errors of opening the result store and the job queue.

use std::time::Duration;

use thiserror::Error;
use verne_jobs::embedded;
use verne_jobs::jetstream::{ConnectError, Setting};

/// Why jobs or results cannot be stored.
#[derive(Debug, Error)]
pub enum StorageError {
    /// The results in the data directory.
    #[error("data: {0}")]
    Results(verne_store::OpenError),
    /// The shared result store.
    #[error("store: {0}")]
    Store(verne_store::OpenError),
    /// The jobs in the data directory.
    #[error("{prefix}{0}", prefix = jobs_prefix(.0))]
    Jobs(embedded::OpenError),
    /// The thread that opened the jobs panicked.
    #[error("cannot store jobs: opening the records failed")]
    Lost,
    /// The settings name a broker, but no store.
    #[error("store: a broker needs a result store that all processes share")]
    NoStore,
    /// The settings of a worker name no broker.
    #[error("broker: a worker needs a broker")]
    NoBroker,
    /// The broker cannot be used.
    #[error("{setting}: {0}", setting = broker_setting(.0))]
    Broker(ConnectError),
    /// The broker has not answered within this time.
    #[error("broker: no answer for {seconds} s", seconds = .0.as_secs())]
    BrokerMissing(Duration),
}

/// The setting that causes an error of the jobs, and what the error prevents.
fn jobs_prefix(error: &embedded::OpenError) -> &'static str {
    match error {
        embedded::OpenError::Threads(_) => "job_threads: ",
        _ => "data: cannot store jobs: ",
    }
}

/// The setting that causes an error of the broker.
fn broker_setting(error: &ConnectError) -> &'static str {
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
