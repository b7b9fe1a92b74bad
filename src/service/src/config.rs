//! Settings of `verne serve`, from flags, environment and a file.
//!
//! This is the one list of them. What two settings have to do with each other stands in `checks`: to clap, which reads
//! flags and environment before the file, `requires` and `conflicts_with` would mean less than they say.

mod checks;
mod effective;
mod file;
mod layered;
mod listen;
mod origin;
mod proxy;
pub mod sharing;
pub mod worker;

use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;
use std::time::Duration;

use clap::builder::{BoolishValueParser, RangedU64ValueParser};
use clap::{Args, value_parser};

pub(crate) use layered::read;
pub use listen::Listen;
pub use origin::Origin;
pub use proxy::{BasePath, HostName, ProxyNetwork};
use sharing::{BrokerConfig, StoreConfig};

use crate::state::RequestLimits;
use crate::telemetry::TelemetryConfig;
use crate::wire::capped::MOST_ROWS;

/// A year, in seconds: more than that is a mistake, and no clock overflows.
const LONGEST: u64 = 365 * 86_400;

/// Where settings come from beside flags and environment.
#[derive(Clone, Debug, Default, Args)]
pub struct SettingsFile {
    /// File of settings, in TOML: the keys are the flags' names with `_` for `-`. Flags and environment go before it.
    #[arg(long, env = "VERNE_CONFIG", value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// Print the settings in force and where each comes from, as a file for --config; then end.
    #[arg(long)]
    pub print_config: bool,
}

/// Where and what to serve.
#[derive(Clone, Debug, Args)]
pub struct ServeConfig {
    /// The file of settings.
    #[command(flatten)]
    pub file: SettingsFile,
    /// Address and port to listen on; `localhost:PORT` means 127.0.0.1 and ::1.
    #[arg(long, env = "VERNE_LISTEN", default_value = "localhost:8080", value_name = "ADDRESS:PORT")]
    pub listen: Listen,
    /// Host names, with commas between them, by which clients may address the service, beside localhost and addresses;
    /// `*` for any. By default any name where others can reach --listen, and none beside localhost where only this
    /// machine can.
    #[arg(long, env = "VERNE_ALLOWED_HOST", value_delimiter = ',', value_name = "NAME")]
    pub allowed_host: Vec<HostName>,
    /// Path under which a proxy publishes the service, such as /verne: links begin with it. The proxy may remove it
    /// from the requests or not.
    #[arg(long, env = "VERNE_BASE_PATH", default_value_t, value_name = "PATH")]
    pub base_path: BasePath,
    /// Networks of proxies, with commas between them, such as 10.0.0.0/8: for what comes from there the client is the
    /// last address in X-Forwarded-For that is in none of them.
    #[arg(long, env = "VERNE_TRUSTED_PROXY", value_delimiter = ',', value_name = "NETWORK")]
    pub trusted_proxy: Vec<ProxyNetwork>,
    /// Most open connections, an address at most half of them; on more, only probes are answered. Each is an open file.
    #[arg(long, env = "VERNE_MAX_CONNECTIONS", default_value_t = 10_000, value_name = "CONNECTIONS",
        value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    pub max_connections: usize,
    /// Seconds in which the headers of a request must have come, and in which the next request must begin.
    #[arg(long, env = "VERNE_HEADER_TIMEOUT", default_value_t = 10, value_name = "SECONDS",
        value_parser = value_parser!(u64).range(1..=LONGEST))]
    pub header_timeout: u64,
    /// Certificate with those that vouch for it, in PEM: serve over TLS. A new one is taken up within a minute.
    #[arg(long, env = "VERNE_TLS_CERTIFICATE", value_name = "FILE")]
    pub tls_certificate: Option<PathBuf>,
    /// The certificate's private key, in PEM.
    #[arg(long, env = "VERNE_TLS_KEY", value_name = "FILE")]
    pub tls_key: Option<PathBuf>,
    /// Pages that may ask from a browser, by their origins, such as `https://example.org`, with commas between them; `*` for
    /// all. Without it only the service's own.
    #[arg(long, env = "VERNE_CORS_ORIGIN", value_delimiter = ',', value_name = "ORIGIN")]
    pub cors_origin: Vec<Origin>,
    /// Directory whose *.json machines are published beside the built-in one.
    #[arg(long, env = "VERNE_MACHINES", value_name = "DIR")]
    pub machines: Option<PathBuf>,
    /// Most bytes in the body of a batch.
    #[arg(long, env = "VERNE_MAX_BODY_BYTES", default_value_t = 16 * 1024 * 1024,
        value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    pub max_body_bytes: usize,
    /// Most rows in a batch.
    #[arg(long, env = "VERNE_MAX_ROWS", default_value_t = 100_000,
        value_parser = RangedU64ValueParser::<usize>::new().range(1..=MOST_ROWS as u64))]
    pub max_rows: usize,
    /// Most triangles of a mesh. What would have more by an estimate is refused before it is computed; what turns out to have
    /// more, when it has.
    #[arg(long, env = "VERNE_MAX_TRIANGLES", default_value_t = 5_000_000, value_name = "TRIANGLES",
        value_parser = value_parser!(u64).range(1..))]
    pub max_triangles: u64,
    /// Directory in which jobs and results outlive the process; by default the user's own directory for data.
    #[arg(long, env = "VERNE_DATA", value_name = "DIR")]
    pub data: Option<PathBuf>,
    /// Keep jobs and results in memory, for as long as the process lives.
    #[arg(long, env = "VERNE_MEMORY_ONLY", value_parser = BoolishValueParser::new())]
    pub memory_only: bool,
    /// Most bytes of results that are kept in memory.
    #[arg(long, env = "VERNE_CACHE_BYTES", default_value_t = 256 * 1024 * 1024,
        value_parser = value_parser!(u64).range(1..))]
    pub cache_bytes: u64,
    /// Most bytes of results that are kept in the data directory; the longest unused leave first.
    #[arg(long, env = "VERNE_DISK_BYTES", default_value_t = 4 * 1024 * 1024 * 1024,
        value_parser = value_parser!(u64).range(1..))]
    pub disk_bytes: u64,
    /// Cores that jobs keep busy; by default all but one, at least one.
    #[arg(long, env = "VERNE_JOB_THREADS", value_name = "CORES")]
    pub job_threads: Option<NonZeroUsize>,
    /// Most jobs that wait for their turn.
    #[arg(long, env = "VERNE_QUEUE", default_value_t = 10_000, value_name = "JOBS",
        value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    pub queue: usize,
    /// Seconds after which a job is given up, its time in the queue included.
    #[arg(long, env = "VERNE_JOB_LIMIT", default_value_t = 86_400, value_name = "SECONDS",
        value_parser = value_parser!(u64).range(1..=LONGEST))]
    pub job_limit: u64,
    /// Seconds for which an answer is waited for before the address of its job is answered.
    #[arg(long, env = "VERNE_WAIT", default_value_t = 10, value_name = "SECONDS",
        value_parser = value_parser!(u64).range(0..=LONGEST))]
    pub wait: u64,
    /// Seconds after which a request is given up, or an answer of which the client takes nothing.
    #[arg(long, env = "VERNE_TIMEOUT", default_value_t = 30, value_name = "SECONDS",
        value_parser = value_parser!(u64).range(1..=LONGEST))]
    pub timeout: u64,
    /// TOML file of the API keys that requests need, made by `verne key new`; without it anybody may ask for anything.
    /// Read again at SIGHUP.
    #[arg(long, env = "VERNE_KEYS", value_name = "FILE")]
    pub keys: Option<PathBuf>,
    /// Requests a second that a key, or where no known key is sent an address, may send; 0 for any number. Behind a
    /// proxy that --trusted-proxy does not name all come from the proxy's address.
    #[arg(long, env = "VERNE_RATE", default_value_t = 0, value_name = "REQUESTS")]
    pub rate: u32,
    /// Requests that may come at once where --rate limits them; by default a second's.
    #[arg(long, env = "VERNE_RATE_BURST", value_name = "REQUESTS")]
    pub rate_burst: Option<NonZeroU32>,
    /// Most requests that are worked on at once, those that wait for a job not counted; a key, or without --keys an address,
    /// has at most half of them. The next are answered 503.
    #[arg(long, env = "VERNE_MAX_REQUESTS", default_value_t = 4096, value_name = "REQUESTS",
        value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    pub max_requests: usize,
    /// Seconds that requests under way and jobs have to come to an end when the service is told to stop.
    #[arg(long, env = "VERNE_DRAIN", default_value_t = 10, value_name = "SECONDS",
        value_parser = value_parser!(u64).range(0..=LONGEST))]
    pub drain: u64,
    /// What the process tells of itself.
    #[command(flatten)]
    pub telemetry: TelemetryConfig,
    /// Where jobs wait, if other processes run them.
    #[command(flatten)]
    pub broker: BrokerConfig,
    /// Where results are kept, if other processes read them.
    #[command(flatten)]
    pub store: StoreConfig,
}

impl ServeConfig {
    pub(crate) fn limits(&self) -> RequestLimits {
        let longest_wait = Duration::from_secs(self.timeout.saturating_sub(1));
        RequestLimits {
            body_bytes: self.max_body_bytes,
            rows: self.max_rows,
            triangles: self.max_triangles,
            wait: Duration::from_secs(self.wait).min(longest_wait),
            longest_wait,
            job: Duration::from_secs(self.job_limit),
        }
    }

    /// Cores for jobs: what is interactive keeps one.
    pub(crate) fn job_cores(&self) -> usize {
        let cores = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        self.job_threads.map_or(cores.saturating_sub(1).max(1), NonZeroUsize::get)
    }
}
