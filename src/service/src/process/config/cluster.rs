//! The settings of a service with many processes: the job broker and the shared result store.

use std::path::PathBuf;

use clap::{Args, value_parser};

/// The job broker.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Several processes")]
pub struct BrokerConfig {
    /// Job broker, NATS with `JetStream`: nats://HOST:4222 or tls://HOST:4222. Separate the servers of a cluster with
    /// commas. `verne serve` submits jobs to the broker, and each `verne worker` runs jobs from it. Needs --store.
    #[arg(long, env = "VERNE_BROKER", value_name = "URL", hide_env_values = true)]
    pub broker: Option<String>,
    /// Prefix of the names of the service's data at the broker. All processes of one service need the same prefix.
    #[arg(long, env = "VERNE_BROKER_NAME", default_value = "verne", value_name = "NAME")]
    pub broker_name: String,
    /// Number of brokers of the cluster that store each record. All processes of one service need the same number.
    #[arg(long, env = "VERNE_BROKER_REPLICAS", default_value_t = 1, value_name = "BROKERS",
        value_parser = value_parser!(u8).range(1..=5))]
    pub broker_replicas: u8,
    /// Credentials file for the broker: a JWT and its seed.
    #[arg(long, env = "VERNE_BROKER_CREDENTIALS", value_name = "FILE")]
    pub broker_credentials: Option<PathBuf>,
    /// File with an nkey seed for the broker.
    #[arg(long, env = "VERNE_BROKER_NKEY", value_name = "FILE")]
    pub broker_nkey: Option<PathBuf>,
    /// PEM file of the certificate authorities for the broker's certificate. It replaces the system's list.
    #[arg(long, env = "VERNE_BROKER_CA", value_name = "FILE")]
    pub broker_ca: Option<PathBuf>,
    /// PEM file with the client certificate for the broker. Needs --broker-key.
    #[arg(long, env = "VERNE_BROKER_CERTIFICATE", value_name = "FILE")]
    pub broker_certificate: Option<PathBuf>,
    /// PEM file with the private key of the client certificate.
    #[arg(long, env = "VERNE_BROKER_KEY", value_name = "FILE")]
    pub broker_key: Option<PathBuf>,
}

/// The shared result store.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Several processes")]
pub struct StoreConfig {
    /// Result store that all processes share: s3://BUCKET/PREFIX (endpoint, region and credentials come from the
    /// `AWS_*` variables) or file:///SHARED/DIRECTORY, which `verne store init` prepares. The service removes no intact
    /// result from it; it removes only damaged results and its own test objects.
    #[arg(long, env = "VERNE_STORE", value_name = "URL")]
    pub store: Option<String>,
}
