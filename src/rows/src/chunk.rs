//! Some consecutive rows.

use crate::column::Column;

/// Some consecutive rows, as columns of equal length.
#[derive(Clone, Debug)]
pub struct Chunk {
    pub(crate) rows: usize,
    pub(crate) columns: Vec<Column>,
    pub(crate) faults: Vec<RowFault>,
    /// The line on which each row ends; empty for Arrow.
    pub(crate) lines: Vec<u64>,
}

/// Why a row cannot be used, although those around it can.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowFault {
    /// The row of the chunk, from 0.
    pub row: usize,
    /// The reason.
    pub detail: String,
}

impl Chunk {
    /// No rows of these columns, which have none.
    pub fn without_rows(columns: Vec<Column>) -> Self {
        Self { rows: 0, columns, faults: Vec::new(), lines: Vec::new() }
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The columns, in their order.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The column of a name.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name() == name)
    }

    /// The line of the text on which a row ends, from 1. `None` if the rows come from Arrow, which has no lines.
    ///
    /// ```
    /// use verne_rows::{Format, Reader};
    ///
    /// let mut reader = Reader::new(Format::Csv, &["x"], 1 << 20);
    /// reader.push(b"x\n1\n\n2\n");
    /// let chunk = reader.next_chunk()?.ok_or("no rows")?;
    /// assert_eq!((chunk.line(0), chunk.line(1)), (Some(2), Some(4)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn line(&self, row: usize) -> Option<u64> {
        self.lines.get(row).copied()
    }

    /// The rows that cannot be used, in ascending order. Do not use their numbers.
    pub fn faults(&self) -> &[RowFault] {
        &self.faults
    }
}
