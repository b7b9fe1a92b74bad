//! Reads rows from bytes that arrive in pieces.

mod arrow;
mod builders;
mod csv;
mod messages;
mod ndjson;

use crate::chunk::Chunk;
use crate::column::Column;
use crate::error::ReadError;
use crate::format::Format;
use crate::reader::arrow::ArrowSource;
use crate::reader::csv::CsvSource;
use crate::reader::ndjson::NdjsonSource;
use crate::source::Source;

/// Reads rows.
///
/// Bytes that are pushed stay in memory until [`next_chunk`](Self::next_chunk) has returned their rows: push no more
/// before it returns `None`.
///
/// ```
/// use verne_rows::{Format, Reader};
///
/// let mut reader = Reader::new(Format::Ndjson, &["x"], 1 << 20);
/// reader.push(b"{\"x\": 1}\n{\"x\":");
/// assert_eq!(reader.next_chunk()?.map(|chunk| chunk.rows()), Some(1));
/// assert!(reader.next_chunk()?.is_none());
/// reader.push(b" 2}");
/// reader.end();
/// assert_eq!(reader.next_chunk()?.map(|chunk| chunk.rows()), Some(1));
/// assert!(reader.next_chunk()?.is_none());
/// # Ok::<(), verne_rows::ReadError>(())
/// ```
#[derive(Debug)]
pub struct Reader {
    source: Box<dyn Source>,
    ended: bool,
}

impl Reader {
    /// A reader that has read nothing yet. `numbers` are the names of the columns that must be numbers.
    /// `message_bytes` is the greatest size of a message of Arrow, which has to be in memory as a whole.
    pub fn new(format: Format, numbers: &'static [&'static str], message_bytes: usize) -> Self {
        let source: Box<dyn Source> = match format {
            Format::Arrow => Box::new(ArrowSource::new(numbers, message_bytes)),
            Format::Csv => Box::new(CsvSource::new(numbers)),
            Format::Ndjson => Box::new(NdjsonSource::new(numbers)),
        };
        Self { source, ended: false }
    }

    /// Takes the next bytes.
    pub fn push(&mut self, bytes: &[u8]) {
        self.source.push(bytes);
    }

    /// No bytes follow.
    pub fn end(&mut self) {
        self.ended = true;
    }

    /// The next rows, at least one and at most [`CHUNK_ROWS`](crate::CHUNK_ROWS). `None` if there is none before more
    /// bytes arrive, or at the end.
    ///
    /// # Errors
    ///
    /// No further row can be read.
    pub fn next_chunk(&mut self) -> Result<Option<Chunk>, ReadError> {
        self.source.next_chunk(self.ended)
    }

    /// The columns without rows. `None` if they are not known before more bytes arrive. They are known with the first
    /// chunk.
    pub fn columns(&self) -> Option<Vec<Column>> {
        self.source.columns()
    }
}
