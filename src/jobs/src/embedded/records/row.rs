//! Reads and writes the rows of the table of jobs.

use std::time::Duration;

use bytes::Bytes;
use rusqlite::types::{FromSqlError, Type};
use rusqlite::{Connection, Row, ToSql, named_params};

use super::record::{Record, Write};
use super::schema;
use crate::clients::Clients;
use crate::job::{Failure, Job, State};
use crate::job_id::JobId;
use crate::timestamp::{from_micros, to_micros};

pub(super) fn write(connection: &Connection, write: &Write) -> rusqlite::Result<()> {
    let execute_for = |statement, generation: &u64| {
        execute(connection, statement, named_params! { ":life": generation.cast_signed() })
    };
    match write {
        Write::Submit(record) => submit(connection, record),
        Write::SetDeadline { generation, deadline } => {
            let (life, deadline) = (generation.cast_signed(), deadline.map(to_millis));
            execute(connection, schema::SET_DEADLINE, named_params! { ":life": life, ":deadline": deadline })
        }
        Write::List { generation } => execute_for(schema::LIST_SUBTASK, generation),
        Write::SetClients { generation, clients } => {
            let (life, clients) = (generation.cast_signed(), to_json(clients)?);
            execute(connection, schema::SET_CLIENTS, named_params! { ":life": life, ":clients": clients })
        }
        Write::Wait { generation } => execute_for(schema::WAIT, generation),
        Write::Start { generation, attempts, started } => {
            let (life, started) = (generation.cast_signed(), to_micros(*started));
            let parameters = named_params! { ":life": life, ":attempts": attempts, ":started": started };
            execute(connection, schema::START, parameters)
        }
        Write::Finish { generation, job } => finish(connection, *generation, job),
        Write::Requeue { generation } => execute_for(schema::REQUEUE, generation),
    }
}

fn execute(
    connection: &Connection,
    statement: &str,
    parameters: &[(&str, &dyn ToSql)],
) -> rusqlite::Result<()> {
    connection.prepare_cached(statement)?.execute(parameters).map(drop)
}

fn submit(connection: &Connection, record: &Record) -> rusqlite::Result<()> {
    let Record { generation, job, deadline, is_only_subtask } = record;
    let parameters = named_params! {
        ":life": generation.cast_signed(), ":id": job.id.as_bytes(), ":client": job.client, ":cost": job.cost,
        ":clients": to_json(&job.clients)?, ":payload": job.payload.as_ref(),
        ":deadline": deadline.map(to_millis), ":created": to_micros(job.created), ":hidden": is_only_subtask,
    };
    execute(connection, schema::SUBMIT, parameters)
}

fn to_json(clients: &Clients) -> rusqlite::Result<String> {
    serde_json::to_string(clients).map_err(|error| rusqlite::Error::ToSqlConversionFailure(Box::new(error)))
}

fn to_millis(limit: Duration) -> i64 {
    i64::try_from(limit.as_millis()).unwrap_or(i64::MAX)
}

fn finish(connection: &Connection, generation: u64, job: &Job) -> rusqlite::Result<()> {
    let failure = job.failure.as_ref().map(failure_name);
    let detail = job.failure.as_ref().and_then(|failure| match failure {
        Failure::Work(reason) => Some(reason.as_ref()),
        Failure::Panicked(message) => Some(message.as_bytes()),
        Failure::DeadlinePassed | Failure::TooManyAttempts => None,
    });
    let parameters = named_params! {
        ":life": generation.cast_signed(), ":state": job.state.name(), ":progress": job.progress,
        ":finished": job.finished.map(to_micros), ":failure": failure, ":detail": detail,
    };
    execute(connection, schema::FINISH, parameters)
}

pub(super) fn failure_name(failure: &Failure) -> &'static str {
    match failure {
        Failure::Work(_) => "work",
        Failure::Panicked(_) => "panicked",
        Failure::DeadlinePassed => "deadline passed",
        Failure::TooManyAttempts => "too many attempts",
    }
}

pub(super) fn read(row: &Row<'_>) -> rusqlite::Result<Record> {
    let time = |column| row.get::<_, Option<i64>>(column).map(|micros| micros.map(from_micros));
    let state: String = row.get("state")?;
    let state = State::ALL.into_iter().find(|known| known.name() == state).ok_or_else(|| unknown("state"))?;
    let deadline: Option<i64> = row.get("deadline")?;
    let job = Job {
        id: JobId::from_bytes(row.get("id")?),
        client: row.get("client")?,
        clients: serde_json::from_str(&row.get::<_, String>("clients")?).map_err(|_| unknown("clients"))?,
        cost: row.get("cost")?,
        payload: Bytes::from(row.get::<_, Vec<u8>>("payload")?),
        state,
        progress: row.get("progress")?,
        created: from_micros(row.get("created")?),
        started: time("started")?,
        finished: time("finished")?,
        attempts: row.get("attempts")?,
        failure: failure(row)?,
    };
    Ok(Record {
        generation: row.get::<_, i64>("life")?.cast_unsigned(),
        job,
        deadline: deadline.map(|limit| Duration::from_millis(limit.max(0).cast_unsigned())),
        is_only_subtask: row.get("hidden")?,
    })
}

fn failure(row: &Row<'_>) -> rusqlite::Result<Option<Failure>> {
    let Some(name) = row.get::<_, Option<String>>("failure")? else {
        return Ok(None);
    };
    let detail: Vec<u8> = row.get::<_, Option<_>>("detail")?.unwrap_or_default();
    match name.as_str() {
        "work" => Ok(Some(Failure::Work(detail.into()))),
        "panicked" => Ok(Some(Failure::Panicked(String::from_utf8_lossy(&detail).into_owned()))),
        "deadline passed" => Ok(Some(Failure::DeadlinePassed)),
        "too many attempts" => Ok(Some(Failure::TooManyAttempts)),
        _ => Err(unknown("failure")),
    }
}

/// A column has a value that this program never writes.
fn unknown(column: &str) -> rusqlite::Error {
    let error = FromSqlError::other(std::io::Error::other(format!("unknown value of {column}")));
    rusqlite::Error::FromSqlConversionFailure(0, Type::Text, Box::new(error))
}
