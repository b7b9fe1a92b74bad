//! The settings of `verne serve`, from flags, environment variables and a file.
//!
//! - This module, `cluster`, `worker` and `listen` list the settings. clap generates the flags and the help from them.
//! - `sources` reads them from all layers, `file` from the settings file; `layers` tells from which layer a value
//!   comes.
//! - `checks` rejects settings that contradict each other. clap's `requires` and `conflicts_with` cannot do that,
//!   because clap reads flags and environment variables before the file.
//! - `print` prints the effective settings.

pub(crate) mod checks;
pub(crate) mod cluster;
pub(crate) mod file;
pub(crate) mod layers;
pub(crate) mod listen;
pub(crate) mod print;
pub(crate) mod sources;
pub(crate) mod worker;

use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;
use std::time::Duration;

use clap::builder::{BoolishValueParser, RangedU64ValueParser};
use clap::{Args, value_parser};

use crate::http::origin::Origin;
use crate::http::proxy::{BasePath, HostName, ProxyNetwork};
use crate::http::state::RequestLimits;
use crate::process::config::cluster::{BrokerConfig, StoreConfig};
use crate::process::config::listen::Listen;
use crate::telemetry::TelemetryConfig;
use crate::wire::bounded_list::MOST_ROWS;

/// Maximum of all durations: a year, in seconds. More is a mistake, and no clock overflows.
const MAX_SECONDS: u64 = 365 * 86_400;

/// The sections of the help of `verne serve`.
const NETWORK: &str = "Addresses, origins and TLS";
const CLIENTS: &str = "Keys and rates";
const LIMITS: &str = "Limits of requests";
const JOBS: &str = "Jobs and results";

/// The settings file.
#[derive(Clone, Debug, Default, Args)]
pub struct SettingsFile {
    /// TOML file of settings. Its keys are the flag names with `_` instead of `-`. Flags and environment variables
    /// override it.
    #[arg(long, env = "VERNE_CONFIG", value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// Print the effective settings in the format of the --config file, then exit.
    #[arg(long)]
    pub print_config: bool,
}

/// The settings of `verne serve`.
#[derive(Clone, Debug, Args)]
pub struct ServeConfig {
    /// The settings file.
    #[command(flatten)]
    pub file: SettingsFile,
    /// Address and port to listen on. `localhost:PORT` means 127.0.0.1 and ::1.
    #[arg(help_heading = NETWORK)]
    #[arg(long, env = "VERNE_LISTEN", default_value = "localhost:8080", value_name = "ADDRESS:PORT")]
    pub listen: Listen,
    /// Host names that the service accepts in addition to localhost and IP addresses, separated by commas; `*` accepts
    /// any name. Default: any name if other machines can reach --listen, otherwise only localhost and IP addresses.
    #[arg(help_heading = NETWORK)]
    #[arg(long, env = "VERNE_ALLOWED_HOST", value_delimiter = ',', value_name = "NAME")]
    pub allowed_host: Vec<HostName>,
    /// Path under which a proxy publishes the service, such as /verne. Links begin with it. The proxy may keep it in
    /// the requests or remove it.
    #[arg(help_heading = NETWORK)]
    #[arg(long, env = "VERNE_BASE_PATH", default_value_t, value_name = "PATH")]
    pub base_path: BasePath,
    /// Networks of trusted proxies, separated by commas, such as 10.0.0.0/8. In requests from these networks, the
    /// client is the last address in X-Forwarded-For that is outside of them.
    #[arg(help_heading = NETWORK)]
    #[arg(long, env = "VERNE_TRUSTED_PROXY", value_delimiter = ',', value_name = "NETWORK")]
    pub trusted_proxy: Vec<ProxyNetwork>,
    /// Maximum number of open connections. One address may open half of them. On further connections the service
    /// answers only probes and metrics. Each connection needs a file descriptor.
    #[arg(help_heading = LIMITS)]
    #[arg(long, env = "VERNE_MAX_CONNECTIONS", default_value_t = 10_000, value_name = "CONNECTIONS",
        value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    pub max_connections: usize,
    /// Seconds within which a client must send all headers of a request. It is also the time within which the next
    /// request on a connection must begin.
    #[arg(help_heading = LIMITS)]
    #[arg(long, env = "VERNE_HEADER_TIMEOUT", default_value_t = 10, value_name = "SECONDS",
        value_parser = value_parser!(u64).range(1..=MAX_SECONDS))]
    pub header_timeout: u64,
    /// PEM file with the certificate and its chain; the service then uses TLS. The service loads a changed file within
    /// a minute.
    #[arg(help_heading = NETWORK)]
    #[arg(long, env = "VERNE_TLS_CERTIFICATE", value_name = "FILE")]
    pub tls_certificate: Option<PathBuf>,
    /// PEM file with the private key of the certificate.
    #[arg(help_heading = NETWORK)]
    #[arg(long, env = "VERNE_TLS_KEY", value_name = "FILE")]
    pub tls_key: Option<PathBuf>,
    /// Origins whose web pages may send requests from a browser, separated by commas, such as `https://example.org`;
    /// `*` allows all. By default only the service's own pages may.
    #[arg(help_heading = NETWORK)]
    #[arg(long, env = "VERNE_CORS_ORIGIN", value_delimiter = ',', value_name = "ORIGIN")]
    pub cors_origin: Vec<Origin>,
    /// Directory with machine files (*.json). The service publishes them in addition to the built-in machine.
    #[arg(long, env = "VERNE_MACHINES", value_name = "DIR")]
    pub machines: Option<PathBuf>,
    /// Maximum size of the body of a batch, in bytes.
    #[arg(help_heading = LIMITS)]
    #[arg(long, env = "VERNE_MAX_BODY_BYTES", default_value_t = 16 * 1024 * 1024,
        value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    pub max_body_bytes: usize,
    /// Maximum size of a program (the file of a tool path), in bytes. The service counts the decoded bytes of a
    /// compressed body.
    #[arg(help_heading = LIMITS)]
    #[arg(long, env = "VERNE_MAX_PROGRAM_BYTES", default_value_t = 128 * 1024 * 1024,
        value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    pub max_program_bytes: usize,
    /// Maximum number of rows in a batch.
    #[arg(help_heading = LIMITS)]
    #[arg(long, env = "VERNE_MAX_ROWS", default_value_t = 100_000,
        value_parser = RangedU64ValueParser::<usize>::new().range(1..=MOST_ROWS as u64))]
    pub max_rows: usize,
    /// Maximum number of triangles in a mesh. The service rejects a request before the computation if its estimate is
    /// higher. It aborts a computation whose mesh exceeds the maximum.
    #[arg(help_heading = LIMITS)]
    #[arg(long, env = "VERNE_MAX_TRIANGLES", default_value_t = 5_000_000, value_name = "TRIANGLES",
        value_parser = value_parser!(u64).range(1..))]
    pub max_triangles: u64,
    /// Directory for jobs and results, which then survive a restart. Default: a directory in the user's data directory.
    #[arg(help_heading = JOBS)]
    #[arg(long, env = "VERNE_DATA", value_name = "DIR")]
    pub data: Option<PathBuf>,
    /// Store jobs and results only in memory. They are lost when the process ends.
    #[arg(help_heading = JOBS)]
    #[arg(long, env = "VERNE_MEMORY_ONLY", value_parser = BoolishValueParser::new())]
    pub memory_only: bool,
    /// Maximum size of the results in memory, in bytes.
    #[arg(help_heading = JOBS)]
    #[arg(long, env = "VERNE_CACHE_BYTES", default_value_t = 256 * 1024 * 1024,
        value_parser = value_parser!(u64).range(1..))]
    pub cache_bytes: u64,
    /// Maximum size of the results in the data directory, in bytes. The service evicts the least recently used results
    /// first.
    #[arg(help_heading = JOBS)]
    #[arg(long, env = "VERNE_DISK_BYTES", default_value_t = 4 * 1024 * 1024 * 1024,
        value_parser = value_parser!(u64).range(1..))]
    pub disk_bytes: u64,
    /// Number of cores for jobs. Default: all but one, and at least one.
    #[arg(help_heading = JOBS)]
    #[arg(long, env = "VERNE_JOB_THREADS", value_name = "CORES")]
    pub job_threads: Option<NonZeroUsize>,
    /// Maximum number of jobs in the queue.
    #[arg(help_heading = JOBS)]
    #[arg(long, env = "VERNE_QUEUE", default_value_t = 10_000, value_name = "JOBS",
        value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    pub queue: usize,
    /// Seconds after which the service aborts a job. The time in the queue counts.
    #[arg(help_heading = JOBS)]
    #[arg(long, env = "VERNE_JOB_LIMIT", default_value_t = 86_400, value_name = "SECONDS",
        value_parser = value_parser!(u64).range(1..=MAX_SECONDS))]
    pub job_limit: u64,
    /// Seconds for which a request waits for its job. After that the service answers with the address of the job.
    #[arg(help_heading = LIMITS)]
    #[arg(long, env = "VERNE_WAIT", default_value_t = 10, value_name = "SECONDS",
        value_parser = value_parser!(u64).range(0..=MAX_SECONDS))]
    pub wait: u64,
    /// Seconds after which the service aborts a request, or a response of which the client reads nothing.
    #[arg(help_heading = LIMITS)]
    #[arg(long, env = "VERNE_TIMEOUT", default_value_t = 30, value_name = "SECONDS",
        value_parser = value_parser!(u64).range(1..=MAX_SECONDS))]
    pub timeout: u64,
    /// TOML file of API keys, with entries from `verne key new`. Requests then need a key; without this file anybody
    /// may send any request. SIGHUP reloads the file.
    #[arg(help_heading = CLIENTS)]
    #[arg(long, env = "VERNE_KEYS", value_name = "FILE")]
    pub keys: Option<PathBuf>,
    /// Maximum number of requests per second from one client; 0 means no limit. A client is an API key, or an address
    /// if the request has no valid key. Behind a proxy that is not in --trusted-proxy, all requests come from the
    /// proxy's address.
    #[arg(help_heading = CLIENTS)]
    #[arg(long, env = "VERNE_RATE", default_value_t = 0, value_name = "REQUESTS")]
    pub rate: u32,
    /// Number of requests that a client may send at once, if --rate is set. Default: the value of --rate.
    #[arg(help_heading = CLIENTS)]
    #[arg(long, env = "VERNE_RATE_BURST", value_name = "REQUESTS")]
    pub rate_burst: Option<NonZeroU32>,
    /// Maximum number of requests that the service processes at once. Requests that wait for a job do not count. A key,
    /// or without --keys an address, may use half of them. The service answers further requests with 503.
    #[arg(help_heading = LIMITS)]
    #[arg(long, env = "VERNE_MAX_REQUESTS", default_value_t = 4096, value_name = "REQUESTS",
        value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    pub max_requests: usize,
    /// Seconds that requests in progress and jobs may take to finish after the service receives a stop signal.
    #[arg(help_heading = JOBS)]
    #[arg(long, env = "VERNE_DRAIN", default_value_t = 10, value_name = "SECONDS",
        value_parser = value_parser!(u64).range(0..=MAX_SECONDS))]
    pub drain: u64,
    /// The log and the traces.
    #[command(flatten)]
    pub telemetry: TelemetryConfig,
    /// The broker, if other processes run the jobs.
    #[command(flatten)]
    pub broker: BrokerConfig,
    /// The result store, if other processes read the results.
    #[command(flatten)]
    pub store: StoreConfig,
}

impl ServeConfig {
    /// The limits of requests.
    pub(crate) fn limits(&self) -> RequestLimits {
        let longest_wait = Duration::from_secs(self.timeout.saturating_sub(1));
        RequestLimits {
            body_bytes: self.max_body_bytes,
            program_bytes: self.max_program_bytes,
            rows: self.max_rows,
            triangles: self.max_triangles,
            wait: Duration::from_secs(self.wait).min(longest_wait),
            longest_wait,
            job: Duration::from_secs(self.job_limit),
        }
    }

    /// Number of cores for jobs. By default one core remains for requests.
    pub(crate) fn job_cores(&self) -> usize {
        let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        self.job_threads.map_or(cores.saturating_sub(1).max(1), NonZeroUsize::get)
    }
}
