//! The store behind the memory cache: a directory of this process, or a store that many processes share.

use std::sync::Arc;

use crate::content::Content;
use crate::disk::Disk;
use crate::error::BackingStoreError;
use crate::key::Key;
use crate::object_io::ObjectIo;
use crate::object_reader::{ObjectError, ObjectReader};
use crate::shared::Shared;
use crate::stats::Counters;

/// A backing store whose failures are logged and counted.
#[derive(Clone)]
pub(crate) struct BackingStore {
    kind: Kind,
    counters: Arc<Counters>,
}

#[derive(Clone)]
pub(crate) enum Kind {
    Disk(Arc<Disk>),
    Shared(Arc<Shared>),
}

impl BackingStore {
    pub(crate) fn new(kind: Kind, counters: Arc<Counters>) -> Self {
        Self { kind, counters }
    }

    /// The object of a key with an intact header. A damaged or unreadable object counts as absent.
    pub(crate) async fn open(&self, key: Key) -> Option<ObjectReader> {
        match ObjectReader::open(self.io().clone(), key).await {
            Ok(object) => object,
            Err(error) => {
                self.report(key, &error).await;
                None
            }
        }
    }

    /// The whole content of an object. A damaged or unreadable object counts as absent.
    pub(crate) async fn content(&self, object: &ObjectReader) -> Option<Content> {
        match object.content().await {
            Ok(content) => Some(content),
            Err(error) => {
                self.report(object.key(), &error).await;
                None
            }
        }
    }

    /// Logs and counts why an object could not be read; removes a damaged object.
    pub(crate) async fn report(&self, key: Key, error: &ObjectError) {
        match error {
            ObjectError::Damaged(damage, version) => {
                self.counters.damaged.add(1);
                tracing::error!(%key, error = %damage, "removing a damaged object");
                let version = version.clone();
                let removed = match self.kind.clone() {
                    Kind::Disk(disk) => tokio::spawn(async move { disk.remove_damaged(key, &version).await }),
                    Kind::Shared(shared) => {
                        tokio::spawn(async move { shared.remove_damaged(key, &version).await })
                    }
                };
                if let Err(error) = removed.await.map_err(BackingStoreError::from).flatten() {
                    tracing::error!(%key, %error, "cannot remove a damaged object");
                }
            }
            ObjectError::Unreadable(error) => {
                self.counters.read_failures.add(1);
                tracing::error!(%key, %error, "cannot read an object");
            }
        }
    }

    /// Writes the object of a content; returns whether it will be found after a restart, or by other processes.
    pub(crate) async fn write(&self, key: Key, content: &Content) -> bool {
        let content = content.clone();
        // A task of its own: a caller that is dropped must leave neither an object that the index does not count nor
        // the parts of an upload.
        let written = match self.kind.clone() {
            Kind::Disk(disk) if !disk.has_room_for(&content) => return false,
            Kind::Disk(disk) => tokio::spawn(async move { disk.write(key, &content).await }),
            Kind::Shared(shared) => tokio::spawn(async move { shared.write(key, &content).await }),
        };
        match written.await.map_err(BackingStoreError::from).flatten() {
            Ok(()) => true,
            Err(error) => {
                self.counters.write_failures.add(1);
                tracing::error!(%key, %error, "cannot store a result");
                false
            }
        }
    }

    /// Records a use of a key, where uses decide what is evicted.
    pub(crate) async fn record_use(&self, key: Key) {
        if let Kind::Disk(disk) = &self.kind {
            disk.record_use(key).await;
        }
    }

    /// Whether an object can be written now, or could a few seconds ago.
    pub(crate) async fn healthy(&self) -> Result<(), String> {
        match &self.kind {
            Kind::Disk(disk) => disk.healthy().await,
            Kind::Shared(shared) => shared.healthy().await,
        }
    }

    /// Whether other processes read what is written here.
    pub(crate) fn is_shared(&self) -> bool {
        matches!(self.kind, Kind::Shared(_))
    }

    /// Bytes of all objects, where that is known.
    pub(crate) fn bytes(&self) -> Option<u64> {
        match &self.kind {
            Kind::Disk(disk) => Some(disk.bytes()),
            Kind::Shared(_) => None,
        }
    }

    fn io(&self) -> &ObjectIo {
        match &self.kind {
            Kind::Disk(disk) => disk.io(),
            Kind::Shared(shared) => shared.io(),
        }
    }
}
