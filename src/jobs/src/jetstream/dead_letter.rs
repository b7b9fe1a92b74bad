//! Fails the jobs at which too many workers were lost. The broker sends a note when it has delivered a message too
//! often.

use std::sync::Arc;
use std::time::Duration;

use async_nats::jetstream::AckKind;
use futures_util::StreamExt;
use serde::Deserialize;

use super::client::Client;
use super::nats::queue::{Ticket, has_own_layout};
use crate::error::UnavailableError;
use crate::job::{Failure, Outcome};

/// Time after which a failed request is tried again.
const RETRY: Duration = Duration::from_secs(1);

/// Longest time of one request for notes.
const FETCH_TIMEOUT: Duration = Duration::from_secs(5);

/// Time after which the broker offers a note on another layout's message again.
const NAK_DELAY: Duration = Duration::from_secs(10);

/// The broker's note on a message.
#[derive(Deserialize)]
struct Advisory {
    stream_seq: u64,
}

pub(super) async fn fail_undeliverable(client: Arc<Client>) {
    loop {
        if let Err(error) = process_notes(&client).await {
            tracing::warn!(%error, "no notes on lost jobs arrive now");
        }
        tokio::time::sleep(RETRY).await;
    }
}

async fn process_notes(client: &Client) -> Result<(), UnavailableError> {
    let notes = client.nats.dead_letters().await?;
    loop {
        let batch = notes.batch().max_messages(16).expires(FETCH_TIMEOUT).messages().await;
        let mut batch = batch.map_err(UnavailableError::new)?;
        while let Some(note) = batch.next().await {
            let note = note.map_err(UnavailableError::new)?;
            let is_done = match serde_json::from_slice(&note.payload) {
                Ok(Advisory { stream_seq }) => fail(client, stream_seq).await?,
                Err(_) => true,
            };
            // A process with the other layout, if there is one, takes the note.
            let kind = if is_done { AckKind::Ack } else { AckKind::Nak(Some(NAK_DELAY)) };
            note.double_ack_with(kind).await.map_err(UnavailableError::new)?;
        }
    }
}

/// Fails the job of a message and deletes the message. Returns false if the message has another layout.
async fn fail(client: &Client, sequence: u64) -> Result<bool, UnavailableError> {
    let Some((subject, payload)) = client.nats.message(sequence).await? else {
        return Ok(true);
    };
    if !has_own_layout(&subject) {
        return Ok(false);
    }
    if let Some(ticket) = Ticket::read(&subject, &payload) {
        let _shard = client.shard(ticket.key.id).await;
        client.refresh(ticket.key.id).await?;
        let failed = client.change(ticket.key.id, |record| {
            let ends = ticket.is_for(record);
            if ends {
                record.end(Outcome::Failed(Failure::TooManyAttempts));
            }
            ends
        });
        failed.await?;
    }
    client.nats.delete_message(sequence).await?;
    Ok(true)
}
