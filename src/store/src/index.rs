//! The memo of what lies on disk: the size and the last use of each object, in SQLite.
//!
//! Every call blocks. A use is a number from a counter that only grows, not a time: clocks are set back.

use std::collections::HashMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::{fs, io};

use rusqlite::{Connection, OptionalExtension, params};

use crate::Key;

const VERSION: i64 = 1;

const SCHEMA: &str = "
    CREATE TABLE objects (key BLOB PRIMARY KEY, size INTEGER NOT NULL, used INTEGER NOT NULL)
        STRICT, WITHOUT ROWID;
    CREATE INDEX objects_by_use ON objects (used);
    PRAGMA user_version = 1;";

pub(crate) struct Index {
    connection: Connection,
    /// Bytes of all objects.
    total: u64,
}

/// An index as it was found.
pub(crate) struct Found {
    pub(crate) index: Index,
    /// Each object's size.
    pub(crate) sizes: HashMap<Key, u64>,
    /// Larger than every use so far.
    pub(crate) next_use: u64,
}

impl Index {
    /// Opens the index of a directory, or makes one. One that cannot be understood is moved aside, for the
    /// objects say the same; the one moved aside before it is overwritten.
    pub(crate) fn open(directory: &Path) -> Result<Found, Box<dyn Error + Send + Sync>> {
        let path = directory.join("index.sqlite3");
        match Self::read(&path) {
            Ok(Some(found)) => return Ok(found),
            Err(fault) if !is_damage(&fault) => return Err(fault.into()),
            Ok(None) => tracing::warn!("the index is not sound or of another version: made anew"),
            Err(fault) => tracing::warn!(%fault, "the index is damaged: made anew"),
        }
        move_aside(&path)?;
        Self::read(&path)?.ok_or_else(|| "a new index is not sound".into())
    }

    /// `None` where a sound index of this version is not what lies there.
    fn read(path: &Path) -> rusqlite::Result<Option<Found>> {
        let Some(connection) = connect(path)? else { return Ok(None) };
        let mut sizes = HashMap::new();
        let (mut total, mut next_use) = (0_u64, 0);
        {
            let mut rows = connection.prepare("SELECT key, size, used FROM objects")?;
            let mut rows = rows.query([])?;
            while let Some(row) = rows.next()? {
                let size = row.get::<_, i64>(1)?.cast_unsigned();
                let Some(sum) = total.checked_add(size) else { return Ok(None) };
                total = sum;
                sizes.insert(Key::from(row.get::<_, [u8; 32]>(0)?), size);
                next_use = next_use.max(row.get::<_, i64>(2)?.cast_unsigned().saturating_add(1));
            }
        }
        Ok(Some(Found { index: Self { connection, total }, sizes, next_use }))
    }

    /// Bytes of all objects.
    pub(crate) fn total(&self) -> u64 {
        self.total
    }

    /// Enters an object, used now.
    pub(crate) fn insert(&mut self, key: Key, size: u64, used: u64) -> rusqlite::Result<()> {
        self.change(|changes| changes.insert(key, size, used))
    }

    /// Notes uses.
    pub(crate) fn touch(&mut self, uses: &[(Key, u64)]) -> rusqlite::Result<()> {
        self.change(|changes| changes.touch(uses))
    }

    /// Strikes objects out.
    pub(crate) fn remove(&mut self, keys: &[Key]) -> rusqlite::Result<()> {
        self.change(|changes| keys.iter().try_for_each(|key| changes.remove(key)))
    }

    /// Strikes out what has gone and enters what was found, in the order of its use.
    pub(crate) fn reconcile(
        &mut self,
        gone: &[Key],
        found: &[(Key, u64)],
        first_use: u64,
    ) -> rusqlite::Result<()> {
        self.change(|changes| {
            gone.iter().try_for_each(|key| changes.remove(key))?;
            (first_use..).zip(found).try_for_each(|(used, (key, size))| changes.insert(*key, *size, used))
        })
    }

    /// What has to go, least recently used first, so that all fits within the bound, and a newcomer of so many
    /// bytes too. Its key's old object is not among it: the new one takes its place.
    pub(crate) fn victims(&self, newcomer: Option<(Key, u64)>, bound: u64) -> rusqlite::Result<Vec<Key>> {
        let mut wanted = self.total;
        if let Some((key, size)) = newcomer {
            wanted = wanted - size_of(&self.connection, &key)? + size;
        }
        let mut excess = wanted.saturating_sub(bound);
        let mut victims = Vec::new();
        if excess == 0 {
            return Ok(victims);
        }
        let mut rows = self.connection.prepare_cached("SELECT key, size FROM objects ORDER BY used")?;
        let mut rows = rows.query([])?;
        while excess > 0
            && let Some(row) = rows.next()?
        {
            let victim = Key::from(row.get::<_, [u8; 32]>(0)?);
            if newcomer.is_none_or(|(key, _)| key != victim) {
                excess = excess.saturating_sub(row.get::<_, i64>(1)?.cast_unsigned());
                victims.push(victim);
            }
        }
        Ok(victims)
    }

    fn change(
        &mut self,
        work: impl FnOnce(&mut Changes<'_>) -> rusqlite::Result<()>,
    ) -> rusqlite::Result<()> {
        let transaction = self.connection.transaction()?;
        let mut changes = Changes { connection: &transaction, total: self.total };
        work(&mut changes)?;
        let total = changes.total;
        transaction.commit()?;
        self.total = total;
        Ok(())
    }
}

/// The changes of one transaction, and the total after them.
struct Changes<'a> {
    connection: &'a Connection,
    total: u64,
}

impl Changes<'_> {
    fn insert(&mut self, key: Key, size: u64, used: u64) -> rusqlite::Result<()> {
        self.total = self.total - size_of(self.connection, &key)? + size;
        self.connection
            .prepare_cached("INSERT OR REPLACE INTO objects (key, size, used) VALUES (?, ?, ?)")?
            .execute(params![key.as_bytes(), size.cast_signed(), used.cast_signed()])?;
        Ok(())
    }

    fn touch(&mut self, uses: &[(Key, u64)]) -> rusqlite::Result<()> {
        let mut update = self.connection.prepare_cached("UPDATE objects SET used = ?2 WHERE key = ?1")?;
        uses.iter().try_for_each(|(key, used)| {
            update.execute(params![key.as_bytes(), used.cast_signed()]).map(|_| ())
        })
    }

    fn remove(&mut self, key: &Key) -> rusqlite::Result<()> {
        self.total -= size_of(self.connection, key)?;
        self.connection.prepare_cached("DELETE FROM objects WHERE key = ?")?.execute([key.as_bytes()])?;
        Ok(())
    }
}

/// The size of a key's object, 0 for one that is not there.
fn size_of(connection: &Connection, key: &Key) -> rusqlite::Result<u64> {
    let size = connection
        .prepare_cached("SELECT size FROM objects WHERE key = ?")?
        .query_row([key.as_bytes()], |row| row.get::<_, i64>(0))
        .optional()?;
    Ok(size.unwrap_or(0).cast_unsigned())
}

/// `None` where the file is not sound or of another version.
fn connect(path: &Path) -> rusqlite::Result<Option<Connection>> {
    let connection = Connection::open(path)?;
    // A row that a power cut takes back is entered again when the store is opened: nothing to wait for.
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

/// Whether the file is at fault, and not the disk it lies on.
fn is_damage(fault: &rusqlite::Error) -> bool {
    use rusqlite::ErrorCode::{DatabaseCorrupt, NotADatabase, Unknown};
    match fault.sqlite_error_code() {
        Some(code) => matches!(code, DatabaseCorrupt | NotADatabase | Unknown),
        None => true,
    }
}

fn move_aside(path: &Path) -> io::Result<()> {
    let with = |ending: &str| {
        let mut name = path.as_os_str().to_owned();
        name.push(ending);
        PathBuf::from(name)
    };
    for log in ["-wal", "-shm"] {
        match fs::remove_file(with(log)) {
            Err(fault) if fault.kind() != io::ErrorKind::NotFound => return Err(fault),
            _ => (),
        }
    }
    fs::rename(path, with(".damaged"))
}
