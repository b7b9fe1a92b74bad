//! Claims on jobs.

use std::sync::Arc;

use verne_jobs::{Counts, State};

use crate::fixture::{Open, for_each_backend};
use crate::scripted_work::job;

for_each_backend!(
    equal_submissions_are_computed_once,
    dropping_the_last_claim_cancels_a_running_job,
    dropping_the_last_claim_cancels_a_queued_job,
    a_job_continues_while_another_claim_exists,
    a_detached_job_continues_without_claims,
    a_claim_can_be_dropped_outside_of_a_runtime,
    a_claim_on_an_ended_job_does_not_cancel_the_next_generation,
    a_submission_does_not_join_a_run_that_was_told_to_stop,
);

async fn equal_submissions_are_computed_once(open: Open) {
    let fixture = open(10);
    let backend = Arc::clone(&fixture.backend);
    let submissions: Vec<_> = (0..1000)
        .map(|number| {
            let backend = Arc::clone(&backend);
            tokio::spawn(async move {
                backend.submit(job(&format!("client {number}"), "a", "wait")).await.unwrap()
            })
        })
        .collect();
    let mut claims = Vec::new();
    for submission in submissions {
        claims.push(submission.await.unwrap());
    }
    fixture.work.release("a");
    for claim in claims {
        assert_eq!(claim.finished().await.state, State::Succeeded);
    }
    assert_eq!(fixture.work.started(1).await, ["a"]);
    assert_eq!(fixture.backend.counts(), Counts { started: 1, succeeded: 1, ..Counts::default() });
}

async fn dropping_the_last_claim_cancels_a_running_job(open: Open) {
    let fixture = open(10);
    let claim = fixture.submit(job("ada", "a", "wait")).await;
    fixture.work.started(1).await;
    drop(claim);
    assert_eq!(fixture.wait_for_end("a").await.state, State::Cancelled);
    assert_eq!(fixture.work.ended(1).await, ["a"]);
}

async fn dropping_the_last_claim_cancels_a_queued_job(open: Open) {
    let fixture = open(10);
    fixture.submit_detached(job("ada", "running", "wait")).await;
    drop(fixture.submit(job("ada", "a", "pass")).await);
    assert_eq!(fixture.get("a").await.state, State::Cancelled);
}

async fn a_job_continues_while_another_claim_exists(open: Open) {
    let fixture = open(10);
    let first = fixture.submit(job("ada", "a", "wait")).await;
    let second = fixture.submit(job("bob", "a", "wait")).await;
    fixture.work.started(1).await;
    drop(first);
    assert_eq!(fixture.get("a").await.state, State::Running);
    fixture.work.release("a");
    assert_eq!(second.finished().await.state, State::Succeeded);
}

async fn a_detached_job_continues_without_claims(open: Open) {
    let fixture = open(10);
    fixture.submit(job("ada", "a", "wait")).await.detach();
    drop(fixture.submit(job("bob", "a", "wait")).await);
    fixture.work.release("a");
    assert_eq!(fixture.wait_for_end("a").await.state, State::Succeeded);
}

async fn a_claim_can_be_dropped_outside_of_a_runtime(open: Open) {
    let fixture = open(10);
    let claim = fixture.submit(job("ada", "a", "wait")).await;
    std::thread::spawn(move || drop(claim)).join().unwrap();
    assert_eq!(fixture.wait_for_end("a").await.state, State::Cancelled);
}

async fn a_claim_on_an_ended_job_does_not_cancel_the_next_generation(open: Open) {
    let fixture = open(10);
    let old = fixture.submit(job("ada", "a", "fail")).await;
    old.finished().await;
    let new = fixture.submit(job("ada", "a", "wait")).await;
    drop(old);
    assert!(!new.job().state.is_final());
    fixture.work.release("a");
    assert_eq!(new.finished().await.state, State::Succeeded);
}

/// The run takes a while to stop. A client that submits the job meanwhile wants its result.
async fn a_submission_does_not_join_a_run_that_was_told_to_stop(open: Open) {
    let fixture = open(10);
    let abandoned = fixture.submit(job("ada", "a", "ignore-stop")).await;
    let mut watcher = abandoned.watch();
    fixture.work.started(1).await;
    drop(abandoned);
    // Answered after the run was told to stop.
    fixture.get("a").await;
    let claim = fixture.submit(job("bob", "a", "ignore-stop")).await;
    while let Some(job) = watcher.next().await {
        assert!(!job.state.is_final() || job.state == State::Cancelled);
    }
    fixture.work.release("a");
    let end = claim.finished().await;
    assert_eq!((end.state, end.client.as_str()), (State::Succeeded, "bob"));
    assert_eq!(fixture.work.ended(2).await, ["a", "a"]);
}
