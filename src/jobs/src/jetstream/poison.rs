//! Jobs at which too many workers were lost: the broker tells of them.

use std::sync::Arc;
use std::time::Duration;

use async_nats::jetstream::AckKind;
use async_nats::jetstream::stream::RawMessageErrorKind;
use futures_util::StreamExt;
use serde::Deserialize;

use super::bus::{is_own, read_ticket, unavailable};
use super::client::Client;
use crate::threads::run::Outcome;
use crate::{Failure, Unavailable};

/// How soon the broker is asked again when it could not be.
const RETRY: Duration = Duration::from_secs(1);

/// How long one question waits for an answer.
const WAIT: Duration = Duration::from_secs(5);

/// When what is another layout's is offered again.
const LATER: Duration = Duration::from_secs(10);

/// What the broker says of a message.
#[derive(Deserialize)]
struct Advisory {
    stream_seq: u64,
}

pub(super) async fn give_up(client: Arc<Client>) {
    loop {
        if let Err(fault) = follow(&client).await {
            tracing::warn!(%fault, "the broker's notes on lost jobs are not heard of now");
        }
        tokio::time::sleep(RETRY).await;
    }
}

async fn follow(client: &Client) -> Result<(), Unavailable> {
    let notes = client.bus.poison().await?;
    loop {
        let mut batch = notes.batch().max_messages(16).expires(WAIT).messages().await.map_err(unavailable)?;
        while let Some(note) = batch.next().await {
            let note = note.map_err(unavailable)?;
            let failed = match serde_json::from_slice(&note.payload) {
                Ok(Advisory { stream_seq }) => fail(client, stream_seq).await?,
                Err(_) => true,
            };
            // What is another layout's is for a process that reads it, if there is one.
            let kind = if failed { AckKind::Ack } else { AckKind::Nak(Some(LATER)) };
            note.double_ack_with(kind).await.map_err(unavailable)?;
        }
    }
}

/// Fails the job of a message, and takes the message out of its line; whether it is one of this layout.
async fn fail(client: &Client, sequence: u64) -> Result<bool, Unavailable> {
    let message = match client.bus.queue.get_raw_message(sequence).await {
        Ok(message) => message,
        Err(fault) if fault.kind() == RawMessageErrorKind::NoMessageFound => return Ok(true),
        Err(fault) => return Err(unavailable(fault)),
    };
    if !is_own(&message.subject) {
        return Ok(false);
    }
    if let Some((id, life, turn)) = read_ticket(&message.subject, &message.payload) {
        let _shard = client.shard(id).await;
        client.refresh(id).await?;
        let failed = client.change(id, |record| {
            let ends = (record.life, record.turn) == (life, turn) && !record.job.state.is_final();
            if ends {
                record.end(Outcome::Failed(Failure::TooManyAttempts));
            }
            ends
        });
        failed.await?;
    }
    client.bus.queue.delete_message(sequence).await.map_err(unavailable)?;
    Ok(true)
}
