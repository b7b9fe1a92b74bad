//! Who wants a job, and what becomes of it.

use std::sync::Arc;

use verne_jobs::{Counts, State};

use crate::stage::job;
use crate::stand::{Open, for_each_backend};

for_each_backend!(
    equal_submissions_are_computed_once,
    the_last_claim_takes_a_running_job_along,
    the_last_claim_takes_a_queued_job_along,
    others_claims_hold_a_job,
    a_kept_job_goes_on,
    a_claim_is_dropped_outside_of_a_runtime,
    an_old_claim_does_not_end_a_new_life,
    an_abandoned_run_is_not_joined,
);

async fn equal_submissions_are_computed_once(open: Open) {
    let stand = open(10);
    let backend = Arc::clone(&stand.backend);
    let submissions: Vec<_> = (0..1000)
        .map(|number| {
            let backend = Arc::clone(&backend);
            tokio::spawn(async move {
                backend.submit(job(&format!("client {number}"), "a", "hold")).await.unwrap()
            })
        })
        .collect();
    let mut claims = Vec::new();
    for submission in submissions {
        claims.push(submission.await.unwrap());
    }
    stand.stage.open("a");
    for claim in claims {
        assert_eq!(claim.finished().await.state, State::Succeeded);
    }
    assert_eq!(stand.stage.begun(1).await, ["a"]);
    assert_eq!(stand.backend.counts(), Counts { started: 1, succeeded: 1, ..Counts::default() });
}

async fn the_last_claim_takes_a_running_job_along(open: Open) {
    let stand = open(10);
    let claim = stand.submit(job("ada", "a", "hold")).await;
    stand.stage.begun(1).await;
    drop(claim);
    assert_eq!(stand.end("a").await.state, State::Cancelled);
    assert_eq!(stand.stage.left(1).await, ["a"]);
}

async fn the_last_claim_takes_a_queued_job_along(open: Open) {
    let stand = open(10);
    stand.leave(job("ada", "running", "hold")).await;
    drop(stand.submit(job("ada", "a", "pass")).await);
    assert_eq!(stand.get("a").await.state, State::Cancelled);
}

async fn others_claims_hold_a_job(open: Open) {
    let stand = open(10);
    let first = stand.submit(job("ada", "a", "hold")).await;
    let second = stand.submit(job("bob", "a", "hold")).await;
    stand.stage.begun(1).await;
    drop(first);
    assert_eq!(stand.get("a").await.state, State::Running);
    stand.stage.open("a");
    assert_eq!(second.finished().await.state, State::Succeeded);
}

async fn a_kept_job_goes_on(open: Open) {
    let stand = open(10);
    stand.submit(job("ada", "a", "hold")).await.keep();
    drop(stand.submit(job("bob", "a", "hold")).await);
    stand.stage.open("a");
    assert_eq!(stand.end("a").await.state, State::Succeeded);
}

async fn a_claim_is_dropped_outside_of_a_runtime(open: Open) {
    let stand = open(10);
    let claim = stand.submit(job("ada", "a", "hold")).await;
    std::thread::spawn(move || drop(claim)).join().unwrap();
    assert_eq!(stand.end("a").await.state, State::Cancelled);
}

async fn an_old_claim_does_not_end_a_new_life(open: Open) {
    let stand = open(10);
    let old = stand.submit(job("ada", "a", "fail")).await;
    old.finished().await;
    let new = stand.submit(job("ada", "a", "hold")).await;
    drop(old);
    assert!(!new.job().state.is_final());
    stand.stage.open("a");
    assert_eq!(new.finished().await.state, State::Succeeded);
}

/// A run that has been told to stop takes a while to; who asks meanwhile wants the result.
async fn an_abandoned_run_is_not_joined(open: Open) {
    let stand = open(10);
    let abandoned = stand.submit(job("ada", "a", "deaf")).await;
    let mut watcher = abandoned.watch();
    stand.stage.begun(1).await;
    drop(abandoned);
    // Answered when the run has been told.
    stand.get("a").await;
    let claim = stand.submit(job("bob", "a", "deaf")).await;
    while let Some(job) = watcher.next().await {
        assert!(!job.state.is_final() || job.state == State::Cancelled);
    }
    stand.stage.open("a");
    let end = claim.finished().await;
    assert_eq!((end.state, end.client.as_str()), (State::Succeeded, "bob"));
    assert_eq!(stand.stage.left(2).await, ["a", "a"]);
}
