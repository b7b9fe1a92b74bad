//! A directory for one test, and its files.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use bytes::Bytes;
use object_store::local::LocalFileSystem;
use rusqlite::Connection;
use tempfile::TempDir;
use verne_store::{Config, Key, Store};

use crate::controlled_objects::ControlledObjects;

/// The size of the header of an object with one chunk.
pub(crate) const HEADER: u64 = 148;

/// The size of the header of an object with an empty content.
pub(crate) const EMPTY: u64 = 116;

/// Memory for every content of most tests.
const MEMORY: u64 = 64 << 20;

pub(crate) struct TestDirectory {
    root: TempDir,
}

impl TestDirectory {
    pub(crate) fn new() -> Self {
        Self { root: tempfile::tempdir().unwrap() }
    }

    pub(crate) fn path(&self) -> PathBuf {
        self.root.path().join("results")
    }

    pub(crate) fn config(&self, disk_bytes: u64) -> Config {
        Config { directory: Some(self.path()), memory_bytes: MEMORY, disk_bytes }
    }

    /// A store with room for everything.
    pub(crate) async fn open(&self) -> Store {
        self.open_with_limit(1 << 30).await
    }

    pub(crate) async fn open_with_limit(&self, disk_bytes: u64) -> Store {
        Store::open(&self.config(disk_bytes)).await.unwrap()
    }

    /// A store without a memory cache: every read goes to the disk, unless the test holds the content.
    pub(crate) async fn open_without_memory(&self) -> Store {
        Store::open(&Config { memory_bytes: 0, ..self.config(1 << 30) }).await.unwrap()
    }

    /// The directory's objects, as the test controls them.
    pub(crate) fn objects(&self) -> Arc<ControlledObjects> {
        let root = self.path().join("objects");
        fs::create_dir_all(&root).unwrap();
        ControlledObjects::over(LocalFileSystem::new_with_prefix(root).unwrap())
    }

    /// A store of such objects without a memory cache.
    pub(crate) async fn open_over(&self, objects: &Arc<ControlledObjects>, disk_bytes: u64) -> Store {
        Store::open_over(Arc::clone(objects) as _, &self.path(), 0, disk_bytes).await.unwrap()
    }

    /// The file of a key's object.
    pub(crate) fn file(&self, key: Key) -> PathBuf {
        let digits = key.to_string();
        self.path().join("objects").join(&digits[..2]).join(&digits[2..])
    }

    /// Runs a statement on the index.
    pub(crate) fn sql(&self, statement: &str) {
        Connection::open(self.path().join("index.sqlite3")).unwrap().execute_batch(statement).unwrap();
    }

    /// The number of rows of the index.
    pub(crate) fn rows(&self) -> u32 {
        let index = Connection::open(self.path().join("index.sqlite3")).unwrap();
        index.query_row("SELECT count(*) FROM objects", [], |row| row.get(0)).unwrap()
    }
}

pub(crate) fn key(number: u8) -> Key {
    Key::from([number; 32])
}

/// Bytes that differ from those of every other number.
pub(crate) fn bytes(number: u8, length: usize) -> Bytes {
    let mut all = (0..251).map(|byte| byte ^ number).collect::<Vec<u8>>().repeat(length / 251 + 1);
    all.truncate(length);
    all.into()
}
