//! Names at the broker.

use crate::jetstream::config::Config;
use crate::jetstream::queue_class::QueueClass;
use crate::jetstream::record::LAYOUT;
use crate::job_id::JobId;

/// The stream of queued and running jobs.
pub(super) fn queue(config: &Config) -> String {
    format!("{}-queue", config.name)
}

/// The consumer of a queue.
pub(super) fn consumer(class: QueueClass) -> String {
    format!("{}-{LAYOUT}", class.name())
}

/// Prefix of the subjects of a queue's messages.
pub(super) fn queue_prefix(config: &Config, class: QueueClass) -> String {
    format!("{}.queue.{LAYOUT}.{}.", config.name, class.name())
}

/// Key of a record in the bucket.
pub(super) fn record_key(id: JobId) -> String {
    format!("{LAYOUT}.{id}")
}
