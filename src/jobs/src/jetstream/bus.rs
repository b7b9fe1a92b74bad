//! What the broker is asked for.

use std::collections::hash_map::RandomState;
use std::fmt::Display;
use std::hash::{BuildHasher, Hasher};
use std::time::Duration;

use async_nats::jetstream::consumer::{AckPolicy, Consumer, pull};
use async_nats::jetstream::context::GetStreamErrorKind;
use async_nats::jetstream::stream::{self, DiscardPolicy, RetentionPolicy, Stream};
use async_nats::jetstream::{self, Context, ErrorCode, kv};
use async_nats::{HeaderMap, header};
use bytes::Bytes;
use serde::{Deserialize, Serialize};

use super::config::{Config, ConnectError};
use super::denials::Denials;
use super::record::{LAYOUT, Record};
use crate::{JobId, Unavailable};

/// One of the lines in which jobs wait.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Line {
    /// Alone taken by the express lane.
    Small,
    /// Parts of what is not small itself: nobody waits for one of them alone, and those of a whole that has begun do not
    /// wait behind the wholes that have not.
    Parts,
    Large,
}

impl Line {
    pub(super) const ALL: [Self; 3] = [Self::Small, Self::Parts, Self::Large];

    fn name(self) -> &'static str {
        match self {
            Self::Small => "small",
            Self::Parts => "parts",
            Self::Large => "large",
        }
    }
}

pub(super) struct Bus {
    pub(super) client: async_nats::Client,
    pub(super) config: Config,
    pub(super) records: kv::Store,
    pub(super) queue: Stream,
    pub(super) context: Context,
    pub(super) denials: Denials,
}

/// Why a record was not written.
pub(super) enum WriteError {
    /// Another has written it since it was read.
    Conflict,
    Unavailable(Unavailable),
}

/// Longest a request to the broker takes.
const PATIENCE: Duration = Duration::from_secs(5);

impl Bus {
    pub(super) async fn connect(config: Config) -> Result<Self, ConnectError> {
        let (options, servers) = config.access().await?;
        let denials = Denials::default();
        let noted = denials.clone();
        let options = options.event_callback(move |event| {
            noted.note(event);
            std::future::ready(())
        });
        let client = options.connect(servers).await.map_err(ConnectError::from)?;
        let mut context = jetstream::new(client.clone());
        context.set_timeout(PATIENCE);
        let prepared = denials.or_denied(prepare(&context, &config)).await;
        let (records, queue) = prepared.map_err(ConnectError::Refused)??;
        let bus = Self { client, config, records, queue, context, denials };
        bus.check_permissions().await;
        Ok(bus)
    }

    /// Of the records; `None`: the broker has none, its directory was lost, or another took its place.
    pub(super) async fn last_revision(&self) -> Result<Option<u64>, String> {
        match self.context.get_stream(&self.records.stream_name).await {
            Ok(stream) => Ok(Some(stream.cached_info().state.last_sequence)),
            Err(fault) if is_missing(&fault.kind()) => Ok(None),
            Err(fault) => Err(fault.to_string()),
        }
    }

    /// Makes a broker that has lost all ready again.
    pub(super) async fn begin_anew(&self) -> Result<(), String> {
        prepare(&self.context, &self.config).await.map(drop).map_err(|fault| fault.to_string())
    }

    /// Its name, and the id of the job in each of its messages.
    pub(super) async fn consumer(&self, line: Line) -> Result<Consumer<pull::Config>, Unavailable> {
        self.queue.get_consumer(&consumer_name(line)).await.map_err(unavailable)
    }

    /// Of the broker's own, about jobs that were delivered too often.
    pub(super) async fn poison(&self) -> Result<Consumer<pull::Config>, Unavailable> {
        let name = format!("{}-poison", self.config.name);
        let queue = self.queue_name();
        let config = stream::Config {
            subjects: vec![format!("$JS.EVENT.ADVISORY.CONSUMER.MAX_DELIVERIES.{queue}.*")],
            retention: RetentionPolicy::WorkQueue,
            max_age: Duration::from_hours(7 * 24),
            num_replicas: self.config.replicas,
            name,
            ..stream::Config::default()
        };
        let stream = self.context.create_or_update_stream(config).await.map_err(unavailable)?;
        let stream = self.context.get_stream(stream.config.name).await.map_err(unavailable)?;
        let config = pull::Config {
            durable_name: Some("poison".to_owned()),
            ack_policy: AckPolicy::Explicit,
            ..pull::Config::default()
        };
        stream.create_consumer(config).await.map_err(unavailable)
    }

    fn queue_name(&self) -> String {
        format!("{}-queue", self.config.name)
    }

    fn place(&self, record: &Record) -> String {
        format!("{}{}", line_prefix(&self.config, record.line), record.job.id)
    }

    /// Puts a recorded job into its line. Again, it is there once: the message's id is that of its turn.
    pub(super) async fn publish(&self, record: &Record) -> Result<(), Unavailable> {
        let Record { life, turn, job, .. } = record;
        self.publish_as(record, format!("{}.{life}.{turn}", job.id)).await
    }

    /// Puts a job that is in its line at the line's end. The message that was there before is the caller's to remove; until
    /// then there are two for one turn.
    pub(super) async fn publish_again(&self, record: &Record) -> Result<(), Unavailable> {
        let Record { life, turn, job, .. } = record;
        let number: u64 = RandomState::new().build_hasher().finish();
        self.publish_as(record, format!("{}.{life}.{turn}.{number}", job.id)).await
    }

    async fn publish_as(&self, record: &Record, message: String) -> Result<(), Unavailable> {
        let mut headers = HeaderMap::new();
        headers.insert(header::NATS_MESSAGE_ID, message);
        let payload = Bytes::from(ticket(record));
        let published = self.context.publish_with_headers(self.place(record), headers, payload);
        published.await.map_err(unavailable)?.await.map_err(unavailable)?;
        Ok(())
    }

    /// Whether a job is in its line, waiting or taken.
    pub(super) async fn is_published(&self, record: &Record) -> Result<bool, Unavailable> {
        match self.queue.get_last_raw_message_by_subject(&self.place(record)).await {
            Ok(message) => Ok(message.payload.as_ref() == ticket(record).as_slice()),
            Err(fault) if fault.kind() == stream::LastRawMessageErrorKind::NoMessageFound => Ok(false),
            Err(fault) => Err(unavailable(fault)),
        }
    }

    pub(super) async fn read(&self, id: JobId) -> Result<Option<(Record, u64)>, Unavailable> {
        // Of the leader: any replica may answer for an entry, one that lags behind too.
        match self.records.stream.get_last_raw_message_by_subject(&self.subject(id)).await {
            Ok(message) => {
                let record = Record::decode(&message.payload);
                if record.is_none() {
                    tracing::error!(%id, "a record that cannot be read: removed");
                    self.forget(id, message.sequence).await;
                }
                Ok(record.map(|record| (record, message.sequence)))
            }
            Err(fault) if fault.kind() == stream::LastRawMessageErrorKind::NoMessageFound => Ok(None),
            Err(fault) => Err(unavailable(fault)),
        }
    }

    /// Writes a record in the place of that of `revision`, or the first of its job; its revision.
    pub(super) async fn write(&self, record: &Record, revision: Option<u64>) -> Result<u64, WriteError> {
        let key = key(record.job.id);
        let other = || WriteError::Unavailable(Unavailable("a record cannot be encoded".to_owned()));
        let value = record.encode().ok_or_else(other)?;
        let written = self.records.update(key, value, revision.unwrap_or(0)).await;
        written.map_err(|fault| match fault.kind() {
            kv::UpdateErrorKind::WrongLastRevision => WriteError::Conflict,
            _ => WriteError::Unavailable(unavailable(fault)),
        })
    }

    /// Forgets a job's record up to this revision; a later one stays.
    pub(super) async fn forget(&self, id: JobId, revision: u64) {
        // Another process may have, or will.
        drop(self.records.stream.purge().filter(self.subject(id)).sequence(revision + 1).await);
    }

    /// Of a record, in the bucket's stream.
    fn subject(&self, id: JobId) -> String {
        format!("{}{}", self.records.prefix, key(id))
    }

    /// Tells all processes something that need not last.
    pub(super) async fn tell(&self, subject: &str, payload: Vec<u8>) {
        let subject = format!("{}.{subject}", self.config.name);
        drop(self.client.publish(subject, payload.into()).await);
    }
}

/// Makes what is kept at the broker, where it is not there as it should be.
async fn prepare(context: &Context, config: &Config) -> Result<(kv::Store, Stream), ConnectError> {
    let records = context.create_or_update_key_value(records(config)).await.map_err(broker)?;
    let stream = context.create_or_update_stream(queue(config)).await.map_err(broker)?;
    let queue = context.get_stream(stream.config.name).await.map_err(broker)?;
    for line in Line::ALL {
        queue.create_consumer(consumer(config, line)).await.map_err(broker)?;
    }
    Ok((records, queue))
}

fn is_missing(fault: &GetStreamErrorKind) -> bool {
    matches!(fault, GetStreamErrorKind::JetStream(told) if told.error_code() == ErrorCode::STREAM_NOT_FOUND)
}

/// What a message says: for which life of its job it is, and for which turn in the queue.
fn ticket(record: &Record) -> Vec<u8> {
    [record.life.to_be_bytes().as_slice(), &record.turn.to_be_bytes()].concat()
}

/// Of a record, in the bucket.
fn key(id: JobId) -> String {
    format!("{LAYOUT}.{id}")
}

/// Of a record's key.
pub(super) fn read_key(key: &str) -> Option<JobId> {
    key.strip_prefix(LAYOUT)?.strip_prefix('.')?.parse().ok()
}

pub(super) fn line_prefix(config: &Config, line: Line) -> String {
    format!("{}.queue.{LAYOUT}.{}.", config.name, line.name())
}

fn consumer_name(line: Line) -> String {
    format!("{}-{LAYOUT}", line.name())
}

/// Nothing is at the broker longer than so after it was written last: also what only processes of another layout would
/// have forgotten.
fn longest(config: &Config) -> Duration {
    (4 * config.retention.age).max(Duration::from_hours(1))
}

/// Whether a message is of this layout.
pub(super) fn is_own(subject: &str) -> bool {
    subject.rsplit('.').nth(2) == Some(LAYOUT)
}

/// Job, life and turn of a message.
pub(super) fn read_ticket(subject: &str, payload: &[u8]) -> Option<(JobId, u64, u32)> {
    let id = subject.rsplit('.').next()?.parse().ok()?;
    let (life, turn) = payload.split_first_chunk::<8>()?;
    Some((id, u64::from_be_bytes(*life), u32::from_be_bytes(*turn.first_chunk()?)))
}

fn records(config: &Config) -> kv::Config {
    kv::Config {
        bucket: format!("{}-jobs", config.name),
        history: 1,
        max_age: longest(config),
        num_replicas: config.replicas,
        ..kv::Config::default()
    }
}

fn queue(config: &Config) -> stream::Config {
    stream::Config {
        name: format!("{}-queue", config.name),
        subjects: vec![format!("{}.queue.>", config.name)],
        retention: RetentionPolicy::WorkQueue,
        discard: DiscardPolicy::New,
        max_age: longest(config),
        num_replicas: config.replicas,
        duplicate_window: Duration::from_mins(2),
        ..stream::Config::default()
    }
}

fn consumer(config: &Config, line: Line) -> pull::Config {
    pull::Config {
        durable_name: Some(consumer_name(line)),
        ack_policy: AckPolicy::Explicit,
        ack_wait: config.ack_wait,
        max_deliver: i64::from(config.max_attempts.max(1)),
        // Jobs that wait for their parts are not acknowledged, and may be many.
        max_ack_pending: -1,
        filter_subject: format!("{}*", line_prefix(config, line)),
        ..pull::Config::default()
    }
}

fn broker(fault: impl Display) -> ConnectError {
    ConnectError::Broker(fault.to_string())
}

pub(super) fn unavailable(fault: impl Display) -> Unavailable {
    Unavailable(fault.to_string())
}
