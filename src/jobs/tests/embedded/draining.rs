//! A back end that is drained.

use std::time::Duration;

use tempfile::TempDir;
use verne_jobs::embedded::Config;
use verne_jobs::{State, SubmitError};

use crate::fixture::{Fixture, timed_tests};
use crate::scripted_work::{id, job};

timed_tests!(
    a_drained_job_returns_to_the_queue,
    a_drain_does_not_wait_for_runs_that_do_not_stop,
    a_job_without_claims_is_not_run_again_after_a_drain,
);

fn fixture(directory: &TempDir) -> Fixture {
    Fixture::embedded(Config { max_attempts: 1, ..Config::in_directory(directory.path()) })
}

/// A drain does not count as a crash: the job runs again though only one attempt is allowed.
async fn a_drained_job_returns_to_the_queue() {
    let directory = TempDir::new().unwrap();
    let before = fixture(&directory);
    let claim = before.submit(job("ada", "running", "wait")).await;
    claim.detach();
    before.submit_detached(job("ada", "queued", "pass")).await;
    before.work.started(1).await;
    before.backend.drain(Duration::from_secs(30)).await;
    assert_eq!(before.work.ended(1).await, ["running"]);
    assert_eq!(claim.finished().await.state, State::Queued);
    let refused = before.backend.submit(job("ada", "late", "pass")).await.unwrap_err();
    assert_eq!(refused, SubmitError::Draining);
    assert!(before.backend.get(id("running")).await.is_err());

    let after = fixture(&directory);
    assert_eq!(after.work.started(1).await, ["running"]);
    after.work.release("running");
    let end = after.wait_for_end("running").await;
    assert_eq!((end.state, end.attempts), (State::Succeeded, 2));
    assert_eq!(after.wait_for_end("queued").await.state, State::Succeeded);
}

async fn a_drain_does_not_wait_for_runs_that_do_not_stop() {
    let directory = TempDir::new().unwrap();
    let before = fixture(&directory);
    before.submit_detached(job("ada", "ignore-stop", "ignore-stop")).await;
    before.work.started(1).await;
    before.backend.drain(Duration::from_millis(10)).await;
    let after = fixture(&directory);
    assert_eq!(after.work.started(1).await, ["ignore-stop"]);
    before.work.release("ignore-stop");
    after.work.release("ignore-stop");
    assert_eq!(after.wait_for_end("ignore-stop").await.state, State::Succeeded);
}

async fn a_job_without_claims_is_not_run_again_after_a_drain() {
    let directory = TempDir::new().unwrap();
    let before = fixture(&directory);
    let claim = before.submit(job("ada", "a", "stop-late")).await;
    before.work.started(1).await;
    let draining = {
        let backend = before.backend.clone();
        tokio::spawn(async move { backend.drain(Duration::from_secs(30)).await })
    };
    while before.backend.submit(job("ada", "probe", "pass")).await.is_ok() {}
    drop(claim);
    before.work.release("a");
    draining.await.unwrap();
    let after = fixture(&directory);
    assert_eq!(after.get("a").await.state, State::Cancelled);
    assert_eq!(after.backend.counts().running, 0);
}
