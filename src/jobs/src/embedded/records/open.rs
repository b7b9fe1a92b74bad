//! Opens a database, and takes over what a process left in it.

use std::collections::HashSet;
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

use rusqlite::{Connection, ErrorCode, Row, named_params};

use super::files::Files;
use super::{Record, Records, Retention, row, schema};
use crate::embedded::OpenError;
use crate::moment::{now, to_micros};
use crate::{Failure, JobId};

const NAME: &str = "jobs.sqlite3";

pub(in crate::embedded) struct Opened {
    pub(in crate::embedded) records: Records,
    /// Jobs to be run, oldest first.
    pub(in crate::embedded) live: Vec<Record>,
    pub(in crate::embedded) last_life: u64,
    /// Failed at too many attempts.
    pub(in crate::embedded) given_up: HashSet<JobId>,
    /// Where a database that could not be read has been put.
    pub(in crate::embedded) set_aside: Option<PathBuf>,
}

/// Why one database cannot be used.
enum Fault {
    /// It is not a database of jobs, an earlier version's, or damaged.
    Corrupt(String),
    Newer(i64),
    Other(String),
}

impl From<rusqlite::Error> for Fault {
    fn from(fault: rusqlite::Error) -> Self {
        use rusqlite::Error as E;
        let code = fault.sqlite_error_code();
        let damaged = matches!(code, Some(ErrorCode::DatabaseCorrupt | ErrorCode::NotADatabase))
            // Tables that are not these, or a value that was never written.
            || matches!(fault, E::SqlInputError { .. } | E::InvalidColumnType(..) | E::FromSqlConversionFailure(..));
        if damaged { Self::Corrupt(fault.to_string()) } else { Self::Other(fault.to_string()) }
    }
}

/// In memory when there is no directory.
pub(in crate::embedded) fn open(
    directory: Option<&Path>,
    retention: Retention,
    max_attempts: u32,
) -> Result<Opened, OpenError> {
    let Some(directory) = directory else {
        let opened = Connection::open_in_memory().map_err(Fault::from);
        let opened = opened.and_then(|connection| take_over(connection, retention, max_attempts));
        return opened.map_err(|fault| error(Path::new(":memory:"), fault));
    };
    let unusable =
        |fault: std::io::Error| OpenError::Unusable { path: directory.to_owned(), reason: fault.to_string() };
    fs::create_dir_all(directory).map_err(unusable)?;
    let lock = lock(directory)?;
    let path = directory.join(NAME);
    let attempt = || take_over(Connection::open(&path)?, retention, max_attempts);
    let mut opened = match attempt() {
        Err(Fault::Corrupt(reason)) => {
            let set_aside = set_aside(directory).map_err(unusable)?;
            tracing::error!(reason, moved_to = %set_aside.display(), "the database of jobs cannot be read; a new one is begun");
            attempt().map(|opened| Opened { set_aside: Some(set_aside), ..opened })
        }
        opened => opened,
    }
    .map_err(|fault| error(&path, fault))?;
    opened.records.files = Some(Files::of(&path).map_err(unusable)?);
    opened.records.lock = Some(lock);
    Ok(opened)
}

fn error(path: &Path, fault: Fault) -> OpenError {
    let path = path.to_owned();
    match fault {
        Fault::Newer(version) => OpenError::Newer { path, version },
        Fault::Corrupt(reason) | Fault::Other(reason) => OpenError::Unusable { path, reason },
    }
}

/// The lock on a directory of jobs. It is released explicitly: until a child process that is being started runs its
/// program, the child has a copy of the open file, and closing the file alone would leave the lock.
pub(super) struct DirectoryLock(File);

impl Drop for DirectoryLock {
    fn drop(&mut self) {
        // If this fails, closing the file releases the lock.
        drop(self.0.unlock());
    }
}

/// Keeps other verne processes out. SQLite's own locks must not: programs that back the database up read it meanwhile.
/// A file of its own: SQLite's locks are the process's, not the connection's, and go with any other handle.
fn lock(directory: &Path) -> Result<DirectoryLock, OpenError> {
    let path = directory.join("jobs.lock");
    let unusable =
        |fault: std::io::Error| OpenError::Unusable { path: path.clone(), reason: fault.to_string() };
    let file = File::options().create(true).write(true).truncate(false).open(&path).map_err(unusable)?;
    match file.try_lock() {
        Ok(()) => Ok(DirectoryLock(file)),
        Err(TryLockError::WouldBlock) => Err(OpenError::InUse { directory: directory.to_owned() }),
        Err(TryLockError::Error(fault)) => Err(unusable(fault)),
    }
}

fn set_aside(directory: &Path) -> std::io::Result<PathBuf> {
    let named = |number: usize, end: &str| directory.join(format!("{NAME}{end}.corrupt-{number}"));
    let mut number = 1;
    while named(number, "").try_exists()? {
        number += 1;
    }
    // The journal first: were the database gone and the journal not, it would be replayed into the new one.
    for end in ["-wal", "-shm", ""] {
        let from = directory.join(format!("{NAME}{end}"));
        if from.try_exists()? {
            fs::rename(from, named(number, end))?;
        }
    }
    Ok(named(number, ""))
}

fn take_over(mut connection: Connection, retention: Retention, max_attempts: u32) -> Result<Opened, Fault> {
    let is_new = is_new(&connection)?;
    connection.pragma_update(None, "journal_mode", "WAL")?;
    connection.pragma_update(None, "synchronous", "FULL")?;
    let transaction = connection.transaction()?;
    if is_new {
        transaction.execute_batch(schema::CREATE)?;
    }
    transaction.execute_batch(schema::CREATE_PROBE)?;
    // Written each time: a disk that takes no writes is found now.
    transaction.pragma_update(None, "user_version", schema::VERSION)?;
    transaction.execute(schema::COUNT_CRASHES, [])?;
    let failed = named_params! {
        ":finished": to_micros(now()), ":failure": row::failure_name(&Failure::TooManyAttempts), ":limit": max_attempts,
    };
    transaction.execute(schema::FAIL_CRASHED, failed)?;
    let live = transaction.prepare(schema::LIVE)?.query_map([], row::read)?.collect::<Result<_, _>>()?;
    let given_up = row::failure_name(&Failure::TooManyAttempts);
    let given_up = transaction
        .prepare(schema::GIVEN_UP)?
        .query_map([given_up], |row| row.get("id").map(JobId::from_bytes))?
        .collect::<Result<_, _>>()?;
    let last_life = transaction.query_row(schema::LAST_LIFE, [], |row| row.get::<_, i64>(0))?.cast_unsigned();
    transaction.commit()?;
    let records = Records { connection, retention, files: None, lock: None };
    Ok(Opened { records, live, last_life, given_up, set_aside: None })
}

/// Name, type, whether it is needed, and place in the primary key.
type Column = (String, String, bool, i64);

fn columns(connection: &Connection) -> rusqlite::Result<Vec<Column>> {
    let column =
        |row: &Row<'_>| Ok((row.get("name")?, row.get("type")?, row.get("notnull")?, row.get("pk")?));
    connection.prepare("SELECT * FROM pragma_table_info('jobs')")?.query_map([], column)?.collect()
}

/// Those of the table that this version makes.
fn own_columns() -> rusqlite::Result<Vec<Column>> {
    let scratch = Connection::open_in_memory()?;
    scratch.execute_batch(schema::CREATE)?;
    columns(&scratch)
}

/// Whether the tables are yet to be made. Only reads: what is not ours is left as it is.
fn is_new(connection: &Connection) -> Result<bool, Fault> {
    let found: String = connection.query_row("PRAGMA quick_check(1)", [], |row| row.get(0))?;
    if found != "ok" {
        return Err(Fault::Corrupt(found));
    }
    let tables: i64 = connection.query_row("SELECT count(*) FROM sqlite_schema", [], |row| row.get(0))?;
    match connection.pragma_query_value(None, "user_version", |row| row.get(0))? {
        schema::VERSION if columns(connection)? == own_columns()? => Ok(false),
        schema::VERSION => Err(Fault::Corrupt("a database of something else".to_owned())),
        0 if tables == 0 => Ok(true),
        0 => Err(Fault::Corrupt("a database of something else".to_owned())),
        version if version < schema::VERSION => {
            Err(Fault::Corrupt(format!("written by an earlier version (schema {version})")))
        }
        version => Err(Fault::Newer(version)),
    }
}
