//! Jobs in SQLite.

mod files;
mod open;
mod row;
mod schema;

use std::time::{Duration, SystemTime};

use rusqlite::{Connection, OptionalExtension, named_params};

use crate::moment::{now, to_micros};
use crate::{Clients, Filter, Job, JobId, State, Unavailable};
use files::Files;

pub(super) use open::{Opened, open};

/// More than the bytes of the pages that a change writes beside its payload's.
const PAGES: usize = 32 * 1024;

/// A job with what is not told about it.
#[derive(Clone, Debug)]
pub(super) struct Record {
    /// Number of the submission that began this life of the job; grows.
    pub(super) life: u64,
    pub(super) job: Job,
    pub(super) deadline: Option<Duration>,
    /// It has only been asked for as a part.
    pub(super) hidden: bool,
}

/// A change to be made.
#[derive(Debug)]
pub(super) enum Write {
    /// In place of an earlier life.
    Submit(Record),
    /// Another asks for it who waits longer.
    Postpone {
        life: u64,
        deadline: Option<Duration>,
    },
    /// A part is asked for by itself.
    Show {
        life: u64,
    },
    /// Another asks for it, or one does no longer.
    Clients {
        life: u64,
        clients: Clients,
    },
    /// It waits for its parts.
    Split {
        life: u64,
    },
    Start {
        life: u64,
        attempts: u32,
        started: SystemTime,
    },
    Finish {
        life: u64,
        job: Job,
    },
    /// A run was stopped in good order.
    Requeue {
        life: u64,
    },
}

impl Write {
    /// Bytes that it has for itself.
    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::Submit(record) => record.job.payload.len(),
            _ => 0,
        }
    }
}

/// What is kept of finished jobs.
#[derive(Clone, Copy, Debug)]
pub struct Retention {
    /// At most so many, and as many that were only parts.
    pub count: usize,
    /// None that finished longer ago.
    pub age: Duration,
}

pub(super) struct Records {
    connection: Connection,
    retention: Retention,
    /// `None`: in memory.
    files: Option<Files>,
    /// Held as long as the database is open.
    lock: Option<open::DirectoryLock>,
}

impl Records {
    /// Makes all changes in one transaction; a change that fails alone leaves the others.
    pub(super) fn write(&mut self, writes: &[&Write]) -> Vec<Result<(), Unavailable>> {
        let written = self
            .check_files()
            .and_then(|()| self.try_write(writes).map_err(|fault| Unavailable(fault.to_string())));
        written.unwrap_or_else(|fault| writes.iter().map(|_| Err(fault.clone())).collect())
    }

    /// Whether the database that is open is the one in the directory. What is written to one that was removed is lost when
    /// the process ends.
    pub(super) fn check_files(&self) -> Result<(), Unavailable> {
        self.files.as_ref().map_or(Ok(()), Files::check)
    }

    fn try_write(&mut self, writes: &[&Write]) -> rusqlite::Result<Vec<Result<(), Unavailable>>> {
        let transaction = self.connection.transaction()?;
        let mut results = Vec::with_capacity(writes.len());
        for write in writes {
            let result = row::write(&transaction, write);
            if let Err(fault) = &result
                && transaction.is_autocommit()
            {
                // A full disk or the like: SQLite has rolled back everything.
                let fault = Unavailable(fault.to_string());
                return Ok(writes.iter().map(|_| Err(fault.clone())).collect());
            }
            results.push(result.map_err(|fault| Unavailable(fault.to_string())));
        }
        if writes.iter().any(|write| matches!(write, Write::Finish { .. })) {
            forget(&transaction, self.retention)?;
        }
        transaction.commit()?;
        Ok(results)
    }

    /// Writes as much as a change that has so many bytes for itself, and its pages around them.
    pub(super) fn probe(&self, bytes: usize) -> Result<(), Unavailable> {
        self.check_files()?;
        let bytes = i64::try_from(bytes.saturating_add(PAGES)).unwrap_or(i64::MAX);
        let written = self.connection.execute(schema::PROBE, [bytes]);
        written.map(drop).map_err(|fault| Unavailable(fault.to_string()))
    }

    /// As a disk that takes nothing, or does again.
    #[cfg(test)]
    pub(super) fn refuse_writes(&self, refuse: bool) -> Result<(), Unavailable> {
        let refused = self.connection.pragma_update(None, "query_only", refuse);
        refused.map_err(|fault| Unavailable(fault.to_string()))
    }

    /// Forgets finished jobs that are not to be kept.
    pub(super) fn forget(&self) -> Result<(), Unavailable> {
        forget(&self.connection, self.retention).map_err(|fault| Unavailable(fault.to_string()))
    }

    pub(super) fn get(&self, id: JobId) -> Result<Option<Job>, Unavailable> {
        let read = || {
            let mut select = self.connection.prepare_cached(schema::GET)?;
            select.query_row([id.as_bytes()], row::read).optional()
        };
        let record = read().map_err(|fault: rusqlite::Error| Unavailable(fault.to_string()))?;
        Ok(record.map(|record| record.job))
    }

    /// One more than a page has, which tells whether there is a next.
    pub(super) fn list(&self, filter: &Filter, limit: usize) -> Result<Vec<Record>, Unavailable> {
        let read = || {
            let mut select = self.connection.prepare_cached(schema::LIST)?;
            let before = filter.after.map_or(i64::MAX, |cursor| i64::try_from(cursor.0).unwrap_or(i64::MAX));
            let parameters = named_params! {
                ":state": filter.state.map(State::name), ":client": filter.client, ":before": before,
                ":limit": i64::try_from(limit).unwrap_or(i64::MAX),
            };
            select.query_map(parameters, row::read)?.collect::<Result<_, _>>()
        };
        read().map_err(|fault: rusqlite::Error| Unavailable(fault.to_string()))
    }
}

fn forget(connection: &Connection, retention: Retention) -> rusqlite::Result<()> {
    let oldest = now().checked_sub(retention.age).map_or(0, to_micros);
    connection.prepare_cached(schema::FORGET_OLD)?.execute([oldest])?;
    let count = i64::try_from(retention.count).unwrap_or(i64::MAX);
    // Of each kind: a job of many parts must not make others' jobs forgotten.
    for hidden in [false, true] {
        connection.prepare_cached(schema::FORGET_MANY)?.execute((count, hidden))?;
    }
    Ok(())
}
