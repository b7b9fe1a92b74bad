//! Receives records and progress from the broker.

use std::convert::Infallible;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use async_nats::jetstream::kv::Operation;
use futures_util::StreamExt;
use tokio::sync::watch;
use tokio::time::timeout;

use super::client::Client;
use super::nats::records::job_of_key;
use super::progress_message;
use super::record::{LAYOUT, Record};
use crate::job_id::{JobId, JobKey};

/// Time after which a failed subscription is tried again.
const RETRY: Duration = Duration::from_millis(500);

/// If no record has come for so long, all have come.
const SILENCE: Duration = Duration::from_secs(1);

/// After so many silences the process asks whether the broker has lost its records.
const MANY_SILENCES: u32 = 10;

/// Applies all records to the replica. Sends `true` when it has all that exist now.
pub(super) async fn receive_records(client: Arc<Client>, caught_up: watch::Sender<bool>) {
    loop {
        let Err(error) = follow_records(&client, &caught_up).await;
        tracing::warn!(error, "no records of jobs arrive now");
        tokio::time::sleep(RETRY).await;
    }
}

async fn follow_records(client: &Client, caught_up: &watch::Sender<bool>) -> Result<Infallible, String> {
    if last_revision(client).await? == 0 {
        set_caught_up(client, caught_up);
    }
    // The existing records come first, then the new ones; so nothing is lost by an interruption.
    let records = &client.nats.records;
    let entries = records.watch_with_history(format!("{LAYOUT}.>")).await;
    let mut entries = entries.map_err(|error| error.to_string())?;
    let mut silences = 0_u32;
    loop {
        let Ok(entry) = timeout(SILENCE, entries.next()).await else {
            // An expected record may have been deleted meanwhile.
            set_caught_up(client, caught_up);
            silences += 1;
            if silences.is_multiple_of(MANY_SILENCES) {
                last_revision(client).await?;
            }
            continue;
        };
        let entry =
            entry.ok_or("the broker has closed the subscription")?.map_err(|error| error.to_string())?;
        match (entry.operation, job_of_key(&entry.key), Record::decode(&entry.value)) {
            (Operation::Put, Some(_), Some(record)) => client.replica.apply(record, entry.revision),
            (Operation::Delete | Operation::Purge, Some(id), _) => client.replica.lock().remove(id),
            // A damaged record: the next process that needs it deletes it.
            _ => {}
        }
        if entry.seen_current {
            set_caught_up(client, caught_up);
        }
    }
}

/// The last revision of all records. If the replica has a later one, the broker has lost its records; then the replica
/// is emptied, since it would hide the new ones.
async fn last_revision(client: &Client) -> Result<u64, String> {
    let last = client.nats.last_revision().await?;
    let is_lost = client.replica.clear_after(last.unwrap_or(0));
    if last.is_none() {
        client.nats.prepare_again().await?;
    }
    if is_lost { Err("the broker has lost its records".to_owned()) } else { Ok(last.unwrap_or(0)) }
}

fn set_caught_up(client: &Client, caught_up: &watch::Sender<bool>) {
    if !*caught_up.borrow() {
        client.replica.lock().is_caught_up = true;
        caught_up.send_replace(true);
    }
}

/// Applies the progress of jobs to the replica.
pub(super) async fn receive_progress(client: Arc<Client>) {
    let prefix = format!("{}.progress.", client.nats.config.name);
    while !client.closed.load(Ordering::Acquire) {
        if let Ok(mut messages) = client.nats.client.subscribe(format!("{prefix}*")).await {
            while let Some(message) = messages.next().await {
                let id = message.subject.strip_prefix(&prefix).and_then(|id| id.parse::<JobId>().ok());
                if let (Some(id), Some((generation, progress))) =
                    (id, progress_message::decode(&message.payload))
                {
                    client.replica.set_progress(JobKey { id, generation }, progress);
                }
            }
        }
        tokio::time::sleep(RETRY).await;
    }
}
