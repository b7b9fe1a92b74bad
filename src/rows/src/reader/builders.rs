//! Collects the rows of a text in columns.

use std::sync::Arc;

use arrow_array::StringArray;
use arrow_array::builder::{Float64Builder, StringBuilder};

use crate::chunk::{Chunk, RowFault};
use crate::column::Column;
use crate::header::Header;

/// The columns under construction.
#[derive(Debug)]
pub(crate) struct Builders {
    columns: Vec<Builder>,
    faults: Vec<RowFault>,
    /// The line on which each row ends.
    lines: Vec<u64>,
    texts: Texts,
}

/// The meaning of the extra columns' texts.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Texts {
    /// Themselves.
    Plain,
    /// Values of JSON.
    Json,
}

#[derive(Debug)]
enum Builder {
    Numbers(Float64Builder),
    Texts(StringBuilder),
}

impl Builders {
    pub(crate) fn new(header: &Header, texts: Texts) -> Self {
        let columns = header.names.iter().map(|name| {
            if name.is_number {
                Builder::Numbers(Float64Builder::new())
            } else {
                Builder::Texts(StringBuilder::new())
            }
        });
        Self { columns: columns.collect(), faults: Vec::new(), lines: Vec::new(), texts }
    }

    pub(crate) fn rows(&self) -> usize {
        self.lines.len()
    }

    /// Adds a number or a text to a column; `text` is read if the column is one of numbers. What is not a number is
    /// missing.
    pub(crate) fn push(&mut self, column: usize, text: Option<&str>) {
        match self.columns.get_mut(column) {
            Some(Builder::Numbers(numbers)) => {
                numbers.append_option(text.and_then(|text| text.parse::<f64>().ok()));
            }
            Some(Builder::Texts(texts)) => texts.append_option(text),
            None => {}
        }
    }

    /// The row is complete, and ends on this line; `fault` says why it cannot be used.
    pub(crate) fn end_row(&mut self, line: u64, fault: Option<String>) {
        self.faults.extend(fault.map(|detail| RowFault { row: self.lines.len(), detail }));
        self.lines.push(line);
    }

    /// The rows so far, which start anew; `None` if there is none.
    pub(crate) fn finish(&mut self, header: &Header) -> Option<Chunk> {
        if self.lines.is_empty() {
            return None;
        }
        let columns = header.names.iter().zip(&mut self.columns).map(|(name, builder)| match builder {
            Builder::Numbers(numbers) => Column::new(&name.name, Arc::new(numbers.finish())),
            Builder::Texts(texts) => self.texts.column(&name.name, texts.finish()),
        });
        let columns = columns.collect();
        let lines = std::mem::take(&mut self.lines);
        Some(Chunk { rows: lines.len(), columns, faults: std::mem::take(&mut self.faults), lines })
    }
}

impl Texts {
    fn column(self, name: &str, values: StringArray) -> Column {
        match self {
            Self::Plain => Column::new(name, Arc::new(values)),
            Self::Json => Column::json(name, values),
        }
    }
}

/// The columns of a header without rows.
pub(crate) fn empty_columns(header: &Header, texts: Texts) -> Vec<Column> {
    let column = |name: &str, is_number| {
        if is_number { Column::numbers(name, []) } else { texts.column(name, StringBuilder::new().finish()) }
    };
    header.names.iter().map(|name| column(&name.name, name.is_number)).collect()
}
