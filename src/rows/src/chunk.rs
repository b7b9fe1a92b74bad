//! Some consecutive rows.

use crate::column::Column;

/// Some consecutive rows, as columns of equal length.
#[derive(Clone, Debug)]
pub struct Chunk {
    pub(crate) rows: usize,
    pub(crate) columns: Vec<Column>,
    pub(crate) faults: Vec<RowFault>,
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
        Self { rows: 0, columns, faults: Vec::new() }
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

    /// The rows that cannot be used, in ascending order. Do not use their numbers.
    pub fn faults(&self) -> &[RowFault] {
        &self.faults
    }
}
