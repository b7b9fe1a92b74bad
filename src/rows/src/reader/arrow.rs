//! Streams of Apache Arrow.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::{ArrayRef, RecordBatch, StringArray, new_empty_array};
use arrow_buffer::Buffer;
use arrow_ipc::reader::StreamDecoder;
use arrow_schema::{DataType, Field, Schema};

use crate::chunk::Chunk;
use crate::column::Column;
use crate::error::ReadError;
use crate::header::Header;
use crate::limits::CHUNK_ROWS;
use crate::numbers::to_numbers;
use crate::reader::messages::{Messages, malformed};
use crate::source::Source;

/// The mark of the end of a stream.
const END: [u8; 8] = [0xFF, 0xFF, 0xFF, 0xFF, 0, 0, 0, 0];

/// Reads a stream.
pub(crate) struct ArrowSource {
    numbers: &'static [&'static str],
    message_bytes: usize,
    messages: Messages,
    decoder: StreamDecoder,
    columns: Option<Vec<Column>>,
    /// A record batch, and how many of its rows are returned.
    batch: Option<(Vec<Column>, usize, usize)>,
    is_complete: bool,
}

impl std::fmt::Debug for ArrowSource {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ArrowSource").field("columns", &self.columns).finish_non_exhaustive()
    }
}

impl ArrowSource {
    pub(crate) fn new(numbers: &'static [&'static str], message_bytes: usize) -> Self {
        Self {
            numbers,
            message_bytes,
            messages: Messages::new(message_bytes),
            decoder: StreamDecoder::new(),
            columns: None,
            batch: None,
            is_complete: false,
        }
    }

    /// Decodes a message; returns the rows of a record batch.
    fn decode(&mut self, mut message: Buffer) -> Result<Option<RecordBatch>, ReadError> {
        // The decoder panics at some contradictions of a message. It is not used again after an error.
        let decoded = catch_unwind(AssertUnwindSafe(|| self.decoder.decode(&mut message)));
        let batch = decoded.map_err(|_| malformed("a message contradicts itself"))??;
        if self.columns.is_none()
            && let Some(schema) = self.decoder.schema()
        {
            self.columns = Some(self.checked(&schema)?);
        }
        Ok(batch)
    }

    /// The columns of the schema without rows.
    fn checked(&self, schema: &Schema) -> Result<Vec<Column>, ReadError> {
        let names = schema.fields().iter().map(|field| field.name().clone());
        let header = Header::new(names, self.numbers)?;
        let fields = schema.fields().iter().zip(&header.names);
        fields
            .map(|(field, name)| {
                check_type(field, name.is_number)?;
                Ok(self.column(field, without_views(&new_empty_array(field.data_type()), 0)?))
            })
            .collect()
    }

    fn column(&self, field: &Field, values: ArrayRef) -> Column {
        let is_number = self.numbers.contains(&field.name().as_str());
        let numbers = if is_number { to_numbers(&values) } else { None };
        // Without the metadata of the field: a name of an extension type promises more than is checked here.
        Column::new(field.name(), numbers.unwrap_or(values))
    }

    /// The next rows of the record batch.
    fn next_rows(&mut self) -> Option<Chunk> {
        let (columns, start, rows) = self.batch.take()?;
        let count = (rows - start).min(CHUNK_ROWS);
        if count == 0 {
            return None;
        }
        let chunk = columns.iter().map(|column| column.slice(start, count)).collect();
        self.batch = Some((columns, start + count, rows));
        Some(Chunk { rows: count, columns: chunk, faults: Vec::new(), lines: Vec::new() })
    }

    /// The columns of a record batch.
    fn batch_columns(&self, batch: &RecordBatch) -> Result<Vec<Column>, ReadError> {
        let columns = batch.schema_ref().fields().iter().zip(batch.columns());
        columns
            .map(|(field, values)| Ok(self.column(field, without_views(values, self.message_bytes)?)))
            .collect()
    }
}

/// Checks that a column can be read. The values of a row take memory of their own in the accepted types: otherwise a
/// short stream could have any number of rows.
fn check_type(field: &Field, is_number: bool) -> Result<(), ReadError> {
    let kind = field.data_type();
    if is_number && to_numbers(&new_empty_array(kind)).is_none() {
        return Err(ReadError::column(field.name(), format!("has the type {kind}; accepted are numbers")));
    }
    let words = match kind {
        DataType::Dictionary(_, words) => words,
        other => other,
    };
    let is_flat = words.is_primitive()
        || matches!(
            words,
            DataType::Boolean
                | DataType::Utf8
                | DataType::LargeUtf8
                | DataType::Utf8View
                | DataType::Binary
                | DataType::LargeBinary
        );
    if is_flat {
        Ok(())
    } else {
        Err(ReadError::column(field.name(), format!("has the type {kind}: it is nested")))
    }
}

/// Texts in place of views of texts: a part of an array of views keeps all its texts, and many views may be of one
/// text.
fn without_views(values: &ArrayRef, most_bytes: usize) -> Result<ArrayRef, ReadError> {
    let Some(views) = values.as_string_view_opt() else { return Ok(Arc::clone(values)) };
    let bytes: usize = views.lengths().map(|length| length as usize).sum();
    if bytes > most_bytes {
        return Err(malformed("many views show the same texts"));
    }
    Ok(Arc::new(views.iter().collect::<StringArray>()))
}

impl Source for ArrowSource {
    fn push(&mut self, bytes: &[u8]) {
        self.messages.push(bytes);
    }

    fn next_chunk(&mut self, ended: bool) -> Result<Option<Chunk>, ReadError> {
        loop {
            if let Some(chunk) = self.next_rows() {
                return Ok(Some(chunk));
            }
            let message = match self.messages.next(ended)? {
                Some(message) => message,
                None if ended && !self.is_complete => {
                    self.is_complete = true;
                    // The decoder waits with a message that has no body until it sees what follows.
                    Buffer::from(END)
                }
                None if ended && self.columns.is_none() => return Err(malformed("it has no schema")),
                None => return Ok(None),
            };
            if let Some(batch) = self.decode(message)? {
                self.batch = Some((self.batch_columns(&batch)?, 0, batch.num_rows()));
            }
        }
    }

    fn columns(&self) -> Option<Vec<Column>> {
        self.columns.clone()
    }
}
