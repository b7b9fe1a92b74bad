//! Streams and consumers at the broker.

use std::fmt::Display;
use std::time::Duration;

use async_nats::jetstream::consumer::{AckPolicy, pull};
use async_nats::jetstream::stream::{self, DiscardPolicy, RetentionPolicy, Stream};
use async_nats::jetstream::{Context, kv};

use super::names;
use crate::jetstream::config::{Config, ConnectError};
use crate::jetstream::queue_class::QueueClass;

/// Creates the bucket of records, the stream of queued jobs and its consumers, or adapts them to the settings.
pub(super) async fn prepare(context: &Context, config: &Config) -> Result<(kv::Store, Stream), ConnectError> {
    let records = context.create_or_update_key_value(records(config)).await.map_err(broker)?;
    let stream = context.create_or_update_stream(queue(config)).await.map_err(broker)?;
    let queue = context.get_stream(stream.config.name).await.map_err(broker)?;
    for class in QueueClass::ALL {
        queue.create_consumer(consumer(config, class)).await.map_err(broker)?;
    }
    Ok((records, queue))
}

/// The broker deletes what is older than this, also what only processes with another layout would delete.
fn max_age(config: &Config) -> Duration {
    (4 * config.retention.age).max(Duration::from_hours(1))
}

fn records(config: &Config) -> kv::Config {
    kv::Config {
        bucket: format!("{}-jobs", config.name),
        history: 1,
        max_age: max_age(config),
        num_replicas: config.replicas,
        ..kv::Config::default()
    }
}

fn queue(config: &Config) -> stream::Config {
    stream::Config {
        name: names::queue(config),
        subjects: vec![format!("{}.queue.>", config.name)],
        retention: RetentionPolicy::WorkQueue,
        discard: DiscardPolicy::New,
        max_age: max_age(config),
        num_replicas: config.replicas,
        duplicate_window: Duration::from_mins(2),
        ..stream::Config::default()
    }
}

fn consumer(config: &Config, class: QueueClass) -> pull::Config {
    pull::Config {
        durable_name: Some(names::consumer(class)),
        ack_policy: AckPolicy::Explicit,
        ack_wait: config.ack_wait,
        max_deliver: i64::from(config.max_attempts.max(1)),
        // Jobs that wait for their subtasks are not acknowledged, and may be many.
        max_ack_pending: -1,
        filter_subject: format!("{}*", names::queue_prefix(config, class)),
        ..pull::Config::default()
    }
}

/// The stream of the broker's notes on messages that it has delivered too often.
pub(super) fn dead_letters(config: &Config) -> stream::Config {
    let queue = names::queue(config);
    stream::Config {
        name: format!("{}-poison", config.name),
        subjects: vec![format!("$JS.EVENT.ADVISORY.CONSUMER.MAX_DELIVERIES.{queue}.*")],
        retention: RetentionPolicy::WorkQueue,
        max_age: Duration::from_hours(7 * 24),
        num_replicas: config.replicas,
        ..stream::Config::default()
    }
}

pub(super) fn dead_letter_consumer() -> pull::Config {
    pull::Config {
        durable_name: Some("poison".to_owned()),
        ack_policy: AckPolicy::Explicit,
        ..pull::Config::default()
    }
}

fn broker(error: impl Display) -> ConnectError {
    ConnectError::Broker(error.to_string())
}
