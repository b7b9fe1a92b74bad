//! Settings of a service of many processes: the broker of jobs, and the store that all reach.

use std::path::PathBuf;

use clap::{Args, value_parser};

/// Where jobs wait that any process may take.
#[derive(Clone, Debug, Default, Args)]
pub struct BrokerConfig {
    /// Broker of jobs, NATS with `JetStream`: nats://HOST:4222 or tls://HOST:4222, several of a cluster with commas between.
    /// `verne serve` puts jobs there, and each `verne worker` takes some to run. Needs --store.
    #[arg(long, env = "VERNE_BROKER", value_name = "URL", hide_env_values = true)]
    pub broker: Option<String>,
    /// Begins the names of what is kept at the broker; the same in all processes of one service.
    #[arg(long, env = "VERNE_BROKER_NAME", default_value = "verne", value_name = "NAME")]
    pub broker_name: String,
    /// How many brokers of the cluster keep each record; the same in all processes.
    #[arg(long, env = "VERNE_BROKER_REPLICAS", default_value_t = 1, value_name = "BROKERS",
        value_parser = value_parser!(u8).range(1..=5))]
    pub broker_replicas: u8,
    /// File of credentials for the broker: a JWT and its seed.
    #[arg(long, env = "VERNE_BROKER_CREDENTIALS", value_name = "FILE")]
    pub broker_credentials: Option<PathBuf>,
    /// File with the seed of an nkey for the broker.
    #[arg(long, env = "VERNE_BROKER_NKEY", value_name = "FILE")]
    pub broker_nkey: Option<PathBuf>,
    /// Certificates, in PEM, of who may have signed the broker's, in place of the system's.
    #[arg(long, env = "VERNE_BROKER_CA", value_name = "FILE")]
    pub broker_ca: Option<PathBuf>,
    /// Certificate, in PEM, that is shown to the broker; with --broker-key.
    #[arg(long, env = "VERNE_BROKER_CERTIFICATE", value_name = "FILE")]
    pub broker_certificate: Option<PathBuf>,
    /// Key of that certificate, in PEM.
    #[arg(long, env = "VERNE_BROKER_KEY", value_name = "FILE")]
    pub broker_key: Option<PathBuf>,
}

/// Where results are kept that any process may read.
#[derive(Clone, Debug, Default, Args)]
pub struct StoreConfig {
    /// Store of results that all processes reach: s3://BUCKET/PREFIX (endpoint, region and credentials from `AWS_*`) or
    /// file:///SHARED/DIRECTORY, which `verne store init` has prepared. The service removes no sound result from it, only
    /// damaged ones and what it writes as a trial.
    #[arg(long, env = "VERNE_STORE", value_name = "URL")]
    pub store: Option<String>,
}
