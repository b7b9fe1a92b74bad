//! A job that the broker has given to this worker.

use std::pin::pin;
use std::time::Duration;

use async_nats::jetstream::{self, AckKind};
use futures_util::StreamExt;
use tokio::time::timeout;

use crate::jetstream::bus::{Line, read_ticket, unavailable};
use crate::jetstream::client::Client;
use crate::jetstream::record::Record;
use crate::{JobId, Unavailable};

/// An answer that is later than so does not come.
const GONE: Duration = Duration::from_secs(1);

pub(super) struct Delivery {
    pub(super) id: JobId,
    pub(super) life: u64,
    pub(super) turn: u32,
    message: jetstream::Message,
}

/// The next job of a line; `None`: none now, or for so long.
pub(super) async fn next(
    client: &Client,
    line: Line,
    wait: Option<Duration>,
) -> Result<Option<Delivery>, Unavailable> {
    let consumer = client.bus.consumer(line).await?;
    let batch = match wait {
        Some(wait) => consumer.batch().max_messages(1).expires(wait).messages().await.map_err(unavailable)?,
        None => consumer.fetch().max_messages(1).messages().await.map_err(unavailable)?,
    };
    let mut batch = pin!(batch);
    // The broker may have gone, and the question with it.
    let Ok(Some(message)) = timeout(wait.unwrap_or_default() + GONE, batch.next()).await else {
        return Ok(None);
    };
    let message = message.map_err(unavailable)?;
    if let Some((id, life, turn)) = read_ticket(&message.subject, &message.payload) {
        return Ok(Some(Delivery { id, life, turn, message }));
    }
    tracing::warn!(subject = %message.subject, "what is queued there is no job");
    message.double_ack_with(AckKind::Term).await.map_err(unavailable)?;
    Ok(None)
}

impl Delivery {
    /// Whether it is this turn's, and that is not over.
    pub(super) fn is_for(&self, record: &Record) -> bool {
        (record.life, record.turn) == (self.life, self.turn) && !record.job.state.is_final()
    }

    /// Whether the broker has given it to a worker before.
    pub(super) fn is_redelivered(&self) -> bool {
        self.message.info().is_ok_and(|info| info.delivered > 1)
    }

    /// Whether its record must have been written since: what was read is not the last.
    pub(super) fn is_ahead_of(&self, record: &Record) -> bool {
        (record.life, record.turn) < (self.life, self.turn)
    }

    /// Puts a queued job at the end of its line; whether it is there.
    pub(super) async fn put_behind(&self, client: &Client) -> bool {
        let known = client.mirror.read(self.id).map(|(record, _)| record);
        let Some(record) = known.filter(|record| self.is_for(record)) else {
            return false;
        };
        match client.bus.publish_again(&record).await {
            Ok(()) => {
                self.done().await;
                true
            }
            Err(fault) => {
                tracing::debug!(%fault, "a job stays where it is in its line");
                false
            }
        }
    }

    /// The job is recorded as done, or as somebody else's; the broker forgets it. If that fails it comes again, and is found
    /// to be done.
    pub(super) async fn done(&self) {
        if let Err(fault) = self.message.double_ack().await {
            tracing::debug!(%fault, "a job is done and its message stays");
        }
    }

    /// Tells the broker that somebody is at it, for as long as this is polled.
    pub(super) async fn in_hand(&self, ack_wait: Duration) {
        loop {
            tokio::time::sleep(ack_wait / 3).await;
            if let Err(fault) = self.message.ack_with(AckKind::Progress).await {
                tracing::debug!(%fault, "the broker was not told that a job runs");
            }
        }
    }
}
