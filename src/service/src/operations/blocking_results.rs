//! The stored results for the threads of the job queue, which may wait for the store.

use bytes::Bytes;
use tokio::runtime::Handle;

use crate::operations::question::Question;
use crate::operations::results::{Record, Results};
use crate::operations::stored_reader::StoredReader;
use crate::wire::error::OperationError;
use crate::wire::result_id::ResultId;

/// The stored results. Its functions block the thread until the store has answered.
pub(crate) struct BlockingResults {
    /// The results.
    pub results: Results,
    /// The runtime of the store. The calling threads must not be the runtime's.
    pub runtime: Handle,
}

impl BlockingResults {
    /// A blob of a result.
    pub(crate) fn blob(&self, id: ResultId, name: &str) -> Option<Bytes> {
        self.runtime.block_on(self.results.blob(id, name)).map(|content| content.bytes)
    }

    /// Whether the store has a blob of a result.
    pub(crate) fn has_blob(&self, id: ResultId, name: &str) -> bool {
        self.runtime.block_on(self.results.find_blob(id, name)).is_some()
    }

    /// A reader of a blob of a result. It keeps the blob out of memory unless the blob is there already.
    pub(crate) fn reader(&self, id: ResultId, name: &str) -> Option<StoredReader> {
        let content = self.runtime.block_on(self.results.find_blob(id, name))?;
        Some(StoredReader::new(&content, self.runtime.clone()))
    }

    /// See [`Results::put_uncached_blob`].
    pub(crate) fn put_uncached_blob(
        &self,
        id: ResultId,
        name: &str,
        bytes: Vec<u8>,
    ) -> Result<Bytes, OperationError> {
        self.runtime.block_on(self.results.put_uncached_blob(id, name, bytes)).map(|content| content.bytes)
    }

    /// See [`Results::put_blob`].
    pub(crate) fn put_blob(&self, id: ResultId, name: &str, bytes: Vec<u8>) -> Result<Bytes, OperationError> {
        self.runtime.block_on(self.results.put_blob(id, name, bytes)).map(|content| content.bytes)
    }

    /// See [`Results::put_record`].
    pub(crate) fn put_record(
        &self,
        question: &Question,
        summary: &[u8],
        inclination: Option<f64>,
    ) -> Result<(), OperationError> {
        self.runtime.block_on(self.results.put_record(question, summary, inclination))
    }

    /// The record of a result if the store has it with these blobs.
    pub(crate) fn complete_record(&self, id: ResultId, blobs: &[&str]) -> Option<Record> {
        let record = self.runtime.block_on(self.results.record(id))?;
        blobs.iter().all(|name| self.has_blob(id, name)).then_some(record)
    }
}
