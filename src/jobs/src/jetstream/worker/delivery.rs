//! A message of a queue that the broker has delivered to this worker.

use std::pin::pin;
use std::time::Duration;

use async_nats::jetstream::{self, AckKind};
use futures_util::StreamExt;
use tokio::time::timeout;

use crate::error::UnavailableError;
use crate::jetstream::client::Client;
use crate::jetstream::nats::queue::Ticket;
use crate::jetstream::queue_class::QueueClass;
use crate::jetstream::record::Record;
use crate::job_id::JobId;

/// Longest time to wait for an answer after the broker's own limit.
const ANSWER_TIMEOUT: Duration = Duration::from_secs(1);

pub(super) struct Delivery {
    pub(super) ticket: Ticket,
    message: jetstream::Message,
}

/// Requests the next job of a queue. Waits at most for `wait`; without it, does not wait.
pub(super) async fn next(
    client: &Client,
    class: QueueClass,
    wait: Option<Duration>,
) -> Result<Option<Delivery>, UnavailableError> {
    let consumer = client.nats.consumer(class).await?;
    let batch = match wait {
        Some(wait) => consumer.batch().max_messages(1).expires(wait).messages().await,
        None => consumer.fetch().max_messages(1).messages().await,
    };
    let mut batch = pin!(batch.map_err(UnavailableError::new)?);
    // The broker may be gone, and the request with it.
    let Ok(Some(message)) = timeout(wait.unwrap_or_default() + ANSWER_TIMEOUT, batch.next()).await else {
        return Ok(None);
    };
    let message = message.map_err(UnavailableError::new)?;
    if let Some(ticket) = Ticket::read(&message.subject, &message.payload) {
        return Ok(Some(Delivery { ticket, message }));
    }
    tracing::warn!(subject = %message.subject, "a message in a queue is not a job; deleting it");
    message.double_ack_with(AckKind::Term).await.map_err(UnavailableError::new)?;
    Ok(None)
}

impl Delivery {
    pub(super) fn id(&self) -> JobId {
        self.ticket.key.id
    }

    /// Whether the broker has delivered it to a worker before.
    pub(super) fn is_redelivered(&self) -> bool {
        self.message.info().is_ok_and(|info| info.delivered > 1)
    }

    /// Whether the record is older than the message, so a later one must exist.
    pub(super) fn is_newer_than(&self, record: &Record) -> bool {
        (record.generation, record.requeues) < (self.ticket.key.generation, self.ticket.requeues)
    }

    /// Moves a queued job to the end of its queue. Returns whether it did.
    pub(super) async fn move_back(&self, client: &Client) -> bool {
        let known = client.replica.read(self.id()).map(|(record, _)| record);
        let Some(record) = known.filter(|record| self.ticket.is_for(record)) else {
            return false;
        };
        match client.nats.publish_at_end(&record).await {
            Ok(()) => {
                self.acknowledge().await;
                true
            }
            Err(error) => {
                tracing::debug!(%error, "a job is not moved to the end of its queue");
                false
            }
        }
    }

    /// Deletes the message: the job has ended, or has another message. If that fails, the message comes again and has
    /// no effect.
    pub(super) async fn acknowledge(&self) {
        if let Err(error) = self.message.double_ack().await {
            tracing::debug!(%error, "the message of an ended job is not deleted");
        }
    }

    /// Sends keep-alive messages to the broker while it is polled.
    pub(super) async fn hold(&self, ack_wait: Duration) {
        loop {
            tokio::time::sleep(ack_wait / 3).await;
            if let Err(error) = self.message.ack_with(AckKind::Progress).await {
                tracing::debug!(%error, "the broker did not receive a keep-alive message");
            }
        }
    }
}
