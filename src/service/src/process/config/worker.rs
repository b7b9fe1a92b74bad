//! The settings of `verne worker`.

use std::net::SocketAddr;
use std::num::NonZeroUsize;

use clap::{Args, value_parser};

use crate::process::config::cluster::{BrokerConfig, StoreConfig};
use crate::process::config::{MAX_SECONDS, SettingsFile};
use crate::telemetry::TelemetryConfig;

/// The settings of `verne worker`.
#[derive(Clone, Debug, Args)]
pub(crate) struct WorkerConfig {
    /// The settings file.
    #[command(flatten)]
    pub file: SettingsFile,
    /// The log and the traces.
    #[command(flatten)]
    pub telemetry: TelemetryConfig,
    /// The broker that has the jobs.
    #[command(flatten)]
    pub broker: BrokerConfig,
    /// The store for the results.
    #[command(flatten)]
    pub store: StoreConfig,
    /// Number of cores for jobs. Default: all.
    #[arg(long, env = "VERNE_JOB_THREADS", value_name = "CORES")]
    pub job_threads: Option<NonZeroUsize>,
    /// Number of jobs that run at once and share the cores. Default: one per core. A small job may run in addition.
    #[arg(long, env = "VERNE_SLOTS", value_name = "JOBS")]
    pub slots: Option<NonZeroUsize>,
    /// Address and port for /livez, /readyz and /metrics. By default the worker does not listen.
    #[arg(long, env = "VERNE_LISTEN")]
    pub listen: Option<SocketAddr>,
    /// Maximum size of the results in memory, in bytes.
    #[arg(long, env = "VERNE_CACHE_BYTES", default_value_t = 256 * 1024 * 1024,
        value_parser = value_parser!(u64).range(1..))]
    pub cache_bytes: u64,
    /// Seconds that jobs may take to stop after the worker receives a stop signal. They then return to the queue.
    #[arg(long, env = "VERNE_DRAIN", default_value_t = 10, value_name = "SECONDS",
        value_parser = value_parser!(u64).range(0..=MAX_SECONDS))]
    pub drain: u64,
}

impl WorkerConfig {
    /// The number of cores, and the number of jobs that run at once.
    pub(crate) fn threads_and_slots(&self) -> (usize, usize) {
        let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        let threads = self.job_threads.map_or(cores, NonZeroUsize::get);
        (threads, self.slots.map_or(threads, NonZeroUsize::get))
    }
}
