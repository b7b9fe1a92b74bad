//! The layer below memory: a disk of the process's own, or a store that it shares with others.

use std::sync::Arc;

use crate::disk::Disk;
use crate::objects::{Fault, Object, Objects};
use crate::shared::Shared;
use crate::stats::Counts;
use crate::{Content, Key};

#[derive(Clone)]
pub(crate) struct Below {
    layer: Layer,
    counts: Arc<Counts>,
}

#[derive(Clone)]
pub(crate) enum Layer {
    Disk(Arc<Disk>),
    Shared(Arc<Shared>),
}

impl Below {
    pub(crate) fn new(layer: Layer, counts: Arc<Counts>) -> Self {
        Self { layer, counts }
    }

    /// The object of a key with a sound header. One that has none, or cannot be read, is as if not there.
    pub(crate) async fn open(&self, key: Key) -> Option<Object> {
        match self.objects().open(key).await {
            Ok(object) => object,
            Err(fault) => {
                self.note(key, &fault).await;
                None
            }
        }
    }

    /// The whole content of an object, checked. What is damaged is as if not there.
    pub(crate) async fn content(&self, object: &Object) -> Option<Content> {
        match object.content().await {
            Ok(content) => Some(content),
            Err(fault) => {
                self.note(object.key(), &fault).await;
                None
            }
        }
    }

    /// Logs and counts why an object could not be read; removes one that is damaged.
    pub(crate) async fn note(&self, key: Key, fault: &Fault) {
        match fault {
            Fault::Damaged(damage, seen) => {
                self.counts.damaged.add(1);
                tracing::error!(%key, %damage, "a damaged object: removed");
                match &self.layer {
                    Layer::Disk(disk) => disk.remove_damaged(key, seen.clone()).await,
                    Layer::Shared(shared) => shared.remove_damaged(key, seen.clone()).await,
                }
            }
            Fault::Refused(fault) => {
                self.counts.read_failures.add(1);
                tracing::error!(%key, %fault, "an object cannot be read");
            }
        }
    }

    /// Writes a content's object; answers whether it will be there after a restart.
    pub(crate) async fn write(&self, key: Key, content: &Content) -> bool {
        match &self.layer {
            Layer::Disk(disk) => disk.write(key, content).await,
            Layer::Shared(shared) => shared.write(key, content).await,
        }
    }

    /// Notes that a key was asked for, where that decides who has to go.
    pub(crate) async fn touch(&self, key: Key) {
        if let Layer::Disk(disk) = &self.layer {
            disk.touch(key).await;
        }
    }

    /// Whether an object can be written now, or could a few seconds ago.
    pub(crate) async fn healthy(&self) -> Result<(), String> {
        match &self.layer {
            Layer::Disk(disk) => disk.healthy().await,
            Layer::Shared(shared) => shared.healthy().await,
        }
    }

    /// Whether other processes look for what is written here.
    pub(crate) fn is_shared(&self) -> bool {
        matches!(self.layer, Layer::Shared(_))
    }

    /// Bytes of all objects, where that is known.
    pub(crate) fn bytes(&self) -> Option<u64> {
        match &self.layer {
            Layer::Disk(disk) => Some(disk.total()),
            Layer::Shared(_) => None,
        }
    }

    fn objects(&self) -> &Objects {
        match &self.layer {
            Layer::Disk(disk) => disk.objects(),
            Layer::Shared(shared) => shared.objects(),
        }
    }
}
