//! What has been answered, under its id: the question with its figures, the mesh, and each file that was asked for.

use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use verne_mesh::{Mesh, packed};
use verne_store::{Content, Found, Kept as Durability, Store};

use crate::operations::question::Question;
use crate::wire::error::OperationError;
use crate::wire::result_id::ResultId;

/// An answered question.
#[derive(Debug)]
pub(crate) struct Record {
    /// The question.
    pub question: Question,
    /// The figures, as they are sent.
    pub summary: Content,
    /// Greatest |alpha|, rad, of a workspace that is not empty.
    pub inclination: Option<f64>,
}

/// A record as it is kept.
#[derive(Serialize, Deserialize)]
struct Kept<'a> {
    #[serde(borrow)]
    question: &'a RawValue,
    #[serde(borrow)]
    summary: &'a RawValue,
    inclination: Option<f64>,
}

const RECORD: &str = "record";
/// The part that is a workspace's mesh.
pub(crate) const MESH: &str = "mesh";

/// The part that lists the points of a dexterity map.
pub(crate) const CELLS: &str = "cells";

/// The results that are kept. Its clones are one.
#[derive(Clone)]
pub(crate) struct Results {
    store: Store,
}

impl Results {
    /// The results of a store.
    pub(crate) fn new(store: Store) -> Self {
        Self { store }
    }

    /// Whether other processes look for results here.
    pub(crate) fn are_shared(&self) -> bool {
        self.store.is_shared()
    }

    /// Where they are kept.
    pub(crate) fn store(&self) -> Store {
        self.store.clone()
    }

    /// Whether more can be kept.
    pub(crate) async fn healthy(&self) -> Result<(), OperationError> {
        self.store.healthy().await.map_err(|reason| {
            tracing::error!(reason, "cannot store results");
            OperationError::StoreUnavailable
        })
    }

    /// The record of an answered question. One that cannot be read is as if not there: another version wrote it.
    pub(crate) async fn record(&self, id: ResultId) -> Option<Record> {
        let content = self.store.get(&id.key(RECORD)).await?;
        read(&content.bytes, id)
    }

    /// Keeps an answer, its parts first: where there is a record, there were parts.
    pub(crate) async fn keep(
        &self,
        question: &Question,
        summary: &[u8],
        parts: Vec<(&str, Vec<u8>)>,
        inclination: Option<f64>,
    ) -> Result<(), OperationError> {
        let id = question.id();
        for (name, bytes) in parts {
            self.keep_part(id, name, bytes).await?;
        }
        let (question, summary) = (raw(&question.written()?)?, raw(summary)?);
        let kept = Kept { question: &question, summary: &summary, inclination };
        let bytes = serde_json::to_vec(&kept).map_err(|_| OperationError::Internal)?;
        self.keep_part(id, RECORD, bytes).await.map(drop)
    }

    /// Keeps a part of a result. Where other processes look for it, memory is not enough.
    pub(crate) async fn keep_part(
        &self,
        id: ResultId,
        name: &str,
        bytes: Vec<u8>,
    ) -> Result<Content, OperationError> {
        match self.store.put(&id.key(name), bytes.into()).await {
            (_, Durability::MemoryOnly) if self.are_shared() => Err(OperationError::StoreUnavailable),
            (content, _) => Ok(content),
        }
    }

    /// A part of a result, to be sent.
    pub(crate) async fn found(&self, id: ResultId, name: &str) -> Option<Found> {
        self.store.find(&id.key(name)).await
    }

    /// A part of a result, whole.
    pub(crate) async fn part(&self, id: ResultId, name: &str) -> Option<Content> {
        self.store.get(&id.key(name)).await
    }

    /// A part of a result, made if it is not there.
    ///
    /// `None` where what it is made of is not there either.
    pub(crate) async fn part_or<E: Clone + Send + Sync + 'static>(
        &self,
        id: ResultId,
        name: &str,
        make: impl Future<Output = Result<Option<Vec<u8>>, E>> + Send,
    ) -> Result<Option<Content>, E> {
        // The store keeps what is made, and nothing else.
        let make = async { make.await.map_err(Some)?.map(Into::into).ok_or(None) };
        match self.store.get_or_make(&id.key(name), make).await {
            Ok(content) => Ok(Some(content)),
            Err(None) => Ok(None),
            Err(Some(error)) => Err(error),
        }
    }
}

/// A mesh as a part of a result.
pub(crate) fn packed_mesh(mesh: &Mesh) -> Result<Vec<u8>, OperationError> {
    packed::pack(mesh).map_err(|_| OperationError::Internal)
}

/// A mesh that is part of a result. One that cannot be read is as if not there: another version wrote it.
pub(crate) fn unpacked_mesh(part: &Content) -> Option<Mesh> {
    packed::unpack(&part.bytes).ok()
}

fn raw(json: &[u8]) -> Result<Box<RawValue>, OperationError> {
    let text = std::str::from_utf8(json).map_err(|_| OperationError::Internal)?;
    RawValue::from_string(text.to_owned()).map_err(|_| OperationError::Internal)
}

fn read(bytes: &[u8], id: ResultId) -> Option<Record> {
    let kept: Kept<'_> = serde_json::from_slice(bytes).ok()?;
    let question = Question::read(kept.question.get().as_bytes(), id).ok()?;
    let summary = content(kept.summary.get().as_bytes().to_vec());
    Some(Record { question, summary, inclination: kept.inclination })
}

/// Bytes with their hash; for what is small, or on the worker threads.
pub(crate) fn content(bytes: Vec<u8>) -> Content {
    Content { hash: blake3::hash(&bytes), bytes: bytes.into() }
}
