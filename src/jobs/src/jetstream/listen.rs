//! What the broker tells.

use std::convert::Infallible;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use async_nats::jetstream::kv::Operation;
use futures_util::StreamExt;
use tokio::sync::watch;
use tokio::time::timeout;

use super::bus::read_key;
use super::client::Client;
use super::record::{LAYOUT, Record};
use crate::JobId;

/// How soon the broker is asked again when it could not be.
const RETRY: Duration = Duration::from_millis(500);

/// When nothing has come for so long there was nothing more.
const SILENCE: Duration = Duration::from_secs(1);

/// So many silences after each other are reason to ask whether the broker is still the same.
const MANY_SILENCES: u32 = 10;

/// Keeps the mirror as the records are; tells when it has them all.
pub(super) async fn records(client: Arc<Client>, caught_up: watch::Sender<bool>) {
    loop {
        let Err(fault) = follow(&client, &caught_up).await;
        tracing::warn!(fault, "the records of jobs are not heard of now");
        tokio::time::sleep(RETRY).await;
    }
}

async fn follow(client: &Client, caught_up: &watch::Sender<bool>) -> Result<Infallible, String> {
    if last_revision(client).await? == 0 {
        catch_up(client, caught_up);
    }
    // What is there, and then what comes. Again after each interruption: what came meanwhile is not lost.
    let mut entries = client
        .bus
        .records
        .watch_with_history(format!("{LAYOUT}.>"))
        .await
        .map_err(|fault| fault.to_string())?;
    let mut silences = 0_u32;
    loop {
        let next = timeout(SILENCE, entries.next()).await;
        let Ok(entry) = next else {
            // What was forgotten meanwhile is waited for in vain.
            catch_up(client, caught_up);
            silences += 1;
            if silences.is_multiple_of(MANY_SILENCES) {
                last_revision(client).await?;
            }
            continue;
        };
        let entry = entry.ok_or("the broker has gone")?;
        let entry = entry.map_err(|fault| fault.to_string())?;
        let id = read_key(&entry.key);
        match (entry.operation, id, Record::decode(&entry.value)) {
            (Operation::Put, Some(_), Some(record)) => client.mirror.apply(record, entry.revision),
            (Operation::Delete | Operation::Purge, Some(id), _) => client.mirror.lock().remove(id),
            // Damaged: removed by whoever wants it.
            _ => {}
        }
        if entry.seen_current {
            catch_up(client, caught_up);
        }
    }
}

/// Of the records. If this process has heard of a later one, the broker has begun anew: then what was heard is worth nothing,
/// and would hide what comes.
async fn last_revision(client: &Client) -> Result<u64, String> {
    let last = client.bus.last_revision().await?;
    let lost = client.mirror.begin_anew_after(last.unwrap_or(0));
    if last.is_none() {
        client.bus.begin_anew().await?;
    }
    if lost { Err("the broker has lost its records".to_owned()) } else { Ok(last.unwrap_or(0)) }
}

fn catch_up(client: &Client, caught_up: &watch::Sender<bool>) {
    if !*caught_up.borrow() {
        client.mirror.lock().caught_up = true;
        caught_up.send_replace(true);
    }
}

/// Hears how far jobs are.
pub(super) async fn progress(client: Arc<Client>) {
    let prefix = format!("{}.progress.", client.bus.config.name);
    while !client.closed.load(Ordering::Acquire) {
        if let Ok(mut told) = client.bus.client.subscribe(format!("{prefix}*")).await {
            while let Some(message) = told.next().await {
                let id = message.subject.strip_prefix(&prefix).and_then(|id| id.parse::<JobId>().ok());
                if let (Some(id), Some((life, part))) = (id, read_progress(&message.payload)) {
                    client.mirror.progress(id, life, part);
                }
            }
        }
        tokio::time::sleep(RETRY).await;
    }
}

pub(super) fn write_progress(life: u64, part: f64) -> Vec<u8> {
    [life.to_be_bytes(), part.to_be_bytes()].concat()
}

fn read_progress(payload: &[u8]) -> Option<(u64, f64)> {
    let (life, part) = payload.split_first_chunk::<8>()?;
    Some((u64::from_be_bytes(*life), f64::from_be_bytes(*part.first_chunk()?)))
}
