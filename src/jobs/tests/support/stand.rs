//! A back end on a stage, and the contract's tests of each kind of it.

use std::sync::Arc;
use std::time::Duration;

use tempfile::TempDir;
use verne_jobs::embedded::Config;
use verne_jobs::{Backend, Claim, Embedded, Job, Submission};

use crate::stage::{Stage, id};

pub(crate) struct Stand {
    pub(crate) backend: Arc<dyn Backend>,
    pub(crate) stage: Arc<Stage>,
    /// Gone with the stand.
    _directory: Option<TempDir>,
}

/// Opens a back end of one kind, for one job at a time on one thread beside the express lane.
pub(crate) type Open = fn(queue: usize) -> Stand;

pub(crate) fn in_memory(queue: usize) -> Stand {
    embedded(queue, None)
}

pub(crate) fn on_disk(queue: usize) -> Stand {
    embedded(queue, Some(TempDir::new().unwrap()))
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
        Self { backend, stage, _directory: None }
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
pub(crate) use for_each_backend;
