//! Settings of the back end at a broker.

use std::path::PathBuf;
use std::time::Duration;

use async_nats::ConnectErrorKind;

use super::queue_class::QueueClass;
use crate::retention::Retention;

/// The broker, and how jobs are recorded there. Shared settings must be the same in all processes.
#[derive(Clone, Debug)]
pub struct Config {
    /// `nats://host:4222` or `tls://`; several servers of a cluster are separated by commas. May contain user and
    /// password, or a token.
    pub url: String,
    /// File of credentials: a JWT and its seed.
    pub credentials: Option<PathBuf>,
    /// File with the seed of an nkey.
    pub nkey: Option<PathBuf>,
    /// PEM file of the authorities that may have signed the broker's certificate, instead of the system's.
    pub authorities: Option<PathBuf>,
    /// PEM files of the client's certificate and its key.
    pub certificate: Option<(PathBuf, PathBuf)>,
    /// Prefix of all names at the broker: letters, digits, `-` and `_`. Shared.
    pub name: String,
    /// Number of servers that store each record. Shared.
    pub replicas: usize,
    /// Most jobs in the queue; at least one. A process counts the jobs that it knows, so submissions of other processes
    /// at the same time may exceed it.
    pub queue: usize,
    /// Most bytes of payload in the queue, counted in the same way.
    pub queue_bytes: usize,
    /// Greatest cost of a small job, seconds of one core.
    pub small_cost: f64,
    /// Time without a keep-alive message from a worker after which the broker gives its job to another. Shared.
    pub ack_wait: Duration,
    /// A job that has lost its worker so many times is not run again. Shared.
    pub max_attempts: u32,
    /// Time without a heartbeat after which the claims of a process end. Shared.
    pub lease: Duration,
    /// Time for which a worker keeps a job that it [cannot run](crate::WorkError::CannotRunHere) before it returns the
    /// job.
    pub return_delay: Duration,
    /// Age of a record after which a job that is missing in the queue is queued again.
    pub requeue_after: Duration,
    /// Limits on the records of ended jobs. Shared.
    pub retention: Retention,
}

impl Config {
    /// The defaults with this broker.
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
            small_cost: 2.0,
            ack_wait: Duration::from_secs(30),
            max_attempts: 5,
            lease: Duration::from_secs(20),
            return_delay: Duration::from_secs(3),
            requeue_after: Duration::from_secs(10),
            retention: Retention::default(),
        }
    }

    /// Class of a job that is no subtask of a large one.
    pub(super) fn class(&self, cost: f64) -> QueueClass {
        if cost <= self.small_cost { QueueClass::Small } else { QueueClass::Large }
    }
}

/// How a worker runs jobs.
#[derive(Clone, Copy, Debug)]
pub struct WorkerConfig {
    /// Number of cores that jobs use; at least one.
    pub threads: usize,
    /// Number of main slots, from one to `threads`. They share the threads.
    pub slots: usize,
}

/// A setting of [`Config`] that can be unusable by itself.
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
    /// The first file of [`Config::certificate`].
    Certificate,
    /// The second file of [`Config::certificate`], also if it belongs to another certificate.
    Key,
}

/// The back end cannot be opened.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ConnectError {
    /// A setting cannot be used, whatever the broker answers.
    #[error("{reason}")]
    Unusable {
        /// The setting.
        setting: Setting,
        /// The defect.
        reason: String,
    },
    /// The broker does not answer, or cannot record jobs now.
    #[error("the broker of jobs cannot be used: {0}")]
    Broker(String),
    /// The broker refuses this process: its password or key is wrong, or the broker forbids an operation that jobs
    /// need.
    #[error("the broker of jobs refuses this process: {0}")]
    Refused(String),
    /// Threads cannot be started.
    #[error("threads for jobs cannot be started: {0}")]
    Threads(String),
}

impl From<async_nats::ConnectError> for ConnectError {
    fn from(error: async_nats::ConnectError) -> Self {
        match error.kind() {
            ConnectErrorKind::AuthorizationViolation | ConnectErrorKind::Authentication => {
                Self::Refused(error.to_string())
            }
            _ => Self::Broker(error.to_string()),
        }
    }
}
