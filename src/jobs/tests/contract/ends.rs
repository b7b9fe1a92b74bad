//! How jobs end.

use std::time::Duration;

use verne_jobs::{Counts, Failure, State, Submission, SubmitError};

use crate::stage::{id, job};
use crate::stand::{Open, for_each_backend};

for_each_backend!(
    a_job_succeeds,
    a_job_fails_with_the_works_reason,
    a_panic_fails_its_job_alone,
    what_nobody_can_read_fails_in_the_end,
    a_queued_job_is_cancelled,
    a_running_job_is_cancelled,
    a_finished_job_is_not_cancelled,
    a_job_goes_on_for_the_clients_that_stay,
    the_last_client_leaves_a_part_to_its_whole,
    a_deadline_stops_a_running_job,
    a_deadline_ends_a_queued_job,
    the_latest_deadline_holds,
    a_finished_job_lives_anew,
    a_full_queue_takes_no_more,
    what_was_never_submitted_is_not_there,
);

async fn a_job_succeeds(open: Open) {
    let stand = open(10);
    let claim = stand.submit(job("ada", "a", "pass")).await;
    let end = claim.finished().await;
    assert_eq!((end.state, end.progress, end.attempts, &end.failure), (State::Succeeded, 1.0, 1, &None));
    assert_eq!((end.client.as_str(), end.payload.as_ref()), ("ada", b"a pass".as_slice()));
    let (started, finished) = (end.started.unwrap(), end.finished.unwrap());
    assert!(end.created <= started && started <= finished);
    assert_eq!(stand.get("a").await, end);
    let counts = Counts { started: 1, succeeded: 1, ..Counts::default() };
    assert_eq!(stand.backend.counts(), counts);
}

async fn a_job_fails_with_the_works_reason(open: Open) {
    let stand = open(10);
    let end = stand.submit(job("ada", "a", "fail")).await.finished().await;
    assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::Work("as told".into()))));
    assert_eq!(stand.backend.counts().failed, 1);
}

async fn a_panic_fails_its_job_alone(open: Open) {
    let stand = open(10);
    for (name, verb, message) in [("a", "panic", "as told"), ("b", "panic-inside", "as told, inside")] {
        let end = stand.submit(job("ada", name, verb)).await.finished().await;
        assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::Panicked(message.to_owned()))));
        assert_eq!(stand.get(name).await.state, State::Failed);
    }
    assert_eq!(stand.submit(job("ada", "c", "pass")).await.finished().await.state, State::Succeeded);
}

async fn what_nobody_can_read_fails_in_the_end(open: Open) {
    let stand = open(10);
    let end = stand.submit(job("ada", "a", "foreign")).await.finished().await;
    assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::Work("another version's".into()))));
}

async fn a_queued_job_is_cancelled(open: Open) {
    let stand = open(10);
    stand.leave(job("ada", "running", "hold")).await;
    stand.leave(job("ada", "queued", "pass")).await;
    let cancelled = stand.backend.cancel(id("queued")).await.unwrap().unwrap();
    assert_eq!((cancelled.state, cancelled.attempts), (State::Cancelled, 0));
    stand.stage.open("running");
    assert_eq!(stand.end("running").await.state, State::Succeeded);
    assert_eq!(stand.stage.begun(1).await, ["running"]);
    assert_eq!(stand.get("queued").await, cancelled);
}

async fn a_running_job_is_cancelled(open: Open) {
    let stand = open(10);
    stand.leave(job("ada", "a", "hold")).await;
    stand.leave(job("ada", "b", "pass")).await;
    stand.stage.begun(1).await;
    stand.backend.cancel(id("a")).await.unwrap().unwrap();
    assert_eq!(stand.end("a").await.state, State::Cancelled);
    assert_eq!(stand.end("b").await.state, State::Succeeded);
    assert_eq!(stand.stage.left(2).await, ["a", "b"]);
}

async fn a_finished_job_is_not_cancelled(open: Open) {
    let stand = open(10);
    let end = stand.submit(job("ada", "a", "pass")).await.finished().await;
    assert_eq!(stand.backend.cancel(id("a")).await.unwrap(), Some(end.clone()));
    assert_eq!(stand.get("a").await, end);
}

async fn a_job_goes_on_for_the_clients_that_stay(open: Open) {
    let stand = open(10);
    let leave = async |name, client| stand.backend.leave(id(name), client).await.unwrap().unwrap();
    for client in ["ada", "bob"] {
        stand.leave(job(client, "a", "hold")).await;
    }
    stand.stage.begun(1).await;
    let left = leave("a", "ada").await;
    assert!(left.state == State::Running && !left.clients.contains("ada") && left.clients.contains("bob"));
    for nobody in ["ada", "eve"] {
        assert_eq!(leave("a", nobody).await.state, State::Running, "{nobody}");
    }
    leave("a", "bob").await;
    let end = stand.end("a").await;
    assert!(end.state == State::Cancelled && end.clients.contains("bob"));
    assert_eq!(leave("a", "bob").await, end);
    assert_eq!(stand.get("a").await, end);
    assert_eq!(stand.backend.leave(id("b"), "ada").await.unwrap(), None);
}

async fn the_last_client_leaves_a_part_to_its_whole(open: Open) {
    let stand = open(10);
    stand.leave(job("ada", "whole", "split a=hold")).await;
    stand.stage.begun(1).await;
    stand.leave(job("bob", "a", "hold")).await;
    let left = stand.backend.leave(id("a"), "bob").await.unwrap().unwrap();
    assert!(left.state == State::Running && !left.clients.contains("bob"));
    stand.stage.open("a");
    assert_eq!(stand.end("whole").await.state, State::Succeeded);
}

async fn a_deadline_stops_a_running_job(open: Open) {
    let stand = open(10);
    let hurried = Submission { deadline: Some(Duration::from_millis(500)), ..job("ada", "a", "hold") };
    let end = stand.submit(hurried).await.finished().await;
    assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::DeadlinePassed)));
    assert_eq!(stand.stage.left(1).await, ["a"]);
}

async fn a_deadline_ends_a_queued_job(open: Open) {
    let stand = open(10);
    stand.leave(job("ada", "running", "hold")).await;
    stand.stage.begun(1).await;
    let hurried = Submission { deadline: Some(Duration::from_millis(50)), ..job("ada", "a", "pass") };
    let end = stand.submit(hurried).await.finished().await;
    assert_eq!((end.state, end.failure, end.attempts), (State::Failed, Some(Failure::DeadlinePassed), 0));
    assert_eq!(stand.get("running").await.state, State::Running);
}

async fn the_latest_deadline_holds(open: Open) {
    let stand = open(10);
    let hurried =
        |name, limit| Submission { deadline: Some(Duration::from_millis(limit)), ..job("ada", name, "hold") };
    let patient = stand.submit(hurried("a", 300)).await;
    stand.submit(job("ada", "a", "hold")).await;
    stand.submit(hurried("a", 1)).await;
    let end = stand.submit(hurried("b", 600)).await.finished().await;
    assert_eq!(end.failure, Some(Failure::DeadlinePassed));
    assert_eq!(patient.job().state, State::Running);
}

async fn a_finished_job_lives_anew(open: Open) {
    let stand = open(10);
    let first = stand.submit(job("ada", "a", "fail")).await.finished().await;
    let second = stand.submit(job("bob", "a", "pass")).await.finished().await;
    assert_eq!((second.state, second.failure, second.attempts), (State::Succeeded, None, 1));
    assert!(second.created >= first.finished.unwrap());
    assert_eq!(stand.get("a").await.client, "bob");
}

async fn a_full_queue_takes_no_more(open: Open) {
    let stand = open(2);
    stand.leave(job("ada", "running", "hold")).await;
    stand.stage.begun(1).await;
    let _queued = [stand.submit(job("ada", "a", "pass")).await, stand.submit(job("ada", "b", "pass")).await];
    let refused = stand.backend.submit(job("eve", "c", "pass")).await.unwrap_err();
    let SubmitError::Full { retry_after } = refused else {
        panic!("{refused}");
    };
    assert!(retry_after >= Duration::from_secs(1) && retry_after <= Duration::from_mins(1));
    // What is there already needs no room.
    drop(stand.submit(job("ada", "a", "pass")).await);
    assert_eq!(stand.backend.counts().queued, 2);
    stand.backend.cancel(id("a")).await.unwrap();
    drop(stand.submit(job("eve", "c", "pass")).await);
}

async fn what_was_never_submitted_is_not_there(open: Open) {
    let stand = open(10);
    assert_eq!(stand.backend.get(id("a")).await.unwrap(), None);
    assert_eq!(stand.backend.cancel(id("a")).await.unwrap(), None);
    assert!(stand.backend.watch(id("a")).await.unwrap().is_none());
}
