//! Messages of queued jobs at the broker.

use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};

use async_nats::jetstream::consumer::{Consumer, pull};
use async_nats::jetstream::stream::{LastRawMessageErrorKind, RawMessageErrorKind};
use async_nats::{HeaderMap, header};
use bytes::Bytes;

use super::{Nats, names, streams};
use crate::error::UnavailableError;
use crate::jetstream::queue_class::QueueClass;
use crate::jetstream::record::{LAYOUT, Record};
use crate::job_id::JobKey;

/// A message in a queue: which generation of a job it is for, and which of its times in the queue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Ticket {
    pub(crate) key: JobKey,
    pub(crate) requeues: u32,
}

impl Ticket {
    /// The ticket of a message, if it is valid.
    pub(crate) fn read(subject: &str, payload: &[u8]) -> Option<Self> {
        let id = subject.rsplit('.').next()?.parse().ok()?;
        let (generation, requeues) = payload.split_first_chunk::<8>()?;
        let key = JobKey { id, generation: u64::from_be_bytes(*generation) };
        Some(Self { key, requeues: u32::from_be_bytes(*requeues.first_chunk()?) })
    }

    fn payload(record: &Record) -> Vec<u8> {
        [record.generation.to_be_bytes().as_slice(), &record.requeues.to_be_bytes()].concat()
    }

    /// Whether the record is for this ticket's time in the queue, and has not ended.
    pub(crate) fn is_for(&self, record: &Record) -> bool {
        self.key == record.key() && self.requeues == record.requeues && !record.job.state.is_final()
    }
}

impl Nats {
    /// The consumer of a queue.
    pub(crate) async fn consumer(
        &self,
        class: QueueClass,
    ) -> Result<Consumer<pull::Config>, UnavailableError> {
        self.queue.get_consumer(&names::consumer(class)).await.map_err(UnavailableError::new)
    }

    /// The consumer of the broker's notes on messages that it has delivered too often.
    pub(crate) async fn dead_letters(&self) -> Result<Consumer<pull::Config>, UnavailableError> {
        let config = streams::dead_letters(&self.config);
        let stream = self.context.create_or_update_stream(config).await.map_err(UnavailableError::new)?;
        let stream = self.context.get_stream(stream.config.name).await.map_err(UnavailableError::new)?;
        stream.create_consumer(streams::dead_letter_consumer()).await.map_err(UnavailableError::new)
    }

    /// Subject and payload of the message with this number; `None` if it is not in the queue any more.
    pub(crate) async fn message(&self, sequence: u64) -> Result<Option<(String, Bytes)>, UnavailableError> {
        match self.queue.get_raw_message(sequence).await {
            Ok(message) => Ok(Some((message.subject.to_string(), message.payload))),
            Err(error) if error.kind() == RawMessageErrorKind::NoMessageFound => Ok(None),
            Err(error) => Err(UnavailableError::new(error)),
        }
    }

    pub(crate) async fn delete_message(&self, sequence: u64) -> Result<(), UnavailableError> {
        self.queue.delete_message(sequence).await.map(drop).map_err(UnavailableError::new)
    }

    /// Queues a recorded job. The broker drops a repetition, since the message has the same id.
    pub(crate) async fn publish(&self, record: &Record) -> Result<(), UnavailableError> {
        let Record { generation, requeues, job, .. } = record;
        self.publish_as(record, format!("{}.{generation}.{requeues}", job.id)).await
    }

    /// Queues a queued job at the end of its queue. The caller must remove the first message; until then the job has
    /// two.
    pub(crate) async fn publish_at_end(&self, record: &Record) -> Result<(), UnavailableError> {
        let Record { generation, requeues, job, .. } = record;
        let number: u64 = RandomState::new().build_hasher().finish();
        self.publish_as(record, format!("{}.{generation}.{requeues}.{number}", job.id)).await
    }

    async fn publish_as(&self, record: &Record, message_id: String) -> Result<(), UnavailableError> {
        let mut headers = HeaderMap::new();
        headers.insert(header::NATS_MESSAGE_ID, message_id);
        let payload = Bytes::from(Ticket::payload(record));
        let published = self.context.publish_with_headers(self.queue_subject(record), headers, payload);
        published.await.map_err(UnavailableError::new)?.await.map_err(UnavailableError::new)?;
        Ok(())
    }

    /// Whether a job's message is in its queue, delivered or not.
    pub(crate) async fn is_published(&self, record: &Record) -> Result<bool, UnavailableError> {
        match self.queue.get_last_raw_message_by_subject(&self.queue_subject(record)).await {
            Ok(message) => Ok(message.payload.as_ref() == Ticket::payload(record).as_slice()),
            Err(error) if error.kind() == LastRawMessageErrorKind::NoMessageFound => Ok(false),
            Err(error) => Err(UnavailableError::new(error)),
        }
    }

    fn queue_subject(&self, record: &Record) -> String {
        format!("{}{}", names::queue_prefix(&self.config, record.class), record.job.id)
    }
}

/// Whether a message in a queue has this layout.
pub(crate) fn has_own_layout(subject: &str) -> bool {
    subject.rsplit('.').nth(2) == Some(LAYOUT)
}
