//! Directories that are not as they should be.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use rusqlite::Connection;
use tempfile::TempDir;
use verne_jobs::embedded::{Config, OpenError};
use verne_jobs::{Backend, Embedded, State};

use crate::stage::{Stage, id, job};
use crate::stand::{Stand, within_a_minute};

fn open(directory: &Path) -> Result<Embedded, OpenError> {
    Embedded::open(Config::in_directory(directory), Arc::new(Stage::default()))
}

/// A directory with one finished job, and closed.
async fn used() -> TempDir {
    let directory = TempDir::new().unwrap();
    let stand = Stand::at(Config::in_directory(directory.path()));
    stand.submit(job("ada", "a", "pass")).await.finished().await;
    stand.backend.drain(Duration::from_secs(10)).await;
    directory
}

fn damage(directory: &Path, number: usize) {
    let path = directory.join("jobs.sqlite3");
    let version: i64 = Connection::open(&path)
        .and_then(|own| own.pragma_query_value(None, "user_version", |row| row.get(0)))
        .unwrap();
    let bytes = match number {
        0 => b"not a database, but long enough to be looked at as one. ".repeat(100),
        // A page in the middle, the header whole.
        1 => {
            let mut bytes = fs::read(&path).unwrap();
            bytes[4096..8192].fill(0xA5);
            bytes
        }
        // An earlier version's.
        2 => {
            Connection::open(&path).unwrap().pragma_update(None, "user_version", 1).unwrap();
            return;
        }
        // Another program's database, with no version, and with one that is the same by chance.
        number => {
            fs::remove_file(&path).unwrap();
            let tables = [
                "CREATE TABLE jobs (id TEXT)",
                "CREATE TABLE jobs (id TEXT)",
                "CREATE TABLE other (id TEXT)",
            ];
            let other = Connection::open(&path).unwrap();
            other.execute_batch(tables[number - 3]).unwrap();
            if number > 3 {
                other.pragma_update(None, "user_version", version).unwrap();
            }
            return;
        }
    };
    fs::write(path, bytes).unwrap();
}

#[tokio::test(flavor = "multi_thread")]
async fn a_damaged_database_is_set_aside() {
    within_a_minute(async {
        let directory = used().await;
        for number in 0..6 {
            damage(directory.path(), number);
            let damaged = fs::read(directory.path().join("jobs.sqlite3")).unwrap();
            let backend = open(directory.path()).unwrap();
            let set_aside = backend.set_aside().unwrap().to_owned();
            assert_eq!(set_aside, directory.path().join(format!("jobs.sqlite3.corrupt-{}", number + 1)));
            assert!(fs::read(set_aside).unwrap() == damaged);
            assert_eq!(backend.get(id("a")).await.unwrap(), None);
            let end = backend.submit(job("ada", "a", "pass")).await.unwrap().finished().await;
            assert_eq!(end.state, State::Succeeded);
            backend.drain(Duration::from_secs(10)).await;
        }
        let whole = open(directory.path()).unwrap();
        assert_eq!(whole.set_aside(), None);
        assert_eq!(whole.get(id("a")).await.unwrap().unwrap().state, State::Succeeded);
    })
    .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_later_versions_database_is_left_alone() {
    let directory = used().await;
    let path = directory.path().join("jobs.sqlite3");
    Connection::open(&path).unwrap().pragma_update(None, "user_version", 99).unwrap();
    let before = fs::read(&path).unwrap();
    assert_eq!(open(directory.path()).err(), Some(OpenError::Newer { path: path.clone(), version: 99 }));
    assert!(fs::read(path).unwrap() == before);
}

#[test]
fn a_directory_that_cannot_be_written_is_told() {
    let directory = TempDir::new().unwrap();
    let file = directory.path().join("file");
    fs::write(&file, "").unwrap();
    assert!(matches!(open(&file).err(), Some(OpenError::Unusable { .. })));
    assert!(matches!(open(&file.join("below")).err(), Some(OpenError::Unusable { .. })));
    // The database's name is taken by what is no file.
    fs::create_dir(directory.path().join("jobs.sqlite3")).unwrap();
    assert!(matches!(open(directory.path()).err(), Some(OpenError::Unusable { .. })));
}
