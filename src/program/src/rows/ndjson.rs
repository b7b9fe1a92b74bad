//! One JSON object or array per line.

use crate::builder::Builder;
use crate::diagnostics::shortened;
use crate::error::ProgramError;
use crate::lines::LineReader;
use crate::options::ReadOptions;
use crate::rows::row::Row;
use crate::rows::row_builder::{At, RowBuilder};

/// Reads NDJSON.
#[derive(Debug)]
pub(crate) struct NdjsonReader {
    rows: RowBuilder,
}

impl NdjsonReader {
    pub(crate) fn new(options: &ReadOptions) -> Self {
        Self { rows: RowBuilder::new(options) }
    }
}

impl LineReader for NdjsonReader {
    fn line(&mut self, number: u32, line: &[u8]) {
        if line.trim_ascii().is_empty() {
            return;
        }
        let error = match serde_json::from_slice::<Row>(line) {
            Ok(row) => match self.rows.row(number, &row) {
                Ok(()) => return,
                Err((at, detail)) => {
                    let word = if let At::Name(name) = at { name.to_owned() } else { String::new() };
                    ProgramError { line: number, column: 1, word, detail }
                }
            },
            Err(error) => not_a_row(number, line, &error),
        };
        self.rows.builder.diagnostics.fault(error);
    }

    fn end(&mut self, _terminated: bool) {}

    fn builder(&mut self) -> &mut Builder {
        &mut self.rows.builder
    }

    fn into_builder(self: Box<Self>) -> Builder {
        self.rows.builder
    }
}

/// The fault of a line that the JSON parser refuses.
fn not_a_row(number: u32, line: &[u8], error: &serde_json::Error) -> ProgramError {
    // The parser's column is the last byte that it has read, from 1; 0 before the first.
    let end = error.column();
    let delimiter = |byte: &u8| b" \t,:[]{}".contains(byte);
    let read = &line[..end.min(line.len())];
    let read = read.strip_suffix(b",").or_else(|| read.strip_suffix(b"]")).unwrap_or(read);
    let read = read.strip_suffix(b"}").unwrap_or(read);
    let word = read.rsplit(delimiter).next().unwrap_or_default();
    let column = read.len() - word.len() + 1;
    let text = error.to_string();
    // The parser knows one line only: its own " at line 1 column 7" would mislead.
    let reason = text.split(" at line ").next().unwrap_or_default();
    // Nor does it know that a row may be an array: its own list of names is a part of what is accepted.
    let reason = if reason.starts_with("unknown field") {
        reason.split(", expected ").next().unwrap_or_default()
    } else {
        reason
    };
    let detail = format!(
        "{reason}; accepted are an array of 3, 5 or 6 numbers, or an object with {}",
        crate::rows::row::NAMES
    );
    ProgramError {
        line: number,
        column: u32::try_from(column).unwrap_or(u32::MAX),
        word: shortened(&String::from_utf8_lossy(word)),
        detail,
    }
}
