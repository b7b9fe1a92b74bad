//! Records of jobs in SQLite.

mod files;
mod lock;
pub(super) mod open;
pub(super) mod record;
mod row;
mod schema;

use rusqlite::{Connection, OptionalExtension, named_params};

use crate::error::UnavailableError;
use crate::job::{Job, State};
use crate::job_id::JobId;
use crate::page::Filter;
use crate::retention::Retention;
use crate::timestamp::{now, to_micros};
use files::Files;
use lock::DirectoryLock;
use record::{Record, Write};

/// More bytes than a change writes beside its payload.
const PAGES: usize = 32 * 1024;

pub(super) struct Records {
    connection: Connection,
    retention: Retention,
    /// `None`: the database is in memory.
    files: Option<Files>,
    /// Held while the database is open.
    lock: Option<DirectoryLock>,
}

impl Records {
    /// Makes all changes in one transaction. A change that fails does not affect the others.
    pub(super) fn write(&mut self, writes: &[&Write]) -> Vec<Result<(), UnavailableError>> {
        let written =
            self.check_files().and_then(|()| self.write_transaction(writes).map_err(UnavailableError::new));
        written.unwrap_or_else(|error| writes.iter().map(|_| Err(error.clone())).collect())
    }

    /// Checks that the open database is the one in the directory. Writes to a removed file are lost when the process
    /// ends.
    pub(super) fn check_files(&self) -> Result<(), UnavailableError> {
        self.files.as_ref().map_or(Ok(()), Files::check)
    }

    fn write_transaction(
        &mut self,
        writes: &[&Write],
    ) -> rusqlite::Result<Vec<Result<(), UnavailableError>>> {
        let transaction = self.connection.transaction()?;
        let mut results = Vec::with_capacity(writes.len());
        for write in writes {
            match row::write(&transaction, write) {
                // A full disk or the like: SQLite has rolled back the transaction.
                Err(error) if transaction.is_autocommit() => return Err(error),
                result => results.push(result.map_err(UnavailableError::new)),
            }
        }
        if writes.iter().any(|write| matches!(write, Write::Finish { .. })) {
            forget(&transaction, self.retention)?;
        }
        transaction.commit()?;
        Ok(results)
    }

    /// Writes as many bytes as a change with a payload of this length.
    pub(super) fn probe(&self, bytes: usize) -> Result<(), UnavailableError> {
        self.check_files()?;
        let bytes = i64::try_from(bytes.saturating_add(PAGES)).unwrap_or(i64::MAX);
        self.connection.execute(schema::PROBE, [bytes]).map(drop).map_err(UnavailableError::new)
    }

    /// Simulates a disk that refuses writes, or accepts them again.
    #[cfg(test)]
    pub(super) fn refuse_writes(&self, refuse: bool) -> Result<(), UnavailableError> {
        self.connection.pragma_update(None, "query_only", refuse).map_err(UnavailableError::new)
    }

    /// Deletes the ended jobs that exceed the retention.
    pub(super) fn forget(&self) -> Result<(), UnavailableError> {
        forget(&self.connection, self.retention).map_err(UnavailableError::new)
    }

    pub(super) fn get(&self, id: JobId) -> Result<Option<Job>, UnavailableError> {
        let read =
            || self.connection.prepare_cached(schema::GET)?.query_row([id.as_bytes()], row::read).optional();
        let record = read().map_err(UnavailableError::new)?;
        Ok(record.map(|record| record.job))
    }

    /// The first `limit` records of a page.
    pub(super) fn list(&self, filter: &Filter, limit: usize) -> Result<Vec<Record>, UnavailableError> {
        let read = || {
            let mut select = self.connection.prepare_cached(schema::LIST)?;
            let before = filter.after.map_or(i64::MAX, |cursor| i64::try_from(cursor.0).unwrap_or(i64::MAX));
            let parameters = named_params! {
                ":state": filter.state.map(State::name), ":client": filter.client, ":before": before,
                ":limit": i64::try_from(limit).unwrap_or(i64::MAX),
            };
            select.query_map(parameters, row::read)?.collect::<Result<_, _>>()
        };
        read().map_err(|error: rusqlite::Error| UnavailableError::new(error))
    }
}

fn forget(connection: &Connection, retention: Retention) -> rusqlite::Result<()> {
    let oldest = now().checked_sub(retention.age).map_or(0, to_micros);
    connection.prepare_cached(schema::FORGET_OLD)?.execute([oldest])?;
    let count = i64::try_from(retention.count).unwrap_or(i64::MAX);
    // Counted apart: a job with many subtasks must not displace the jobs of clients.
    for is_only_subtask in [false, true] {
        connection.prepare_cached(schema::FORGET_MANY)?.execute((count, is_only_subtask))?;
    }
    Ok(())
}
