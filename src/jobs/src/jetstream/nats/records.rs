//! Records of jobs at the broker.

use async_nats::jetstream::{kv, stream};

use super::{Nats, names};
use crate::error::UnavailableError;
use crate::jetstream::record::{LAYOUT, Record};
use crate::job_id::JobId;

/// A record was not written.
pub(crate) enum WriteError {
    /// Another process has written it since it was read.
    Conflict,
    Unavailable(UnavailableError),
}

impl Nats {
    /// Reads a record and its revision.
    pub(crate) async fn read(&self, id: JobId) -> Result<Option<(Record, u64)>, UnavailableError> {
        // Asks the leader. A direct read may be answered by a replica that lags behind.
        match self.records.stream.get_last_raw_message_by_subject(&self.subject(id)).await {
            Ok(message) => {
                let record = Record::decode(&message.payload);
                if record.is_none() {
                    tracing::error!(%id, "a record cannot be decoded; deleting it");
                    self.forget(id, message.sequence).await;
                }
                Ok(record.map(|record| (record, message.sequence)))
            }
            Err(error) if error.kind() == stream::LastRawMessageErrorKind::NoMessageFound => Ok(None),
            Err(error) => Err(UnavailableError::new(error)),
        }
    }

    /// Replaces the record with this revision, or writes a job's first record. Returns the new revision.
    pub(crate) async fn write(&self, record: &Record, revision: Option<u64>) -> Result<u64, WriteError> {
        let not_encoded = || WriteError::Unavailable(UnavailableError::new("a record cannot be encoded"));
        let value = record.encode().ok_or_else(not_encoded)?;
        let written =
            self.records.update(names::record_key(record.job.id), value, revision.unwrap_or(0)).await;
        written.map_err(|error| match error.kind() {
            kv::UpdateErrorKind::WrongLastRevision => WriteError::Conflict,
            _ => WriteError::Unavailable(UnavailableError::new(error)),
        })
    }

    /// Deletes a job's record up to this revision.
    pub(crate) async fn forget(&self, id: JobId, revision: u64) {
        // If it fails, another process has deleted the record, or will.
        drop(self.records.stream.purge().filter(self.subject(id)).sequence(revision + 1).await);
    }

    /// Subject of a record in the bucket's stream.
    fn subject(&self, id: JobId) -> String {
        format!("{}{}", self.records.prefix, names::record_key(id))
    }
}

/// The job of a key in the bucket, if the record has this layout.
pub(crate) fn job_of_key(key: &str) -> Option<JobId> {
    key.strip_prefix(LAYOUT)?.strip_prefix('.')?.parse().ok()
}
