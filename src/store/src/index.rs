//! The index of the objects on disk: the size and the last use of each, in SQLite.
//!
//! Every call blocks. A use is a number from a counter that only grows, not a time: a clock may be set back.

use std::collections::HashMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::{fs, io};

use rusqlite::{Connection, OptionalExtension, params};

use crate::key::Key;

const VERSION: i64 = 1;

const SCHEMA: &str = "
    CREATE TABLE objects (key BLOB PRIMARY KEY, size INTEGER NOT NULL, used INTEGER NOT NULL)
        STRICT, WITHOUT ROWID;
    CREATE INDEX objects_by_use ON objects (used);
    PRAGMA user_version = 1;";

pub(crate) struct Index {
    connection: Connection,
    /// Sum of the sizes of all objects.
    bytes: u64,
}

/// An index and its rows when it was opened.
pub(crate) struct OpenedIndex {
    pub(crate) index: Index,
    /// The size of each object.
    pub(crate) sizes: HashMap<Key, u64>,
    /// Greater than every recorded use.
    pub(crate) next_use: u64,
}

impl Index {
    /// Opens the index of a directory, or creates it. Renames a damaged index and creates a new one: the objects state
    /// the same.
    pub(crate) fn open(directory: &Path) -> Result<OpenedIndex, Box<dyn Error + Send + Sync>> {
        let path = directory.join("index.sqlite3");
        match Self::read(&path) {
            Ok(Some(opened)) => return Ok(opened),
            Err(error) if !is_damage(&error) => return Err(error.into()),
            Ok(None) => tracing::warn!("the index is invalid or of another version: creating a new one"),
            Err(error) => tracing::warn!(%error, "the index is damaged: creating a new one"),
        }
        rename_damaged(&path)?;
        Self::read(&path)?.ok_or_else(|| "a new index is invalid".into())
    }

    /// `None` if the file is not a valid index of this version.
    fn read(path: &Path) -> rusqlite::Result<Option<OpenedIndex>> {
        let Some(connection) = connect(path)? else { return Ok(None) };
        let mut sizes = HashMap::new();
        let (mut bytes, mut next_use) = (0_u64, 0);
        {
            let mut rows = connection.prepare("SELECT key, size, used FROM objects")?;
            let mut rows = rows.query([])?;
            while let Some(row) = rows.next()? {
                let size = row.get::<_, i64>(1)?.cast_unsigned();
                let Some(sum) = bytes.checked_add(size) else { return Ok(None) };
                bytes = sum;
                sizes.insert(Key::from(row.get::<_, [u8; 32]>(0)?), size);
                next_use = next_use.max(row.get::<_, i64>(2)?.cast_unsigned().saturating_add(1));
            }
        }
        Ok(Some(OpenedIndex { index: Self { connection, bytes }, sizes, next_use }))
    }

    /// Sum of the sizes of all objects.
    pub(crate) fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Enters an object and its first use.
    pub(crate) fn insert(&mut self, key: Key, size: u64, used: u64) -> rusqlite::Result<()> {
        self.change(|changes| changes.insert(key, size, used))
    }

    /// Records the last uses of objects.
    pub(crate) fn record_uses(&mut self, uses: &[(Key, u64)]) -> rusqlite::Result<()> {
        self.change(|changes| changes.record_uses(uses))
    }

    /// Deletes the rows of objects.
    pub(crate) fn remove(&mut self, keys: &[Key]) -> rusqlite::Result<()> {
        self.change(|changes| keys.iter().try_for_each(|key| changes.remove(key)))
    }

    /// Deletes wrong rows and enters the objects that were found, in the order of their use.
    pub(crate) fn replace(
        &mut self,
        wrong: &[Key],
        found: &[(Key, u64)],
        first_use: u64,
    ) -> rusqlite::Result<()> {
        self.change(|changes| {
            wrong.iter().try_for_each(|key| changes.remove(key))?;
            (first_use..).zip(found).try_for_each(|(used, (key, size))| changes.insert(*key, *size, used))
        })
    }

    /// The least recently used objects that must be removed so that the others, and a new one of that key and size, fit
    /// within the limit. The old object of the new one's key is not among them: the new one replaces it.
    pub(crate) fn least_recently_used(
        &self,
        new: Option<(Key, u64)>,
        limit: u64,
    ) -> rusqlite::Result<Vec<Key>> {
        let mut needed = self.bytes;
        if let Some((key, size)) = new {
            needed = needed - size_of(&self.connection, &key)? + size;
        }
        let mut excess = needed.saturating_sub(limit);
        let mut oldest = Vec::new();
        if excess == 0 {
            return Ok(oldest);
        }
        let mut rows = self.connection.prepare_cached("SELECT key, size FROM objects ORDER BY used")?;
        let mut rows = rows.query([])?;
        while excess > 0
            && let Some(row) = rows.next()?
        {
            let key = Key::from(row.get::<_, [u8; 32]>(0)?);
            if new.is_none_or(|(new, _)| new != key) {
                excess = excess.saturating_sub(row.get::<_, i64>(1)?.cast_unsigned());
                oldest.push(key);
            }
        }
        Ok(oldest)
    }

    fn change(
        &mut self,
        work: impl FnOnce(&mut Changes<'_>) -> rusqlite::Result<()>,
    ) -> rusqlite::Result<()> {
        let transaction = self.connection.transaction()?;
        let mut changes = Changes { connection: &transaction, bytes: self.bytes };
        work(&mut changes)?;
        let bytes = changes.bytes;
        transaction.commit()?;
        self.bytes = bytes;
        Ok(())
    }
}

/// The changes of one transaction, and the sum of the sizes after them.
struct Changes<'a> {
    connection: &'a Connection,
    bytes: u64,
}

impl Changes<'_> {
    fn insert(&mut self, key: Key, size: u64, used: u64) -> rusqlite::Result<()> {
        self.bytes = self.bytes - size_of(self.connection, &key)? + size;
        self.connection
            .prepare_cached("INSERT OR REPLACE INTO objects (key, size, used) VALUES (?, ?, ?)")?
            .execute(params![key.as_bytes(), size.cast_signed(), used.cast_signed()])?;
        Ok(())
    }

    fn record_uses(&mut self, uses: &[(Key, u64)]) -> rusqlite::Result<()> {
        let mut update = self.connection.prepare_cached("UPDATE objects SET used = ?2 WHERE key = ?1")?;
        uses.iter().try_for_each(|(key, used)| {
            update.execute(params![key.as_bytes(), used.cast_signed()]).map(|_| ())
        })
    }

    fn remove(&mut self, key: &Key) -> rusqlite::Result<()> {
        self.bytes -= size_of(self.connection, key)?;
        self.connection.prepare_cached("DELETE FROM objects WHERE key = ?")?.execute([key.as_bytes()])?;
        Ok(())
    }
}

/// The size of a key's object, 0 if it has no row.
fn size_of(connection: &Connection, key: &Key) -> rusqlite::Result<u64> {
    let size = connection
        .prepare_cached("SELECT size FROM objects WHERE key = ?")?
        .query_row([key.as_bytes()], |row| row.get::<_, i64>(0))
        .optional()?;
    Ok(size.unwrap_or(0).cast_unsigned())
}

/// Opens the file. `None` if it is not a valid index of this version.
fn connect(path: &Path) -> rusqlite::Result<Option<Connection>> {
    let connection = Connection::open(path)?;
    // A row that is lost in a power cut is entered again at the next opening, so no commit waits for the disk.
    connection.pragma_update(None, "journal_mode", "WAL")?;
    connection.pragma_update(None, "synchronous", "NORMAL")?;
    let check: String = connection.pragma_query_value(None, "quick_check", |row| row.get(0))?;
    let version: i64 = connection.pragma_query_value(None, "user_version", |row| row.get(0))?;
    let tables: i64 = connection.query_row("SELECT count(*) FROM sqlite_schema", [], |row| row.get(0))?;
    match (check.as_str(), version, tables) {
        ("ok", VERSION, _) => Ok(Some(connection)),
        ("ok", 0, 0) => {
            connection.execute_batch(&format!("BEGIN; {SCHEMA} COMMIT;"))?;
            Ok(Some(connection))
        }
        _ => Ok(None),
    }
}

/// Whether the file is the cause, not the disk.
fn is_damage(error: &rusqlite::Error) -> bool {
    use rusqlite::ErrorCode::{DatabaseCorrupt, NotADatabase, Unknown};
    match error.sqlite_error_code() {
        Some(code) => matches!(code, DatabaseCorrupt | NotADatabase | Unknown),
        None => true,
    }
}

fn rename_damaged(path: &Path) -> io::Result<()> {
    let with = |ending: &str| {
        let mut name = path.as_os_str().to_owned();
        name.push(ending);
        PathBuf::from(name)
    };
    for log in ["-wal", "-shm"] {
        match fs::remove_file(with(log)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => (),
        }
    }
    fs::rename(path, with(".damaged"))
}
