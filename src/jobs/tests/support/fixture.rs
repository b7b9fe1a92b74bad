//! A back end with scripted work, and macros that declare tests.

use std::sync::Arc;
use std::time::Duration;

use tempfile::TempDir;
use verne_jobs::embedded::Config;
use verne_jobs::jetstream::{self, Worker};
use verne_jobs::{Backend, Claim, Embedded, Job, Submission};

use crate::broker::{Broker, worker};
use crate::scripted_work::{ScriptedWork, id};

/// The fields are dropped in this order.
pub(crate) struct Fixture {
    _worker: Option<Worker>,
    pub(crate) backend: Arc<dyn Backend>,
    pub(crate) work: Arc<ScriptedWork>,
    _directory: Option<TempDir>,
    _broker: Option<Broker>,
}

/// Opens a back end of one kind, with one main slot of one thread.
pub(crate) type Open = fn(queue: usize) -> Fixture;

pub(crate) fn in_memory(queue: usize) -> Fixture {
    embedded(queue, None)
}

pub(crate) fn on_disk(queue: usize) -> Fixture {
    embedded(queue, Some(TempDir::new().unwrap()))
}

pub(crate) fn on_a_broker(queue: usize) -> Fixture {
    let broker = Broker::start();
    let work = Arc::new(ScriptedWork::default());
    let config = jetstream::Config { queue, ..broker.config() };
    let connected = verne_jobs::JetStream::connect(config);
    let runtime = tokio::runtime::Handle::current();
    let backend = tokio::task::block_in_place(|| runtime.block_on(connected)).unwrap();
    let worker = worker(&backend, &work);
    let backend = Arc::new(backend);
    Fixture { _worker: Some(worker), backend, work, _directory: None, _broker: Some(broker) }
}

fn embedded(queue: usize, directory: Option<TempDir>) -> Fixture {
    let path = directory.as_ref().map(|directory| directory.path().to_owned());
    let fixture = Fixture::embedded(Config { directory: path, queue, ..Config::default() });
    Fixture { _directory: directory, ..fixture }
}

impl Fixture {
    pub(crate) fn embedded(config: Config) -> Self {
        let work = Arc::new(ScriptedWork::default());
        let backend = Arc::new(Embedded::open(config, work.clone()).unwrap());
        Self { _worker: None, backend, work, _directory: None, _broker: None }
    }

    pub(crate) async fn submit(&self, submission: Submission) -> Claim {
        self.backend.submit(submission).await.unwrap()
    }

    /// Submits a job that continues without claims.
    pub(crate) async fn submit_detached(&self, submission: Submission) {
        self.submit(submission).await.detach();
    }

    pub(crate) async fn get(&self, name: &str) -> Job {
        self.backend.get(id(name)).await.unwrap().unwrap()
    }

    /// Waits for the end of a job.
    pub(crate) async fn wait_for_end(&self, name: &str) -> Job {
        wait_for_end(self.backend.as_ref(), name).await
    }
}

/// Waits for the end of a job. Another process may be submitting it.
pub(crate) async fn wait_for_end(backend: &dyn Backend, name: &str) -> Job {
    let mut watcher = loop {
        if let Some(watcher) = backend.watch(id(name)).await.unwrap() {
            break watcher;
        }
    };
    let mut last = None;
    while let Some(job) = watcher.next().await {
        last = Some(job);
    }
    last.filter(|job| job.state.is_final()).unwrap()
}

/// A test that hangs fails.
pub(crate) async fn within_a_minute(test: impl Future<Output = ()>) {
    tokio::time::timeout(Duration::from_mins(1), test).await.unwrap();
}

/// Declares tests of every kind of back end. Each is an `async fn` that takes an [`Open`].
macro_rules! for_each_backend {
    ($($test:ident),* $(,)?) => {
        crate::fixture::for_each_embedded! { $($test),* }

        mod on_a_broker {
            $(#[tokio::test(flavor = "multi_thread")]
            #[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
            async fn $test() {
                crate::fixture::within_a_minute(super::$test(crate::fixture::on_a_broker)).await;
            })*
        }
    };
}
pub(crate) use for_each_backend;

/// Declares tests of the embedded back end, in memory and on disk. Each is an `async fn` that takes an [`Open`].
macro_rules! for_each_embedded {
    ($($test:ident),* $(,)?) => {
        mod in_memory {
            $(#[tokio::test(flavor = "multi_thread")]
            async fn $test() {
                crate::fixture::within_a_minute(super::$test(crate::fixture::in_memory)).await;
            })*
        }

        mod on_disk {
            $(#[tokio::test(flavor = "multi_thread")]
            async fn $test() {
                crate::fixture::within_a_minute(super::$test(crate::fixture::on_disk)).await;
            })*
        }
    };
}
pub(crate) use for_each_embedded;

/// Declares tests with a time limit. Each is an `async fn` without arguments.
macro_rules! timed_tests {
    ($($test:ident),* $(,)?) => {
        mod timed {
            $(#[tokio::test(flavor = "multi_thread")]
            async fn $test() {
                crate::fixture::within_a_minute(super::$test()).await;
            })*
        }
    };
}
pub(crate) use timed_tests;

/// Declares tests with a time limit that start a broker. Each is an `async fn` without arguments.
macro_rules! broker_tests {
    ($($test:ident),* $(,)?) => {
        mod with_broker {
            $(#[tokio::test(flavor = "multi_thread")]
            #[ignore = "needs a broker: VERNE_NATS_SERVER=$(tests/nats-server) cargo test -- --include-ignored"]
            async fn $test() {
                crate::fixture::within_a_minute(super::$test()).await;
            })*
        }
    };
}
pub(crate) use broker_tests;
