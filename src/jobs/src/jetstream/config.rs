use std::fmt;
use std::path::PathBuf;
use std::time::Duration;

use async_nats::ConnectErrorKind;

use super::bus::Line;
use crate::embedded::Retention;

/// Where the broker is and how jobs are kept there. What is marked as shared must be the same in all processes.
#[derive(Clone, Debug)]
pub struct Config {
    /// `nats://host:4222`, or `tls://`; several of a cluster separated by commas. May hold user and password, or a token.
    pub url: String,
    /// A file of credentials: a JWT and its seed.
    pub credentials: Option<PathBuf>,
    /// A file with the seed of an nkey.
    pub nkey: Option<PathBuf>,
    /// Certificates, in PEM, of who may have signed the broker's, in place of the system's.
    pub authorities: Option<PathBuf>,
    /// The client's certificate and its key, in PEM.
    pub certificate: Option<(PathBuf, PathBuf)>,
    /// Begins the names of all that is kept: letters, digits, `-` and `_`. Shared.
    pub name: String,
    /// How many brokers keep each record. Shared.
    pub replicas: usize,
    /// Most jobs in the queue; at least one. Each process counts what it knows of, so those submitted elsewhere at the same
    /// moment may come on top.
    pub queue: usize,
    /// Most bytes of payload in the queue, counted so.
    pub queue_bytes: usize,
    /// Greatest cost that the express lane takes, seconds of one core.
    pub small: f64,
    /// How long the broker waits for a sign of life from who runs a job before it gives the job to another. Shared.
    pub ack_wait: Duration,
    /// A job whose worker was lost so many times is not run again. Shared.
    pub max_attempts: u32,
    /// A process that has not been heard of for so long waits for nothing any more. Shared.
    pub lease: Duration,
    /// How long a worker keeps a job that it cannot do ([`Stop::Elsewhere`](crate::Stop::Elsewhere)) before it hands it on.
    pub handing_on: Duration,
    /// How long a job may be recorded before its absence from the queue is mended.
    pub mend_after: Duration,
    /// What is kept of finished jobs. Shared.
    pub retention: Retention,
}

impl Config {
    /// The defaults, with a broker.
    pub fn at(url: impl Into<String>) -> Self {
        Self {
            url: url.into(),
            credentials: None,
            nkey: None,
            authorities: None,
            certificate: None,
            name: "verne".to_owned(),
            replicas: 1,
            queue: 10_000,
            queue_bytes: 256 << 20,
            small: 2.0,
            ack_wait: Duration::from_secs(30),
            max_attempts: 5,
            lease: Duration::from_secs(20),
            handing_on: Duration::from_secs(3),
            mend_after: Duration::from_secs(10),
            retention: Retention { count: 10_000, age: Duration::from_hours(7 * 24) },
        }
    }

    /// For a job that is no part.
    pub(super) fn line(&self, cost: f64) -> Line {
        if cost <= self.small { Line::Small } else { Line::Large }
    }
}

/// How a worker runs jobs.
#[derive(Clone, Copy, Debug)]
pub struct WorkerConfig {
    /// How many cores jobs keep busy; at least one.
    pub threads: usize,
    /// How many jobs run at once, beside a small one; between one and `threads`, which are dealt out among them.
    pub slots: usize,
}

/// What of a [`Config`] may be unusable by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// [`Config::url`].
    Url,
    /// [`Config::name`].
    Name,
    /// [`Config::credentials`].
    Credentials,
    /// [`Config::nkey`].
    Nkey,
    /// [`Config::authorities`].
    Authorities,
    /// The first of [`Config::certificate`].
    Certificate,
    /// The second of [`Config::certificate`], or it is another certificate's.
    Key,
}

/// Why there is no back end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ConnectError {
    /// A setting cannot be used, whatever the broker says.
    Unusable {
        /// Which.
        setting: Setting,
        /// What is wrong with it.
        reason: String,
    },
    /// The broker is not there, or cannot keep jobs now.
    Broker(String),
    /// The broker refuses this process: its password or key is wrong, or the broker forbids it what jobs need.
    Refused(String),
    /// Threads cannot be started.
    Threads(String),
}

impl From<async_nats::ConnectError> for ConnectError {
    fn from(fault: async_nats::ConnectError) -> Self {
        match fault.kind() {
            ConnectErrorKind::AuthorizationViolation | ConnectErrorKind::Authentication => {
                Self::Refused(fault.to_string())
            }
            _ => Self::Broker(fault.to_string()),
        }
    }
}

impl fmt::Display for ConnectError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unusable { reason, .. } => f.write_str(reason),
            Self::Broker(reason) => write!(f, "the broker of jobs cannot be used: {reason}"),
            Self::Refused(reason) => write!(f, "the broker of jobs refuses this process: {reason}"),
            Self::Threads(reason) => write!(f, "threads for jobs cannot be started: {reason}"),
        }
    }
}

impl std::error::Error for ConnectError {}
