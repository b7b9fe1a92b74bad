//! A directory of the test's own, and what lies in it.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

use bytes::Bytes;
use object_store::local::LocalFileSystem;
use rusqlite::Connection;
use tempfile::TempDir;
use verne_store::{Config, Key, Store};

use crate::objects::Objects;

/// What the object of a content of one chunk is longer than the content.
pub(crate) const HEADER: u64 = 148;

/// The same of no content.
pub(crate) const EMPTY: u64 = 116;

/// Memory for every content of a test that does not ask for less.
const MEMORY: u64 = 64 << 20;

pub(crate) struct Place {
    root: TempDir,
}

impl Place {
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
        self.open_bounded(1 << 30).await
    }

    pub(crate) async fn open_bounded(&self, disk_bytes: u64) -> Store {
        Store::open(&self.config(disk_bytes)).await.unwrap()
    }

    /// A store whose memory holds nothing: every read goes to the disk, unless somebody holds the content.
    pub(crate) async fn open_without_memory(&self) -> Store {
        Store::open(&Config { memory_bytes: 0, ..self.config(1 << 30) }).await.unwrap()
    }

    /// The directory's objects, behind a layer that the test commands.
    pub(crate) fn objects(&self) -> Arc<Objects> {
        let root = self.path().join("objects");
        fs::create_dir_all(&root).unwrap();
        Objects::over(LocalFileSystem::new_with_prefix(root).unwrap())
    }

    /// A store over such objects, with no memory.
    pub(crate) async fn open_over(&self, objects: &Arc<Objects>, disk_bytes: u64) -> Store {
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

    /// How many rows the index has.
    pub(crate) fn rows(&self) -> u32 {
        let index = Connection::open(self.path().join("index.sqlite3")).unwrap();
        index.query_row("SELECT count(*) FROM objects", [], |row| row.get(0)).unwrap()
    }
}

pub(crate) fn key(number: u8) -> Key {
    Key::from([number; 32])
}

/// So many bytes that are not those of another number.
pub(crate) fn bytes(number: u8, length: usize) -> Bytes {
    let mut all = (0..251).map(|byte| byte ^ number).collect::<Vec<u8>>().repeat(length / 251 + 1);
    all.truncate(length);
    all.into()
}
