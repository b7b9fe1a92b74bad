//! Opens a database and counts the crash that its unfinished jobs show.

use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use rusqlite::{Connection, ErrorCode, Row, named_params};

use super::Records;
use super::files::Files;
use super::lock::DirectoryLock;
use super::record::Record;
use super::{row, schema};
use crate::embedded::config::OpenError;
use crate::job::Failure;
use crate::job_id::JobId;
use crate::retention::Retention;
use crate::timestamp::{now, to_micros};

const NAME: &str = "jobs.sqlite3";

pub(crate) struct Opened {
    pub(crate) records: Records,
    /// Jobs that have not ended, the oldest first.
    pub(crate) unfinished: Vec<Record>,
    pub(crate) last_generation: u64,
    /// Jobs that have failed with too many attempts.
    pub(crate) given_up: HashSet<JobId>,
    /// New path of a damaged database.
    pub(crate) damaged_database: Option<PathBuf>,
}

/// A database cannot be used.
enum DatabaseError {
    /// It is damaged, an earlier version's, or no database of jobs.
    Damaged(String),
    /// A later version wrote it; its schema version.
    Newer(i64),
    Other(String),
}

impl From<rusqlite::Error> for DatabaseError {
    fn from(error: rusqlite::Error) -> Self {
        use rusqlite::Error as E;
        let code = error.sqlite_error_code();
        let is_damaged = matches!(code, Some(ErrorCode::DatabaseCorrupt | ErrorCode::NotADatabase))
            // Other tables, or a value that this program never writes.
            || matches!(error, E::SqlInputError { .. } | E::InvalidColumnType(..) | E::FromSqlConversionFailure(..));
        if is_damaged { Self::Damaged(error.to_string()) } else { Self::Other(error.to_string()) }
    }
}

/// Opens the database of a directory, or one in memory.
pub(crate) fn open(
    directory: Option<&Path>,
    retention: Retention,
    max_attempts: u32,
) -> Result<Opened, OpenError> {
    let Some(directory) = directory else {
        let opened = Connection::open_in_memory().map_err(DatabaseError::from);
        let opened = opened.and_then(|connection| prepare(connection, retention, max_attempts));
        return opened.map_err(|error| open_error(Path::new(":memory:"), error));
    };
    let unusable =
        |error: std::io::Error| OpenError::Unusable { path: directory.to_owned(), reason: error.to_string() };
    fs::create_dir_all(directory).map_err(unusable)?;
    let lock = DirectoryLock::take(directory)?;
    let path = directory.join(NAME);
    let attempt = || prepare(Connection::open(&path)?, retention, max_attempts);
    let mut opened = match attempt() {
        Err(DatabaseError::Damaged(reason)) => {
            let moved_to = set_aside(directory).map_err(unusable)?;
            let shown = moved_to.display();
            tracing::error!(reason, moved_to = %shown, "cannot read the database of jobs; creating a new one");
            attempt().map(|opened| Opened { damaged_database: Some(moved_to), ..opened })
        }
        opened => opened,
    }
    .map_err(|error| open_error(&path, error))?;
    opened.records.files = Some(Files::of(&path).map_err(unusable)?);
    opened.records.lock = Some(lock);
    Ok(opened)
}

fn open_error(path: &Path, error: DatabaseError) -> OpenError {
    let path = path.to_owned();
    match error {
        DatabaseError::Newer(version) => OpenError::Newer { path, version },
        DatabaseError::Damaged(reason) | DatabaseError::Other(reason) => OpenError::Unusable { path, reason },
    }
}

/// Renames a damaged database and returns its new path.
fn set_aside(directory: &Path) -> std::io::Result<PathBuf> {
    let new_path = |number: usize, suffix: &str| directory.join(format!("{NAME}{suffix}.corrupt-{number}"));
    let mut number = 1;
    while new_path(number, "").try_exists()? {
        number += 1;
    }
    // The journal first: if it stayed without the database, SQLite would apply it to the new one.
    for suffix in ["-wal", "-shm", ""] {
        let from = directory.join(format!("{NAME}{suffix}"));
        if from.try_exists()? {
            fs::rename(from, new_path(number, suffix))?;
        }
    }
    Ok(new_path(number, ""))
}

fn prepare(
    mut connection: Connection,
    retention: Retention,
    max_attempts: u32,
) -> Result<Opened, DatabaseError> {
    let is_new = is_new(&connection)?;
    connection.pragma_update(None, "journal_mode", "WAL")?;
    connection.pragma_update(None, "synchronous", "FULL")?;
    let transaction = connection.transaction()?;
    if is_new {
        transaction.execute_batch(schema::CREATE)?;
    }
    transaction.execute_batch(schema::CREATE_PROBE)?;
    // Written at each start: a disk that refuses writes is found now.
    transaction.pragma_update(None, "user_version", schema::VERSION)?;
    transaction.execute(schema::COUNT_CRASHES, [])?;
    let too_many_attempts = row::failure_name(&Failure::TooManyAttempts);
    let parameters = named_params! {
        ":finished": to_micros(now()), ":failure": too_many_attempts, ":limit": max_attempts,
    };
    transaction.execute(schema::FAIL_CRASHED, parameters)?;
    let unfinished =
        transaction.prepare(schema::UNFINISHED)?.query_map([], row::read)?.collect::<Result<_, _>>()?;
    let given_up = transaction
        .prepare(schema::GIVEN_UP)?
        .query_map([too_many_attempts], |row| row.get("id").map(JobId::from_bytes))?
        .collect::<Result<_, _>>()?;
    let last: i64 = transaction.query_row(schema::LAST_GENERATION, [], |row| row.get(0))?;
    transaction.commit()?;
    let records = Records { connection, retention, files: None, lock: None };
    let last_generation = last.cast_unsigned();
    Ok(Opened { records, unfinished, last_generation, given_up, damaged_database: None })
}

/// Name, type, whether NULL is forbidden, and position in the primary key.
type Column = (String, String, bool, i64);

fn columns(connection: &Connection) -> rusqlite::Result<Vec<Column>> {
    let column =
        |row: &Row<'_>| Ok((row.get("name")?, row.get("type")?, row.get("notnull")?, row.get("pk")?));
    connection.prepare("SELECT * FROM pragma_table_info('jobs')")?.query_map([], column)?.collect()
}

/// The columns of the table that this version creates.
fn own_columns() -> rusqlite::Result<Vec<Column>> {
    let scratch = Connection::open_in_memory()?;
    scratch.execute_batch(schema::CREATE)?;
    columns(&scratch)
}

/// Whether the tables do not exist yet. Only reads: another program's database must not change.
fn is_new(connection: &Connection) -> Result<bool, DatabaseError> {
    let found: String = connection.query_row("PRAGMA quick_check(1)", [], |row| row.get(0))?;
    if found != "ok" {
        return Err(DatabaseError::Damaged(found));
    }
    let tables: i64 = connection.query_row("SELECT count(*) FROM sqlite_schema", [], |row| row.get(0))?;
    let other = || Err(DatabaseError::Damaged("another program's database".to_owned()));
    match connection.pragma_query_value(None, "user_version", |row| row.get(0))? {
        schema::VERSION if columns(connection)? == own_columns()? => Ok(false),
        schema::VERSION => other(),
        0 if tables == 0 => Ok(true),
        0 => other(),
        version if version < schema::VERSION => {
            Err(DatabaseError::Damaged(format!("written by an earlier version (schema {version})")))
        }
        version => Err(DatabaseError::Newer(version)),
    }
}
