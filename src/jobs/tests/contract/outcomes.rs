//! How jobs end.

use std::time::Duration;

use verne_jobs::{Counts, Failure, State, Submission, SubmitError};

use crate::fixture::{Open, for_each_backend};
use crate::scripted_work::{id, job};

for_each_backend!(
    a_job_succeeds,
    a_job_fails_with_the_reason_of_its_work,
    a_panic_fails_only_its_own_job,
    a_job_that_no_process_can_run_fails,
    a_queued_job_is_cancelled,
    a_running_job_is_cancelled,
    an_ended_job_is_not_cancelled,
    a_job_continues_until_its_last_client_leaves,
    a_subtask_continues_for_its_parent_when_its_last_client_leaves,
    a_deadline_stops_a_running_job,
    a_deadline_ends_a_queued_job,
    the_latest_deadline_applies,
    an_ended_job_can_be_submitted_again,
    a_full_queue_rejects_submissions,
    an_unknown_job_is_not_found,
);

async fn a_job_succeeds(open: Open) {
    let fixture = open(10);
    let claim = fixture.submit(job("ada", "a", "pass")).await;
    let end = claim.finished().await;
    assert_eq!((end.state, end.progress, end.attempts, &end.failure), (State::Succeeded, 1.0, 1, &None));
    assert_eq!((end.client.as_str(), end.payload.as_ref()), ("ada", b"a pass".as_slice()));
    let (started, finished) = (end.started.unwrap(), end.finished.unwrap());
    assert!(end.created <= started && started <= finished);
    assert_eq!(fixture.get("a").await, end);
    let counts = Counts { started: 1, succeeded: 1, ..Counts::default() };
    assert_eq!(fixture.backend.counts(), counts);
}

async fn a_job_fails_with_the_reason_of_its_work(open: Open) {
    let fixture = open(10);
    let end = fixture.submit(job("ada", "a", "fail")).await.finished().await;
    assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::Work("as told".into()))));
    assert_eq!(fixture.backend.counts().failed, 1);
}

async fn a_panic_fails_only_its_own_job(open: Open) {
    let fixture = open(10);
    for (name, verb, message) in [("a", "panic", "as told"), ("b", "panic-inside", "as told, inside")] {
        let end = fixture.submit(job("ada", name, verb)).await.finished().await;
        assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::Panicked(message.to_owned()))));
        assert_eq!(fixture.get(name).await.state, State::Failed);
    }
    assert_eq!(fixture.submit(job("ada", "c", "pass")).await.finished().await.state, State::Succeeded);
}

async fn a_job_that_no_process_can_run_fails(open: Open) {
    let fixture = open(10);
    let end = fixture.submit(job("ada", "a", "other-version")).await.finished().await;
    assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::Work("another version's".into()))));
}

async fn a_queued_job_is_cancelled(open: Open) {
    let fixture = open(10);
    fixture.submit_detached(job("ada", "running", "wait")).await;
    fixture.submit_detached(job("ada", "queued", "pass")).await;
    let cancelled = fixture.backend.cancel(id("queued")).await.unwrap().unwrap();
    assert_eq!((cancelled.state, cancelled.attempts), (State::Cancelled, 0));
    fixture.work.release("running");
    assert_eq!(fixture.wait_for_end("running").await.state, State::Succeeded);
    assert_eq!(fixture.work.started(1).await, ["running"]);
    assert_eq!(fixture.get("queued").await, cancelled);
}

async fn a_running_job_is_cancelled(open: Open) {
    let fixture = open(10);
    fixture.submit_detached(job("ada", "a", "wait")).await;
    fixture.submit_detached(job("ada", "b", "pass")).await;
    fixture.work.started(1).await;
    fixture.backend.cancel(id("a")).await.unwrap().unwrap();
    assert_eq!(fixture.wait_for_end("a").await.state, State::Cancelled);
    assert_eq!(fixture.wait_for_end("b").await.state, State::Succeeded);
    assert_eq!(fixture.work.ended(2).await, ["a", "b"]);
}

async fn an_ended_job_is_not_cancelled(open: Open) {
    let fixture = open(10);
    let end = fixture.submit(job("ada", "a", "pass")).await.finished().await;
    assert_eq!(fixture.backend.cancel(id("a")).await.unwrap(), Some(end.clone()));
    assert_eq!(fixture.get("a").await, end);
}

async fn a_job_continues_until_its_last_client_leaves(open: Open) {
    let fixture = open(10);
    let leave = async |name, client| fixture.backend.leave(id(name), client).await.unwrap().unwrap();
    for client in ["ada", "bob"] {
        fixture.submit_detached(job(client, "a", "wait")).await;
    }
    fixture.work.started(1).await;
    let left = leave("a", "ada").await;
    assert!(left.state == State::Running && !left.clients.contains("ada") && left.clients.contains("bob"));
    for other in ["ada", "eve"] {
        assert_eq!(leave("a", other).await.state, State::Running, "{other}");
    }
    leave("a", "bob").await;
    let end = fixture.wait_for_end("a").await;
    assert!(end.state == State::Cancelled && end.clients.contains("bob"));
    assert_eq!(leave("a", "bob").await, end);
    assert_eq!(fixture.get("a").await, end);
    assert_eq!(fixture.backend.leave(id("b"), "ada").await.unwrap(), None);
}

async fn a_subtask_continues_for_its_parent_when_its_last_client_leaves(open: Open) {
    let fixture = open(10);
    fixture.submit_detached(job("ada", "parent", "split a=wait")).await;
    fixture.work.started(1).await;
    fixture.submit_detached(job("bob", "a", "wait")).await;
    let left = fixture.backend.leave(id("a"), "bob").await.unwrap().unwrap();
    assert!(left.state == State::Running && !left.clients.contains("bob"));
    fixture.work.release("a");
    assert_eq!(fixture.wait_for_end("parent").await.state, State::Succeeded);
}

async fn a_deadline_stops_a_running_job(open: Open) {
    let fixture = open(10);
    let urgent = Submission { deadline: Some(Duration::from_millis(500)), ..job("ada", "a", "wait") };
    let end = fixture.submit(urgent).await.finished().await;
    assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::DeadlinePassed)));
    assert_eq!(fixture.work.ended(1).await, ["a"]);
}

async fn a_deadline_ends_a_queued_job(open: Open) {
    let fixture = open(10);
    fixture.submit_detached(job("ada", "running", "wait")).await;
    fixture.work.started(1).await;
    let urgent = Submission { deadline: Some(Duration::from_millis(50)), ..job("ada", "a", "pass") };
    let end = fixture.submit(urgent).await.finished().await;
    assert_eq!((end.state, end.failure, end.attempts), (State::Failed, Some(Failure::DeadlinePassed), 0));
    assert_eq!(fixture.get("running").await.state, State::Running);
}

async fn the_latest_deadline_applies(open: Open) {
    let fixture = open(10);
    let urgent =
        |name, limit| Submission { deadline: Some(Duration::from_millis(limit)), ..job("ada", name, "wait") };
    let without_deadline = fixture.submit(urgent("a", 300)).await;
    fixture.submit(job("ada", "a", "wait")).await;
    fixture.submit(urgent("a", 1)).await;
    let end = fixture.submit(urgent("b", 600)).await.finished().await;
    assert_eq!(end.failure, Some(Failure::DeadlinePassed));
    assert_eq!(without_deadline.job().state, State::Running);
}

async fn an_ended_job_can_be_submitted_again(open: Open) {
    let fixture = open(10);
    let first = fixture.submit(job("ada", "a", "fail")).await.finished().await;
    let second = fixture.submit(job("bob", "a", "pass")).await.finished().await;
    assert_eq!((second.state, second.failure, second.attempts), (State::Succeeded, None, 1));
    assert!(second.created >= first.finished.unwrap());
    assert_eq!(fixture.get("a").await.client, "bob");
}

async fn a_full_queue_rejects_submissions(open: Open) {
    let fixture = open(2);
    fixture.submit_detached(job("ada", "running", "wait")).await;
    fixture.work.started(1).await;
    let _queued =
        [fixture.submit(job("ada", "a", "pass")).await, fixture.submit(job("ada", "b", "pass")).await];
    let refused = fixture.backend.submit(job("eve", "c", "pass")).await.unwrap_err();
    let SubmitError::Full { retry_after } = refused else {
        panic!("{refused}");
    };
    assert!(retry_after >= Duration::from_secs(1) && retry_after <= Duration::from_mins(1));
    // A job that is queued already needs no room.
    drop(fixture.submit(job("ada", "a", "pass")).await);
    assert_eq!(fixture.backend.counts().queued, 2);
    fixture.backend.cancel(id("a")).await.unwrap();
    drop(fixture.submit(job("eve", "c", "pass")).await);
}

async fn an_unknown_job_is_not_found(open: Open) {
    let fixture = open(10);
    assert_eq!(fixture.backend.get(id("a")).await.unwrap(), None);
    assert_eq!(fixture.backend.cancel(id("a")).await.unwrap(), None);
    assert!(fixture.backend.watch(id("a")).await.unwrap().is_none());
}
