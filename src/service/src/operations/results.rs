//! Stored results. A result is a record (its question and its summary) and named blobs: meshes, mesh files, grid cells.

use bytes::Bytes;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use verne_mesh::{Mesh, packed};
use verne_store::{Content, ContentReader, Durability, Store};

use crate::operations::question::Question;
use crate::operations::question_cache::QuestionCache;
use crate::operations::question_text::{QuestionHeader, QuestionKind};
use crate::wire::error::OperationError;
use crate::wire::result_id::ResultId;

/// The blob with the question and the summary of a result.
const RECORD: &str = "record";

/// The blob with the mesh of a workspace.
pub(crate) const MESH: &str = "mesh";

/// The blob with the points of a dexterity map or of an error map.
pub(crate) const CELLS: &str = "cells";

/// The record of a result.
#[derive(Debug)]
pub(crate) struct Record {
    /// The result.
    pub id: ResultId,
    /// The kind of its question.
    pub kind: QuestionKind,
    /// The summary, as it is sent.
    pub summary: Content,
    /// Greatest |alpha|, rad, of a workspace that is not empty.
    pub inclination: Option<f64>,
    /// The question's text.
    pub question: Bytes,
}

/// A record as JSON.
#[derive(Serialize, Deserialize)]
struct RecordText<'a> {
    #[serde(borrow)]
    question: &'a RawValue,
    #[serde(borrow)]
    summary: &'a RawValue,
    inclination: Option<f64>,
}

impl Record {
    /// Reads a record; nothing if another version wrote it.
    fn read(id: ResultId, bytes: &Bytes) -> Option<Self> {
        let text: RecordText<'_> = serde_json::from_slice(bytes).ok()?;
        let [question, summary] =
            [text.question, text.summary].map(|part| bytes.slice_ref(part.get().as_bytes()));
        let kind = QuestionHeader::read(&question).ok()?.kind;
        Some(Self { id, kind, summary: hashed(summary), inclination: text.inclination, question })
    }
}

/// The stored results, and the typed questions of recent ones. Its clones share one store.
#[derive(Clone)]
pub(crate) struct Results {
    store: Store,
    /// The questions that were asked or read last.
    pub questions: QuestionCache,
}

impl Results {
    /// The results of a store.
    pub(crate) fn new(store: Store) -> Self {
        Self { store, questions: QuestionCache::new() }
    }

    /// Whether other processes use the same store.
    pub(crate) fn are_shared(&self) -> bool {
        self.store.is_shared()
    }

    /// The store.
    pub(crate) fn store(&self) -> Store {
        self.store.clone()
    }

    /// Whether the store takes results.
    pub(crate) async fn healthy(&self) -> Result<(), OperationError> {
        self.store.healthy().await.map_err(|reason| {
            tracing::error!(reason, "cannot store results");
            OperationError::StoreUnavailable
        })
    }

    /// The record of a result; nothing if there is none, or if another version wrote it.
    pub(crate) async fn record(&self, id: ResultId) -> Option<Record> {
        let content = self.store.get(&id.key(RECORD)).await?;
        Record::read(id, &content.bytes)
    }

    /// Stores the record of a result. Store its blobs first: whoever finds a record expects them.
    pub(crate) async fn put_record(
        &self,
        question: &Question,
        summary: &[u8],
        inclination: Option<f64>,
    ) -> Result<(), OperationError> {
        let (text, summary) = (raw_json(question.to_text(None)?)?, raw_json(summary.to_vec())?);
        let record = RecordText { question: &text, summary: &summary, inclination };
        let bytes = serde_json::to_vec(&record).map_err(|_| OperationError::Internal)?;
        self.put_blob(question.id(), RECORD, bytes).await.map(drop)
    }

    /// Stores a blob of a result.
    ///
    /// # Errors
    ///
    /// Other processes use the store, but it could keep the blob only in the memory of this one.
    pub(crate) async fn put_blob(
        &self,
        id: ResultId,
        name: &str,
        bytes: impl Into<Bytes>,
    ) -> Result<Content, OperationError> {
        self.stored(self.store.put(&id.key(name), bytes.into()).await)
    }

    /// Stores a blob that may never be read as [`Results::put_blob`] does, in memory only if there is no other place.
    pub(crate) async fn put_uncached_blob(
        &self,
        id: ResultId,
        name: &str,
        bytes: impl Into<Bytes>,
    ) -> Result<Content, OperationError> {
        self.stored(self.store.put_uncached(&id.key(name), bytes.into()).await)
    }

    /// The content, unless other processes wait for it in vain.
    fn stored(&self, outcome: (Content, Durability)) -> Result<Content, OperationError> {
        match outcome {
            (_, Durability::MemoryOnly) if self.are_shared() => Err(OperationError::StoreUnavailable),
            (content, _) => Ok(content),
        }
    }

    /// A blob of a result, to be sent.
    pub(crate) async fn find_blob(&self, id: ResultId, name: &str) -> Option<ContentReader> {
        self.store.reader(&id.key(name)).await
    }

    /// A blob of a result, in memory.
    pub(crate) async fn blob(&self, id: ResultId, name: &str) -> Option<Content> {
        self.store.get(&id.key(name)).await
    }

    /// A blob of a result. If there is none, `make` makes it, once for all callers, and the store keeps it; `None` if
    /// `make` returns nothing.
    pub(crate) async fn blob_or_make<E: Clone + Send + Sync + 'static>(
        &self,
        id: ResultId,
        name: &str,
        make: impl Future<Output = Result<Option<Vec<u8>>, E>> + Send,
    ) -> Result<Option<Content>, E> {
        // The store keeps bytes only: an error and a missing source come back as its error.
        let make = async { make.await.map_err(Some)?.map(Into::into).ok_or(None) };
        match self.store.get_or_make(&id.key(name), make).await {
            Ok(content) => Ok(Some(content)),
            Err(None) => Ok(None),
            Err(Some(error)) => Err(error),
        }
    }
}

/// A mesh as the bytes of a blob.
pub(crate) fn pack_mesh(mesh: &Mesh) -> Result<Vec<u8>, OperationError> {
    packed::pack(mesh).map_err(|_| OperationError::Internal)
}

/// The mesh of a blob; nothing if another version wrote it.
pub(crate) fn unpack_mesh(blob: &Content) -> Option<Mesh> {
    packed::unpack(&blob.bytes).ok()
}

fn raw_json(json: Vec<u8>) -> Result<Box<RawValue>, OperationError> {
    String::from_utf8(json)
        .ok()
        .and_then(|text| RawValue::from_string(text).ok())
        .ok_or(OperationError::Internal)
}

/// Bytes with their hash. Hash few bytes, or hash them on the compute pool.
pub(crate) fn hashed(bytes: impl Into<Bytes>) -> Content {
    let bytes = bytes.into();
    Content { hash: blake3::hash(&bytes), bytes }
}
