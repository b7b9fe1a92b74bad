//! Damaged databases and unusable directories.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use rusqlite::Connection;
use tempfile::TempDir;
use verne_jobs::embedded::{Config, OpenError};
use verne_jobs::{Backend, Embedded, State};

use crate::fixture::{Fixture, timed_tests};
use crate::scripted_work::{ScriptedWork, id, job};

timed_tests!(a_damaged_database_is_renamed_and_replaced, a_database_of_a_later_version_is_not_changed,);

fn open(directory: &Path) -> Result<Embedded, OpenError> {
    Embedded::open(Config::in_directory(directory), Arc::new(ScriptedWork::default()))
}

/// A directory with one ended job, closed.
async fn used() -> TempDir {
    let directory = TempDir::new().unwrap();
    let fixture = Fixture::embedded(Config::in_directory(directory.path()));
    fixture.submit(job("ada", "a", "pass")).await.finished().await;
    fixture.backend.drain(Duration::from_secs(10)).await;
    directory
}

fn damage(directory: &Path, number: usize) {
    let path = directory.join("jobs.sqlite3");
    let version: i64 = Connection::open(&path)
        .and_then(|own| own.pragma_query_value(None, "user_version", |row| row.get(0)))
        .unwrap();
    let bytes = match number {
        0 => b"not a database, but long enough to be looked at as one. ".repeat(100),
        // A page in the middle; the header is intact.
        1 => {
            let mut bytes = fs::read(&path).unwrap();
            bytes[4096..8192].fill(0xA5);
            bytes
        }
        // A database of an earlier version.
        2 => {
            Connection::open(&path).unwrap().pragma_update(None, "user_version", 1).unwrap();
            return;
        }
        // Another program's database, without a version, or with the same one by chance.
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

async fn a_damaged_database_is_renamed_and_replaced() {
    let directory = used().await;
    for number in 0..6 {
        damage(directory.path(), number);
        let damaged = fs::read(directory.path().join("jobs.sqlite3")).unwrap();
        let backend = open(directory.path()).unwrap();
        let renamed = backend.damaged_database().unwrap().to_owned();
        assert_eq!(renamed, directory.path().join(format!("jobs.sqlite3.corrupt-{}", number + 1)));
        assert!(fs::read(renamed).unwrap() == damaged);
        assert_eq!(backend.get(id("a")).await.unwrap(), None);
        let end = backend.submit(job("ada", "a", "pass")).await.unwrap().finished().await;
        assert_eq!(end.state, State::Succeeded);
        backend.drain(Duration::from_secs(10)).await;
    }
    let parent = open(directory.path()).unwrap();
    assert_eq!(parent.damaged_database(), None);
    assert_eq!(parent.get(id("a")).await.unwrap().unwrap().state, State::Succeeded);
}

async fn a_database_of_a_later_version_is_not_changed() {
    let directory = used().await;
    let path = directory.path().join("jobs.sqlite3");
    Connection::open(&path).unwrap().pragma_update(None, "user_version", 99).unwrap();
    let before = fs::read(&path).unwrap();
    assert_eq!(open(directory.path()).err(), Some(OpenError::Newer { path: path.clone(), version: 99 }));
    assert!(fs::read(path).unwrap() == before);
}

#[test]
fn an_unusable_directory_is_an_error() {
    let directory = TempDir::new().unwrap();
    let file = directory.path().join("file");
    fs::write(&file, "").unwrap();
    assert!(matches!(open(&file).err(), Some(OpenError::Unusable { .. })));
    assert!(matches!(open(&file.join("below")).err(), Some(OpenError::Unusable { .. })));
    // A directory has the name of the database.
    fs::create_dir(directory.path().join("jobs.sqlite3")).unwrap();
    assert!(matches!(open(directory.path()).err(), Some(OpenError::Unusable { .. })));
}
