//! What the next process finds. A process that dies is its directory, copied while it was at work.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use tempfile::TempDir;
use verne_jobs::embedded::{Config, OpenError, Retention};
use verne_jobs::{Embedded, Failure, State, Submission};

use crate::stage::{Stage, id, job};
use crate::stand::{Stand, within_a_minute};

pub(crate) fn stand(directory: &Path) -> Stand {
    Stand::at(Config { max_attempts: 3, ..Config::in_directory(directory) })
}

/// The directory as it would be after `kill -9` at this moment.
pub(crate) fn killed(directory: &Path) -> TempDir {
    let copy = TempDir::new().unwrap();
    for file in fs::read_dir(directory).unwrap() {
        let file = file.unwrap();
        fs::copy(file.path(), copy.path().join(file.file_name())).unwrap();
    }
    copy
}

#[tokio::test(flavor = "multi_thread")]
async fn jobs_outlive_their_process() {
    within_a_minute(async {
        let directory = TempDir::new().unwrap();
        let before = stand(directory.path());
        let done = before.submit(job("ada", "done", "fail")).await.finished().await;
        let running = before.submit(job("ada", "running", "hold")).await;
        let queued = before.submit(job("ada", "queued", "pass")).await;
        before.stage.begun(2).await;
        before.leave(job("bob", "running", "hold")).await;
        // Answered after all that was to be written.
        assert_eq!(before.get("done").await, done);
        let copy = killed(directory.path());
        drop((running, queued));

        let after = stand(copy.path());
        assert_eq!(after.get("done").await, done);
        assert_eq!(after.stage.begun(1).await, ["running"]);
        let again = after.get("running").await;
        assert_eq!((again.state, again.attempts), (State::Running, 2));
        after.stage.open("running");
        let end = after.end("running").await;
        assert_eq!((end.state, end.client.as_str()), (State::Succeeded, "ada"));
        assert!(["ada", "bob"].iter().all(|client| end.clients.contains(client)), "{:?}", end.clients);
        let end = after.end("queued").await;
        assert_eq!((end.state, end.attempts, end.client.as_str()), (State::Succeeded, 1, "ada"));
        // What is new is the newest.
        after.submit(job("eve", "new", "pass")).await.finished().await;
        let page = after.backend.list(verne_jobs::Filter::default()).await.unwrap();
        assert_eq!(page.jobs[0].id, id("new"));
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_at_which_processes_die_is_given_up() {
    within_a_minute(async {
        let mut directory = TempDir::new().unwrap();
        let first = stand(directory.path());
        first.leave(job("ada", "poison", "hold")).await;
        first.leave(job("ada", "good", "pass")).await;
        for attempt in 1..=3 {
            let stand = if attempt == 1 { None } else { Some(stand(directory.path())) };
            let stand = stand.as_ref().unwrap_or(&first);
            assert_eq!(stand.stage.begun(1).await, ["poison"]);
            assert_eq!(stand.get("poison").await.attempts, attempt);
            let copy = killed(directory.path());
            drop(std::mem::replace(&mut directory, copy));
        }
        let last = stand(directory.path());
        let end = last.get("poison").await;
        assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::TooManyAttempts)));
        assert_eq!(last.end("good").await.state, State::Succeeded);
        assert_eq!(last.stage.begun(1).await, ["good"]);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_deadline_counts_anew() {
    within_a_minute(async {
        let directory = TempDir::new().unwrap();
        let before = stand(directory.path());
        before.leave(job("ada", "running", "hold")).await;
        let hurried = Submission { deadline: Some(Duration::from_secs(2)), ..job("ada", "a", "pass") };
        before.leave(hurried).await;
        let copy = killed(directory.path());
        assert_eq!(before.end("a").await.failure, Some(Failure::DeadlinePassed));
        let after = stand(copy.path());
        assert_eq!(after.end("a").await.failure, Some(Failure::DeadlinePassed));
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_latest_deadline_holds_after_a_restart() {
    within_a_minute(async {
        let directory = TempDir::new().unwrap();
        let before = stand(directory.path());
        before.leave(job("ada", "running", "hold")).await;
        let hurried = |name, seconds| Submission {
            deadline: Some(Duration::from_secs(seconds)),
            ..job("ada", name, "pass")
        };
        before.leave(hurried("patient", 1)).await;
        before.leave(job("bob", "patient", "pass")).await;
        before.leave(hurried("a", 2)).await;
        let after_copy = killed(directory.path());
        let after = stand(after_copy.path());
        assert_eq!(after.end("a").await.failure, Some(Failure::DeadlinePassed));
        assert_eq!(after.get("patient").await.state, State::Queued);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn finished_jobs_are_forgotten() {
    within_a_minute(async {
        let retention = Retention { count: 2, age: Duration::from_mins(10) };
        let few = Stand::at(Config { retention, ..Config::default() });
        for name in ["a", "b", "c"] {
            few.submit(job("ada", name, "pass")).await.finished().await;
        }
        let page = few.backend.list(verne_jobs::Filter { limit: 9, ..Default::default() }).await.unwrap();
        assert_eq!(page.jobs.iter().map(|job| job.id).collect::<Vec<_>>(), [id("c"), id("b")]);
        assert_eq!(few.backend.get(id("a")).await.unwrap(), None);

        let retention = Retention { count: 9, age: Duration::ZERO };
        let short = Stand::at(Config { retention, ..Config::default() });
        short.submit(job("ada", "a", "pass")).await.finished().await;
        short.submit(job("ada", "b", "pass")).await.finished().await;
        short.leave(job("ada", "running", "hold")).await;
        let page = short.backend.list(verne_jobs::Filter { limit: 9, ..Default::default() }).await.unwrap();
        assert!(page.jobs.iter().all(|job| job.id != id("a")));
        assert_eq!(page.jobs[0].id, id("running"));
    })
    .await;
}

#[tokio::test]
async fn one_process_at_a_time() {
    let directory = TempDir::new().unwrap();
    let first = stand(directory.path());
    let second = Embedded::open(Config::in_directory(directory.path()), Arc::new(Stage::default()));
    let in_use = OpenError::InUse { directory: directory.path().to_owned() };
    assert_eq!(second.err(), Some(in_use));
    first.backend.drain(Duration::from_secs(10)).await;
    assert!(Embedded::open(Config::in_directory(directory.path()), Arc::new(Stage::default())).is_ok());
}
