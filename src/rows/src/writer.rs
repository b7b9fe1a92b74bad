//! Writes rows as bytes, piece by piece.

use std::fmt;
use std::sync::Arc;

use arrow_array::RecordBatch;
use arrow_ipc::writer::StreamWriter;
use arrow_schema::{Schema, SchemaRef};

use crate::cell::{Style, cells, write_text};
use crate::column::Column;
use crate::error::WriteError;
use crate::format::Format;

/// Most bytes of text that rows written at once may have. A short dictionary of Arrow can name a long text in any
/// number of rows.
const TEXT_BYTES: usize = 64 << 20;

/// Writes rows.
///
/// ```
/// use verne_rows::{Column, Format, Writer};
///
/// let rows = [Column::texts("id", [Some("A, B"), None]), Column::numbers("x", [Some(1.0), Some(0.1)])];
/// let mut writer = Writer::new(Format::Csv, &rows)?;
/// let mut text = writer.write(&rows)?;
/// text.extend(writer.finish()?);
/// assert_eq!(text, b"id,x\n\"A, B\",1\n,0.1\n");
/// # Ok::<(), verne_rows::WriteError>(())
/// ```
pub struct Writer(Form);

enum Form {
    Arrow {
        writer: Box<StreamWriter<Vec<u8>>>,
        schema: SchemaRef,
        /// About the bytes of the next rows: those of the rows before.
        bytes: usize,
    },
    Text {
        style: Style,
        /// The names of the columns, as they stand before the values of JSON.
        names: Vec<Vec<u8>>,
        /// What stands before all rows, until it is written.
        head: Vec<u8>,
    },
}

impl fmt::Debug for Writer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let format = match &self.0 {
            Form::Arrow { .. } => Format::Arrow,
            Form::Text { style: Style::Csv, .. } => Format::Csv,
            Form::Text { style: Style::Json, .. } => Format::Ndjson,
        };
        f.debug_tuple("Writer").field(&format).finish()
    }
}

impl Writer {
    /// A writer of rows with these columns; their values are not written.
    ///
    /// # Errors
    ///
    /// Two columns have one name, or the format has no text for the type of a column.
    pub fn new(format: Format, columns: &[Column]) -> Result<Self, WriteError> {
        for (i, column) in columns.iter().enumerate() {
            if columns[..i].iter().any(|other| other.name() == column.name()) {
                return Err(WriteError::Twice(column.name().to_owned()));
            }
        }
        let form = match format {
            Format::Arrow => {
                let fields: Vec<_> = columns.iter().map(|column| Arc::clone(&column.field)).collect();
                let schema = Arc::new(Schema::new(fields));
                let writer = Box::new(StreamWriter::try_new(Vec::new(), &schema)?);
                Form::Arrow { writer, schema, bytes: 0 }
            }
            Format::Csv => Form::text(Style::Csv, columns)?,
            Format::Ndjson => Form::text(Style::Json, columns)?,
        };
        Ok(Self(form))
    }

    /// The bytes of the next rows. Those of the first ones begin with what stands before all rows.
    ///
    /// # Errors
    ///
    /// The columns are not those of [`new`](Self::new), or they have different lengths.
    pub fn write(&mut self, columns: &[Column]) -> Result<Vec<u8>, WriteError> {
        match &mut self.0 {
            Form::Arrow { writer, schema, bytes } => {
                let values = columns.iter().map(Column::plain_values).collect();
                writer.get_mut().reserve(*bytes);
                writer.write(&RecordBatch::try_new(Arc::clone(schema), values)?)?;
                let written = std::mem::take(writer.get_mut());
                *bytes = written.len();
                Ok(written)
            }
            Form::Text { style, names, head } => {
                let mut text = std::mem::take(head);
                write_rows(*style, names, columns, &mut text)?;
                Ok(text)
            }
        }
    }

    /// The bytes after the last row.
    ///
    /// # Errors
    ///
    /// A defect.
    pub fn finish(self) -> Result<Vec<u8>, WriteError> {
        match self.0 {
            Form::Arrow { writer, .. } => Ok(writer.into_inner()?),
            Form::Text { head, .. } => Ok(head),
        }
    }
}

impl Form {
    fn text(style: Style, columns: &[Column]) -> Result<Self, WriteError> {
        columns.iter().try_for_each(|column| cells(column, style).map(drop))?;
        let mut names: Vec<Vec<u8>> = Vec::new();
        let mut head = Vec::new();
        for (i, column) in columns.iter().enumerate() {
            let mut name = vec![if i > 0 { b',' } else { b'{' }];
            write_text(column.name(), style, &mut name);
            match style {
                Style::Csv => head.extend_from_slice(&name[usize::from(i == 0)..]),
                Style::Json => name.push(b':'),
            }
            names.push(name);
        }
        if style == Style::Csv {
            head.push(b'\n');
        }
        Ok(Self::Text { style, names, head })
    }
}

fn write_rows(
    style: Style,
    names: &[Vec<u8>],
    columns: &[Column],
    text: &mut Vec<u8>,
) -> Result<(), WriteError> {
    let rows = columns.first().map_or(0, Column::len);
    if names.len() != columns.len() || columns.iter().any(|column| column.len() != rows) {
        return Err(WriteError::Columns("the columns do not fit together".to_owned()));
    }
    let cells = columns.iter().map(|column| cells(column, style)).collect::<Result<Vec<_>, _>>()?;
    for row in 0..rows {
        for (i, (cell, name)) in cells.iter().zip(names).enumerate() {
            match style {
                Style::Json => text.extend_from_slice(name),
                Style::Csv if i > 0 => text.push(b','),
                Style::Csv => {}
            }
            cell(row, text);
            if text.len() > TEXT_BYTES {
                return Err(WriteError::TooLong(rows));
            }
        }
        text.extend_from_slice(if style == Style::Json { b"}\n" } else { b"\n" });
    }
    Ok(())
}
