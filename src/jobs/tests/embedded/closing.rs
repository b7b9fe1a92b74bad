//! A back end that is closed in good order.

use std::time::Duration;

use tempfile::TempDir;
use verne_jobs::embedded::Config;
use verne_jobs::{State, SubmitError};

use crate::stage::{id, job};
use crate::stand::{Stand, within_a_minute};

fn stand(directory: &TempDir) -> Stand {
    Stand::at(Config { max_attempts: 1, ..Config::in_directory(directory.path()) })
}

/// A drain is no crash: with one attempt allowed the job is run again all the same.
#[tokio::test(flavor = "multi_thread")]
async fn a_drained_job_goes_back_to_the_queue() {
    within_a_minute(async {
        let directory = TempDir::new().unwrap();
        let before = stand(&directory);
        let claim = before.submit(job("ada", "running", "hold")).await;
        claim.keep();
        before.leave(job("ada", "queued", "pass")).await;
        before.stage.begun(1).await;
        before.backend.drain(Duration::from_secs(30)).await;
        assert_eq!(before.stage.left(1).await, ["running"]);
        assert_eq!(claim.finished().await.state, State::Queued);
        let refused = before.backend.submit(job("ada", "late", "pass")).await.unwrap_err();
        assert_eq!(refused, SubmitError::Draining);
        assert!(before.backend.get(id("running")).await.is_err());

        let after = stand(&directory);
        assert_eq!(after.stage.begun(1).await, ["running"]);
        after.stage.open("running");
        let end = after.end("running").await;
        assert_eq!((end.state, end.attempts), (State::Succeeded, 2));
        assert_eq!(after.end("queued").await.state, State::Succeeded);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_drain_does_not_wait_for_the_deaf() {
    within_a_minute(async {
        let directory = TempDir::new().unwrap();
        let before = stand(&directory);
        before.leave(job("ada", "deaf", "deaf")).await;
        before.stage.begun(1).await;
        before.backend.drain(Duration::from_millis(10)).await;
        let after = stand(&directory);
        assert_eq!(after.stage.begun(1).await, ["deaf"]);
        before.stage.open("deaf");
        after.stage.open("deaf");
        assert_eq!(after.end("deaf").await.state, State::Succeeded);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_nobody_wants_is_not_run_again() {
    within_a_minute(async {
        let directory = TempDir::new().unwrap();
        let before = stand(&directory);
        let claim = before.submit(job("ada", "a", "late")).await;
        before.stage.begun(1).await;
        let draining = {
            let backend = before.backend.clone();
            tokio::spawn(async move { backend.drain(Duration::from_secs(30)).await })
        };
        while before.backend.submit(job("ada", "probe", "pass")).await.is_ok() {}
        drop(claim);
        before.stage.open("a");
        draining.await.unwrap();
        let after = stand(&directory);
        assert_eq!(after.get("a").await.state, State::Cancelled);
        assert_eq!(after.backend.counts().running, 0);
    })
    .await;
}
