//! Checks that the broker lets this process write.

use std::time::Duration;

use async_nats::jetstream::context::PublishErrorKind;
use async_nats::{HeaderMap, header};
use bytes::Bytes;
use futures_util::future;
use tokio::time::MissedTickBehavior;

use super::{Nats, names};
use crate::error::UnavailableError;
use crate::jetstream::queue_class::QueueClass;
use crate::jetstream::record::LAYOUT;

/// Time between two checks.
const INTERVAL: Duration = Duration::from_secs(10);

impl Nats {
    /// Checks again and again: the broker's permissions may change while it runs.
    pub(crate) async fn watch_permissions(&self) {
        let mut tick = tokio::time::interval(INTERVAL);
        tick.set_missed_tick_behavior(MissedTickBehavior::Delay);
        loop {
            tick.tick().await;
            if let Err(error) = self.check_writes().await {
                tracing::debug!(%error, "the broker does not answer whether this process may write");
            }
        }
    }

    /// Checks once. Returns at the first denial, which is noted then.
    pub(super) async fn check_permissions(&self) {
        drop(self.denials.or_denied(self.check_writes()).await);
    }

    /// Sends a record and a message for each queue that the broker must refuse, because they name a predecessor that
    /// does not exist. So nothing is written. The broker does not answer if it forbids the subject.
    async fn check_writes(&self) -> Result<(), UnavailableError> {
        let checks = self.checked_subjects().into_iter().map(|subject| async {
            let mut headers = HeaderMap::new();
            headers.insert(header::NATS_EXPECTED_LAST_SUBJECT_SEQUENCE, "1");
            let sent = self.context.publish_with_headers(subject, headers, Bytes::new());
            match sent.await.map_err(UnavailableError::new)?.await {
                Err(error) if error.kind() == PublishErrorKind::WrongLastSequence => Ok(()),
                Err(error) => Err(UnavailableError::new(error)),
                Ok(_) => Err(UnavailableError::new("the broker has accepted a record that it had to refuse")),
            }
        });
        future::try_join_all(checks).await.map(drop)
    }

    /// A subject of each kind that this process writes. Nothing is stored under them.
    fn checked_subjects(&self) -> Vec<String> {
        let queues = QueueClass::ALL.iter().map(|class| names::queue_prefix(&self.config, *class));
        let prefixes = queues.chain([format!("{}{LAYOUT}.", self.records.prefix)]);
        prefixes.map(|prefix| format!("{prefix}check")).collect()
    }
}
