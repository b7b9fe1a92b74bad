//! A back end on a stage, and the contract's tests of each kind of it.

use std::sync::Arc;
use std::time::Duration;

use tempfile::TempDir;
use verne_jobs::embedded::Config;
use verne_jobs::jetstream::{self, Worker};
use verne_jobs::{Backend, Claim, Embedded, Job, Submission};

use crate::broker::{Broker, worker};
use crate::stage::{Stage, id};

pub(crate) struct Stand {
    /// Gone first.
    _worker: Option<Worker>,
    pub(crate) backend: Arc<dyn Backend>,
    pub(crate) stage: Arc<Stage>,
    /// Gone with the stand.
    _directory: Option<TempDir>,
    _broker: Option<Broker>,
}

/// Opens a back end of one kind, for one job at a time on one thread beside the express lane.
pub(crate) type Open = fn(queue: usize) -> Stand;

pub(crate) fn in_memory(queue: usize) -> Stand {
    embedded(queue, None)
}

pub(crate) fn on_disk(queue: usize) -> Stand {
    embedded(queue, Some(TempDir::new().unwrap()))
}

pub(crate) fn on_a_broker(queue: usize) -> Stand {
    let broker = Broker::start();
    let stage = Arc::new(Stage::default());
    let config = jetstream::Config { queue, ..broker.config() };
    let connected = verne_jobs::JetStream::connect(config);
    let runtime = tokio::runtime::Handle::current();
    let backend = tokio::task::block_in_place(|| runtime.block_on(connected)).unwrap();
    let worker = worker(&backend, &stage);
    let backend = Arc::new(backend);
    Stand { _worker: Some(worker), backend, stage, _directory: None, _broker: Some(broker) }
}

fn embedded(queue: usize, directory: Option<TempDir>) -> Stand {
    let path = directory.as_ref().map(|directory| directory.path().to_owned());
    let stand = Stand::at(Config { directory: path, queue, ..Config::default() });
    Stand { _directory: directory, ..stand }
}

impl Stand {
    pub(crate) fn at(config: Config) -> Self {
        let stage = Arc::new(Stage::default());
        let backend = Arc::new(Embedded::open(config, stage.clone()).unwrap());
        Self { _worker: None, backend, stage, _directory: None, _broker: None }
    }

    pub(crate) async fn submit(&self, submission: Submission) -> Claim {
        self.backend.submit(submission).await.unwrap()
    }

    /// Submits it to be done whoever waits.
    pub(crate) async fn leave(&self, submission: Submission) {
        self.submit(submission).await.keep();
    }

    pub(crate) async fn get(&self, name: &str) -> Job {
        self.backend.get(id(name)).await.unwrap().unwrap()
    }

    /// The job at its end.
    pub(crate) async fn end(&self, name: &str) -> Job {
        let mut watcher = self.backend.watch(id(name)).await.unwrap().unwrap();
        let mut last = None;
        while let Some(job) = watcher.next().await {
            last = Some(job);
        }
        last.filter(|job| job.state.is_final()).unwrap()
    }
}

/// What hangs fails.
pub(crate) async fn within_a_minute(test: impl Future<Output = ()>) {
    tokio::time::timeout(Duration::from_mins(1), test).await.unwrap();
}

/// Tests of the contract, for each kind of back end.
macro_rules! for_each_backend {
    ($($test:ident),* $(,)?) => {
        crate::stand::for_each_embedded! { $($test),* }

        mod on_a_broker {
            $(#[tokio::test(flavor = "multi_thread")]
            #[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
            async fn $test() {
                crate::stand::within_a_minute(super::$test(crate::stand::on_a_broker)).await;
            })*
        }
    };
}
pub(crate) use for_each_backend;

/// Tests of what only the embedded back end promises of the contract.
macro_rules! for_each_embedded {
    ($($test:ident),* $(,)?) => {
        mod in_memory {
            $(#[tokio::test(flavor = "multi_thread")]
            async fn $test() {
                crate::stand::within_a_minute(super::$test(crate::stand::in_memory)).await;
            })*
        }

        mod on_disk {
            $(#[tokio::test(flavor = "multi_thread")]
            async fn $test() {
                crate::stand::within_a_minute(super::$test(crate::stand::on_disk)).await;
            })*
        }
    };
}
pub(crate) use for_each_embedded;
