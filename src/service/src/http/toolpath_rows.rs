//! The rows of a tool path as a response: read from their chunks and written as text while they are sent.

use std::io;
use std::ops::Range;
use std::sync::Arc;

use axum::body::{Body, Bytes};
use axum::response::{IntoResponse, Response};
use futures_util::{Stream, stream};

use crate::http::conditional_response::{Conditions, StreamedText, entity_tag};
use crate::http::error::HttpError;
use crate::http::handlers::results::stored_toolpath;
use crate::http::result_or_job::ResultOrJob;
use crate::http::state::{AppState, SharedState};
use crate::http::wait_policy::WaitPolicy;
use crate::limits::response_memory::UnsharedBytes;
use crate::operations::compute_pool::run_on_pool;
use crate::operations::question::Question;
use crate::operations::results::Record;
use crate::operations::toolpath_report::row_count;
use crate::operations::toolpath_row_text::RowText;
use crate::operations::toolpath_rows::{ROWS_PER_CHUNK, chunk_name, rows_of_chunk};
use crate::wire::error::OperationError;
use crate::wire::result_id::ResultId;

/// Rows that are written at once: a millisecond of a worker thread, some 300 KB of text.
const PIECE_ROWS: u64 = 1024;

/// About the memory of a response: a chunk of rows, and two pieces of text.
const RESPONSE_BYTES: u64 = 2 * 1024 * 1024;

/// The rows of a stored tool path as a text that is written while it is sent.
pub(crate) struct RowsResponse {
    /// The tool path.
    pub id: ResultId,
    /// The rows.
    pub range: Range<u64>,
    /// What the text follows from, beside the rows: the result of an id never changes.
    pub tag: String,
    /// The media type of the text.
    pub media: &'static str,
    /// The extension of a file with the text.
    pub extension: &'static str,
}

impl RowsResponse {
    /// The response to a request with these conditions; `writer` makes the text, if the client does not have it. If the
    /// store evicts a chunk meanwhile, the connection breaks off.
    pub(crate) async fn respond(
        self,
        state: &SharedState,
        conditions: &Conditions,
        writer: impl Future<Output = Result<Box<dyn RowText>, HttpError>>,
    ) -> Result<Response, HttpError> {
        let Self { id, range, tag, media, extension } = self;
        let name = format!("{id} rows {} {} {tag}", range.start, range.end);
        let text = StreamedText {
            etag: entity_tag(&blake3::hash(name.as_bytes()), None)?,
            vary: "accept",
            media,
            file_name: format!("toolpath-{id:.8}.{extension}"),
        };
        let about = match text.begin(conditions) {
            Ok(about) => about,
            Err(unmodified) => return Ok(*unmodified),
        };
        let writing =
            Writing { state: Arc::clone(state), id, next: range, chunk: None, writer: writer.await? };
        let mut response = (about, Body::from_stream(writing.text())).into_response();
        response.extensions_mut().insert(UnsharedBytes(RESPONSE_BYTES));
        Ok(response)
    }
}

/// The question of a tool path whose rows the store has, or the job that computes them again.
pub(crate) async fn rows_or_job(
    state: &AppState,
    record: &Record,
    rows: Range<u64>,
    wait_policy: &WaitPolicy,
) -> Result<ResultOrJob<Arc<Question>>, HttpError> {
    let question = state.results.questions.get_or_read(record.id, &record.question)?;
    // The store evicts the least recently used first: if the ends are there, so is what is between them.
    let ends = [rows.start, rows.end.saturating_sub(1).max(rows.start)].map(|row| row / ROWS_PER_CHUNK);
    let find = || async {
        if !rows.is_empty() {
            for chunk in ends {
                state.results.find_blob(record.id, &chunk_name(chunk)).await?;
            }
        }
        Some(Arc::clone(&question))
    };
    state.blob_or_job(&question, wait_policy, None, find).await
}

/// The record of a tool path, and the number of its rows.
pub(crate) async fn toolpath_record(state: &AppState, id: String) -> Result<(Record, u64), HttpError> {
    let record = stored_toolpath(state, id).await?;
    let count = row_count(&record.summary.bytes).ok_or(OperationError::Internal)?;
    Ok((record, count))
}

/// A chunk of rows.
///
/// # Errors
///
/// [`OperationError::Internal`]: the store has evicted it.
pub(crate) async fn chunk(state: &AppState, id: ResultId, number: u64) -> Result<Bytes, OperationError> {
    let chunk = state.results.blob(id, &chunk_name(number)).await;
    chunk.map(|content| content.bytes).ok_or_else(|| {
        tracing::warn!(%id, number, "the store evicted rows while they were read");
        OperationError::Internal
    })
}

/// A response that is being sent.
struct Writing {
    state: SharedState,
    id: ResultId,
    /// The rows that are left.
    next: Range<u64>,
    /// The number of the chunk that is in memory, and its bytes.
    chunk: Option<(u64, Bytes)>,
    writer: Box<dyn RowText>,
}

/// A piece of text, and what follows it.
type Piece = Option<(Bytes, Option<Writing>)>;

impl Writing {
    /// The text, in pieces that are written when the connection has room for them.
    fn text(self) -> impl Stream<Item = io::Result<Bytes>> + Send {
        stream::try_unfold(Some(self), |writing| async move {
            match writing {
                Some(writing) => writing.piece().await.map_err(io::Error::other),
                None => Ok(None),
            }
        })
    }

    /// The next piece.
    async fn piece(mut self) -> Result<Piece, OperationError> {
        let Range { start, end } = self.next;
        if start == end {
            let tail = run_on_pool(move |_| self.writer.tail()).await?;
            return Ok(Some((tail.into(), None)));
        }
        let number = start / ROWS_PER_CHUNK;
        let in_chunk = start - number * ROWS_PER_CHUNK;
        let count = PIECE_ROWS.min(end - start).min(ROWS_PER_CHUNK - in_chunk);
        let chunk = match self.chunk.take() {
            Some((known, chunk)) if known == number => chunk,
            _ => chunk(&self.state, self.id, number).await?,
        };
        self.next.start += count;
        self.chunk = Some((number, chunk.clone()));
        let (text, writing) = run_on_pool(move |_| {
            let mut rows = rows_of_chunk(&chunk, in_chunk..in_chunk + count);
            self.writer.rows(&mut rows).map(|text| (text, self))
        })
        .await?;
        Ok(Some((text.into(), Some(writing))))
    }
}
