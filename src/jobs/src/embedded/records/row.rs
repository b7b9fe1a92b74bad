//! Jobs as rows.

use std::time::Duration;

use bytes::Bytes;
use rusqlite::types::{FromSqlError, Type};
use rusqlite::{Connection, Row, named_params};

use super::{Record, Write, schema};
use crate::moment::{from_micros, to_micros};
use crate::{Clients, Failure, Job, JobId, State};

pub(super) fn write(connection: &Connection, write: &Write) -> rusqlite::Result<()> {
    match write {
        Write::Submit(record) => submit(connection, record),
        Write::Postpone { life, deadline } => {
            let parameters =
                named_params! { ":life": life.cast_signed(), ":deadline": deadline.map(to_millis) };
            connection.prepare_cached(schema::POSTPONE)?.execute(parameters).map(drop)
        }
        Write::Show { life } => {
            connection.prepare_cached(schema::SHOW)?.execute([life.cast_signed()]).map(drop)
        }
        Write::Clients { life, clients } => {
            let parameters = named_params! { ":life": life.cast_signed(), ":clients": to_json(clients)? };
            connection.prepare_cached(schema::CLIENTS)?.execute(parameters).map(drop)
        }
        Write::Split { life } => {
            connection.prepare_cached(schema::SPLIT)?.execute([life.cast_signed()]).map(drop)
        }
        Write::Start { life, attempts, started } => {
            let parameters = named_params! {
                ":life": life.cast_signed(), ":attempts": attempts, ":started": to_micros(*started),
            };
            connection.prepare_cached(schema::START)?.execute(parameters).map(drop)
        }
        Write::Finish { life, job } => finish(connection, *life, job),
        Write::Requeue { life } => {
            connection.prepare_cached(schema::REQUEUE)?.execute([life.cast_signed()]).map(drop)
        }
    }
}

fn submit(connection: &Connection, Record { life, job, deadline, hidden }: &Record) -> rusqlite::Result<()> {
    let parameters = named_params! {
        ":life": life.cast_signed(), ":id": job.id.as_bytes(), ":client": job.client, ":cost": job.cost,
        ":clients": to_json(&job.clients)?,
        ":payload": job.payload.as_ref(), ":deadline": deadline.map(to_millis), ":created": to_micros(job.created),
        ":hidden": hidden,
    };
    connection.prepare_cached(schema::SUBMIT)?.execute(parameters).map(drop)
}

fn to_json(clients: &Clients) -> rusqlite::Result<String> {
    serde_json::to_string(clients).map_err(|fault| rusqlite::Error::ToSqlConversionFailure(Box::new(fault)))
}

fn to_millis(limit: Duration) -> i64 {
    i64::try_from(limit.as_millis()).unwrap_or(i64::MAX)
}

fn finish(connection: &Connection, life: u64, job: &Job) -> rusqlite::Result<()> {
    let failure = job.failure.as_ref().map(failure_name);
    let detail = job.failure.as_ref().and_then(|failure| match failure {
        Failure::Work(reason) => Some(reason.as_ref()),
        Failure::Panicked(message) => Some(message.as_bytes()),
        Failure::DeadlinePassed | Failure::TooManyAttempts => None,
    });
    let parameters = named_params! {
        ":life": life.cast_signed(), ":state": job.state.name(), ":progress": job.progress,
        ":finished": job.finished.map(to_micros), ":failure": failure, ":detail": detail,
    };
    connection.prepare_cached(schema::FINISH)?.execute(parameters).map(drop)
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
    let deadline = deadline.map(|limit| Duration::from_millis(limit.max(0).cast_unsigned()));
    Ok(Record { life: row.get::<_, i64>("life")?.cast_unsigned(), job, deadline, hidden: row.get("hidden")? })
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

fn unknown(column: &str) -> rusqlite::Error {
    let fault = FromSqlError::other(std::io::Error::other(format!("{column} is none that is written")));
    rusqlite::Error::FromSqlConversionFailure(0, Type::Text, Box::new(fault))
}
