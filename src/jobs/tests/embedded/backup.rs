//! Other programs read the database while a process has it open, and files that are removed meanwhile.

use std::fs;
use std::path::Path;
use std::time::Duration;

use rusqlite::Connection;
use tempfile::TempDir;
use verne_jobs::embedded::Config;
use verne_jobs::{State, SubmitError, Unavailable};

use crate::stage::job;
use crate::stand::{Stand, within_a_minute};

fn stand(directory: &Path) -> Stand {
    Stand::at(Config::in_directory(directory))
}

/// What the `sqlite3` program reads and copies.
#[tokio::test(flavor = "multi_thread")]
async fn jobs_are_backed_up_while_they_run() {
    within_a_minute(async {
        let (directory, copy) = (TempDir::new().unwrap(), TempDir::new().unwrap());
        let before = stand(directory.path());
        let done = before.submit(job("ada", "done", "pass")).await.finished().await;
        before.leave(job("ada", "running", "hold")).await;
        before.stage.begun(2).await;
        // Answered after all that was to be written.
        assert_eq!(before.get("done").await, done);
        let other = Connection::open(directory.path().join("jobs.sqlite3")).unwrap();
        let target = copy.path().join("jobs.sqlite3");
        other.execute("VACUUM INTO ?1", [target.to_str().unwrap()]).unwrap();
        drop(other);
        before.stage.open("running");
        assert_eq!(before.end("running").await.state, State::Succeeded);
        before.backend.drain(Duration::from_secs(10)).await;

        let restored = stand(copy.path());
        assert_eq!(restored.get("done").await, done);
        assert_eq!(restored.stage.begun(1).await, ["running"]);
        restored.stage.open("running");
        assert_eq!(restored.end("running").await.state, State::Succeeded);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_database_that_is_removed_or_replaced_takes_no_jobs() {
    within_a_minute(async {
        for file in ["jobs.sqlite3", "jobs.sqlite3-wal"] {
            let directory = TempDir::new().unwrap();
            let file = directory.path().join(file);
            let aside = directory.path().join("aside");
            let open = stand(directory.path());
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
    })
    .await;
}

async fn assert_lost(open: &Stand, name: &str) {
    // Before somebody submits a job, and after.
    for _ in 0..2 {
        let Err(Unavailable(fault)) = open.backend.reachable().await else { panic!("{name}: not told") };
        assert!(fault.contains("jobs.sqlite3"), "{fault}");
        let refused = open.backend.submit(job("ada", name, "pass")).await.map(drop).unwrap_err();
        assert!(matches!(refused, SubmitError::Unavailable(_)), "{refused}");
    }
}
