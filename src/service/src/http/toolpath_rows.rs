//! The rows of a tool path as a response: read from their chunks and written as text while they are sent.

use std::io;
use std::ops::Range;
use std::sync::Arc;

use axum::body::{Body, Bytes};
use axum::http::header::{CACHE_CONTROL, CONTENT_DISPOSITION, CONTENT_TYPE, VARY};
use axum::http::{HeaderMap, HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};
use futures_util::{Stream, stream};
use headers::HeaderMapExt;

use crate::http::conditional_response::{Conditions, IMMUTABLE, entity_tag};
use crate::http::error::HttpError;
use crate::http::state::SharedState;
use crate::limits::response_memory::UnsharedBytes;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::toolpath_row_text::RowTextWriter;
use crate::operations::toolpath_rows::{ROWS_PER_CHUNK, chunk_name, rows_of_chunk};
use crate::wire::error::OperationError;
use crate::wire::result_id::ResultId;
use crate::wire::toolpath_row::RowFormat;

/// Rows that are written at once: a millisecond of a worker thread, some 300 KB of text.
const PIECE_ROWS: u64 = 1024;

/// About the memory of a response: a chunk of rows, and two pieces of text.
const RESPONSE_BYTES: u64 = 2 * 1024 * 1024;

/// Some rows of a stored tool path.
#[derive(Clone, Debug)]
pub(crate) struct RowsOf {
    /// The tool path.
    pub id: ResultId,
    /// The rows.
    pub range: Range<u64>,
    /// Their format.
    pub format: RowFormat,
}

impl RowsOf {
    /// The response to a request with these conditions. If the store evicts a chunk meanwhile, the connection breaks
    /// off.
    pub(crate) fn respond(self, state: &SharedState, conditions: &Conditions) -> Result<Response, HttpError> {
        let Self { id, range, format } = &self;
        // The bytes follow from these: the result of an id never changes.
        let name = format!("{id} rows {} {} {}", range.start, range.end, format.name());
        let etag = entity_tag(&blake3::hash(name.as_bytes()), None)?;
        let mut about = HeaderMap::new();
        about.insert(CACHE_CONTROL, HeaderValue::from_static(IMMUTABLE));
        about.insert(VARY, HeaderValue::from_static("accept"));
        about.typed_insert(etag.clone());
        if conditions.are_unmodified(&etag) {
            return Ok((StatusCode::NOT_MODIFIED, about).into_response());
        }
        let file_name = format!("inline; filename=\"toolpath-{id:.8}.{}\"", format.name());
        about.insert(CONTENT_TYPE, HeaderValue::from_static(format.media()));
        about.insert(CONTENT_DISPOSITION, file_name.parse().map_err(|_| OperationError::Internal)?);
        let mut response = (about, Body::from_stream(self.text(state))).into_response();
        response.extensions_mut().insert(UnsharedBytes(RESPONSE_BYTES));
        Ok(response)
    }

    /// The text, in pieces that are written when the connection has room for them.
    fn text(self, state: &SharedState) -> impl Stream<Item = io::Result<Bytes>> + Send + use<> {
        let writer = RowTextWriter::new(self.format, self.range.start);
        let head = writer.head(self.id);
        let writing =
            Writing { state: Arc::clone(state), id: self.id, next: self.range, chunk: None, writer };
        stream::try_unfold((head, Some(writing)), |(head, writing)| async move {
            match writing {
                Some(writing) => writing.piece(head).await.map_err(io::Error::other),
                None => Ok(None),
            }
        })
    }
}

/// A response that is being sent.
struct Writing {
    state: SharedState,
    id: ResultId,
    /// The rows that are left.
    next: Range<u64>,
    /// The number of the chunk that is in memory, and its bytes.
    chunk: Option<(u64, Bytes)>,
    writer: RowTextWriter,
}

/// A piece of text, and what follows it.
type Piece = Option<(Bytes, (String, Option<Writing>))>;

impl Writing {
    /// The next piece, which begins with `head`.
    async fn piece(mut self, head: String) -> Result<Piece, OperationError> {
        let Range { start, end } = self.next;
        if start == end {
            return Ok(Some(((head + &self.writer.tail()).into(), (String::new(), None))));
        }
        let number = start / ROWS_PER_CHUNK;
        let in_chunk = start - number * ROWS_PER_CHUNK;
        let count = PIECE_ROWS.min(end - start).min(ROWS_PER_CHUNK - in_chunk);
        let chunk = match self.chunk.take() {
            Some((known, chunk)) if known == number => chunk,
            _ => self.read(number).await?,
        };
        self.next.start += count;
        self.chunk = Some((number, chunk.clone()));
        let (text, writer) = run_on_pool(move |_| {
            let rows = rows_of_chunk(&chunk, in_chunk..in_chunk + count);
            self.writer.rows(rows).map(|text| (head + &text, self))
        })
        .await?;
        Ok(Some((text.into(), (String::new(), Some(writer)))))
    }

    async fn read(&self, number: u64) -> Result<Bytes, OperationError> {
        let chunk = self.state.results.blob(self.id, &chunk_name(number)).await;
        chunk.map(|content| content.bytes).ok_or_else(|| {
            tracing::warn!(id = %self.id, number, "the store evicted rows while they were sent");
            OperationError::Internal
        })
    }
}
