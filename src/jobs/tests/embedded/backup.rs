//! Other programs copy, remove or replace the database while a process has it open.

use std::fs;
use std::path::Path;
use std::time::Duration;

use rusqlite::Connection;
use tempfile::TempDir;
use verne_jobs::embedded::Config;
use verne_jobs::{State, SubmitError, UnavailableError};

use crate::fixture::{Fixture, timed_tests};
use crate::scripted_work::job;

timed_tests!(a_database_can_be_copied_while_jobs_run, a_removed_or_replaced_database_rejects_submissions,);

fn fixture(directory: &Path) -> Fixture {
    Fixture::embedded(Config::in_directory(directory))
}

/// As `sqlite3` does.
async fn a_database_can_be_copied_while_jobs_run() {
    let (directory, copy) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    let before = fixture(directory.path());
    let done = before.submit(job("ada", "done", "pass")).await.finished().await;
    before.submit_detached(job("ada", "running", "wait")).await;
    before.work.started(2).await;
    // Answered after all changes are written.
    assert_eq!(before.get("done").await, done);
    let other = Connection::open(directory.path().join("jobs.sqlite3")).unwrap();
    let target = copy.path().join("jobs.sqlite3");
    other.execute("VACUUM INTO ?1", [target.to_str().unwrap()]).unwrap();
    drop(other);
    before.work.release("running");
    assert_eq!(before.wait_for_end("running").await.state, State::Succeeded);
    before.backend.drain(Duration::from_secs(10)).await;

    let restored = fixture(copy.path());
    assert_eq!(restored.get("done").await, done);
    assert_eq!(restored.work.started(1).await, ["running"]);
    restored.work.release("running");
    assert_eq!(restored.wait_for_end("running").await.state, State::Succeeded);
}

async fn a_removed_or_replaced_database_rejects_submissions() {
    for file in ["jobs.sqlite3", "jobs.sqlite3-wal"] {
        let directory = TempDir::new().unwrap();
        let file = directory.path().join(file);
        let aside = directory.path().join("aside");
        let open = fixture(directory.path());
        open.submit(job("ada", "before", "pass")).await.finished().await;
        assert_eq!(open.backend.reachable().await, Ok(()));

        fs::rename(&file, &aside).unwrap();
        assert_lost(&open, "removed").await;
        fs::copy(&aside, &file).unwrap();
        assert_lost(&open, "replaced").await;
        fs::rename(&aside, &file).unwrap();
        assert_eq!(open.backend.reachable().await, Ok(()), "it is in its place again");
        open.submit(job("ada", "after", "pass")).await.finished().await;
    }
}

async fn assert_lost(open: &Fixture, name: &str) {
    // Before a submission, and after.
    for _ in 0..2 {
        let Err(UnavailableError(error)) = open.backend.reachable().await else {
            panic!("{name}: not reported")
        };
        assert!(error.contains("jobs.sqlite3"), "{error}");
        let refused = open.backend.submit(job("ada", name, "pass")).await.map(drop).unwrap_err();
        assert!(matches!(refused, SubmitError::Unavailable(_)), "{refused}");
    }
}
