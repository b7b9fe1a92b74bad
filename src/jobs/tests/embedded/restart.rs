//! Jobs after the death of a process. The tests copy its directory while it works.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use tempfile::TempDir;
use verne_jobs::embedded::{Config, OpenError};
use verne_jobs::{Embedded, Failure, Retention, State, Submission};

use crate::fixture::{Fixture, timed_tests};
use crate::scripted_work::{ScriptedWork, id, job};

timed_tests!(
    jobs_continue_in_the_next_process,
    a_job_that_kills_processes_fails,
    a_deadline_starts_again_after_a_restart,
    the_latest_deadline_applies_after_a_restart,
    old_ended_jobs_are_deleted,
    a_directory_has_one_process_at_a_time,
);

pub(crate) fn fixture(directory: &Path) -> Fixture {
    Fixture::embedded(Config { max_attempts: 3, ..Config::in_directory(directory) })
}

/// The directory as it would be after `kill -9` at this moment.
pub(crate) fn copy_after_kill(directory: &Path) -> TempDir {
    let copy = TempDir::new().unwrap();
    for file in fs::read_dir(directory).unwrap() {
        let file = file.unwrap();
        fs::copy(file.path(), copy.path().join(file.file_name())).unwrap();
    }
    copy
}

async fn jobs_continue_in_the_next_process() {
    let directory = TempDir::new().unwrap();
    let before = fixture(directory.path());
    let done = before.submit(job("ada", "done", "fail")).await.finished().await;
    let running = before.submit(job("ada", "running", "wait")).await;
    let queued = before.submit(job("ada", "queued", "pass")).await;
    before.work.started(2).await;
    before.submit_detached(job("bob", "running", "wait")).await;
    // Answered after all changes are written.
    assert_eq!(before.get("done").await, done);
    let copy = copy_after_kill(directory.path());
    drop((running, queued));

    let after = fixture(copy.path());
    assert_eq!(after.get("done").await, done);
    assert_eq!(after.work.started(1).await, ["running"]);
    let again = after.get("running").await;
    assert_eq!((again.state, again.attempts), (State::Running, 2));
    after.work.release("running");
    let end = after.wait_for_end("running").await;
    assert_eq!((end.state, end.client.as_str()), (State::Succeeded, "ada"));
    assert!(["ada", "bob"].iter().all(|client| end.clients.contains(client)), "{:?}", end.clients);
    let end = after.wait_for_end("queued").await;
    assert_eq!((end.state, end.attempts, end.client.as_str()), (State::Succeeded, 1, "ada"));
    // A job of this process is newer.
    after.submit(job("eve", "new", "pass")).await.finished().await;
    let page = after.backend.list(verne_jobs::Filter::default()).await.unwrap();
    assert_eq!(page.jobs[0].id, id("new"));
}

async fn a_job_that_kills_processes_fails() {
    let mut directory = TempDir::new().unwrap();
    let first = fixture(directory.path());
    first.submit_detached(job("ada", "poison", "wait")).await;
    first.submit_detached(job("ada", "good", "pass")).await;
    for attempt in 1..=3 {
        let fixture = if attempt == 1 { None } else { Some(fixture(directory.path())) };
        let fixture = fixture.as_ref().unwrap_or(&first);
        assert_eq!(fixture.work.started(1).await, ["poison"]);
        assert_eq!(fixture.get("poison").await.attempts, attempt);
        let copy = copy_after_kill(directory.path());
        drop(std::mem::replace(&mut directory, copy));
    }
    let last = fixture(directory.path());
    let end = last.get("poison").await;
    assert_eq!((end.state, end.failure), (State::Failed, Some(Failure::TooManyAttempts)));
    assert_eq!(last.wait_for_end("good").await.state, State::Succeeded);
    assert_eq!(last.work.started(1).await, ["good"]);
}

async fn a_deadline_starts_again_after_a_restart() {
    let directory = TempDir::new().unwrap();
    let before = fixture(directory.path());
    before.submit_detached(job("ada", "running", "wait")).await;
    let urgent = Submission { deadline: Some(Duration::from_secs(2)), ..job("ada", "a", "pass") };
    before.submit_detached(urgent).await;
    let copy = copy_after_kill(directory.path());
    assert_eq!(before.wait_for_end("a").await.failure, Some(Failure::DeadlinePassed));
    let after = fixture(copy.path());
    assert_eq!(after.wait_for_end("a").await.failure, Some(Failure::DeadlinePassed));
}

async fn the_latest_deadline_applies_after_a_restart() {
    let directory = TempDir::new().unwrap();
    let before = fixture(directory.path());
    before.submit_detached(job("ada", "running", "wait")).await;
    let urgent = |name, seconds| Submission {
        deadline: Some(Duration::from_secs(seconds)),
        ..job("ada", name, "pass")
    };
    before.submit_detached(urgent("patient", 1)).await;
    before.submit_detached(job("bob", "patient", "pass")).await;
    before.submit_detached(urgent("a", 2)).await;
    let after_copy = copy_after_kill(directory.path());
    let after = fixture(after_copy.path());
    assert_eq!(after.wait_for_end("a").await.failure, Some(Failure::DeadlinePassed));
    assert_eq!(after.get("patient").await.state, State::Queued);
}

async fn old_ended_jobs_are_deleted() {
    let retention = Retention { count: 2, age: Duration::from_mins(10) };
    let few = Fixture::embedded(Config { retention, ..Config::default() });
    for name in ["a", "b", "c"] {
        few.submit(job("ada", name, "pass")).await.finished().await;
    }
    let page = few.backend.list(verne_jobs::Filter { limit: 9, ..Default::default() }).await.unwrap();
    assert_eq!(page.jobs.iter().map(|job| job.id).collect::<Vec<_>>(), [id("c"), id("b")]);
    assert_eq!(few.backend.get(id("a")).await.unwrap(), None);

    let retention = Retention { count: 9, age: Duration::ZERO };
    let short = Fixture::embedded(Config { retention, ..Config::default() });
    short.submit(job("ada", "a", "pass")).await.finished().await;
    short.submit(job("ada", "b", "pass")).await.finished().await;
    short.submit_detached(job("ada", "running", "wait")).await;
    let page = short.backend.list(verne_jobs::Filter { limit: 9, ..Default::default() }).await.unwrap();
    assert!(page.jobs.iter().all(|job| job.id != id("a")));
    assert_eq!(page.jobs[0].id, id("running"));
}

async fn a_directory_has_one_process_at_a_time() {
    let directory = TempDir::new().unwrap();
    let first = fixture(directory.path());
    let second = Embedded::open(Config::in_directory(directory.path()), Arc::new(ScriptedWork::default()));
    let in_use = OpenError::InUse { directory: directory.path().to_owned() };
    assert_eq!(second.err(), Some(in_use));
    first.backend.drain(Duration::from_secs(10)).await;
    assert!(
        Embedded::open(Config::in_directory(directory.path()), Arc::new(ScriptedWork::default())).is_ok()
    );
}
