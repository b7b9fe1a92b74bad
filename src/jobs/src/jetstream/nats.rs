//! The connection to the broker.

mod names;
mod permission_check;
pub(super) mod queue;
pub(super) mod records;
mod streams;

use std::time::Duration;

use async_nats::jetstream::context::GetStreamErrorKind;
use async_nats::jetstream::stream::Stream;
use async_nats::jetstream::{self, Context, ErrorCode, kv};

use super::config::{Config, ConnectError};
use super::denials::Denials;

/// Longest time of a request to the broker.
const TIMEOUT: Duration = Duration::from_secs(5);

pub(super) struct Nats {
    pub(super) client: async_nats::Client,
    pub(super) config: Config,
    pub(super) records: kv::Store,
    pub(super) denials: Denials,
    queue: Stream,
    context: Context,
}

impl Nats {
    /// Connects, and creates the streams and consumers that are missing.
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
        context.set_timeout(TIMEOUT);
        let prepared = denials.or_denied(streams::prepare(&context, &config)).await;
        let (records, queue) = prepared.map_err(ConnectError::Refused)??;
        let nats = Self { client, config, records, denials, queue, context };
        nats.check_permissions().await;
        Ok(nats)
    }

    /// The last revision of all records. `None` if the broker has none: it has lost its directory, or another broker
    /// has taken its place.
    pub(super) async fn last_revision(&self) -> Result<Option<u64>, String> {
        match self.context.get_stream(&self.records.stream_name).await {
            Ok(stream) => Ok(Some(stream.cached_info().state.last_sequence)),
            Err(error) if is_missing(&error.kind()) => Ok(None),
            Err(error) => Err(error.to_string()),
        }
    }

    /// Creates streams and consumers again at a broker that has lost them.
    pub(super) async fn prepare_again(&self) -> Result<(), String> {
        streams::prepare(&self.context, &self.config).await.map(drop).map_err(|error| error.to_string())
    }

    /// Sends a message that need not last to all processes.
    pub(super) async fn broadcast(&self, subject: &str, payload: Vec<u8>) {
        let subject = format!("{}.{subject}", self.config.name);
        drop(self.client.publish(subject, payload.into()).await);
    }
}

fn is_missing(error: &GetStreamErrorKind) -> bool {
    matches!(error, GetStreamErrorKind::JetStream(cause) if cause.error_code() == ErrorCode::STREAM_NOT_FOUND)
}
