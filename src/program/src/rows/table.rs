//! Streams of Apache Arrow.

use std::ops::ControlFlow;

use verne_rows::{Chunk, Column, ReadError, Reader};

use crate::builder::Builder;
use crate::diagnostics::shortened;
use crate::error::ProgramError;
use crate::moves::MoveKind;
use crate::options::ReadOptions;
use crate::rows::row::{NAMES, Named};
use crate::rows::row_builder::{At, RowBuilder};

/// The columns of numbers.
const NUMBERS: &[&str] = &["x", "y", "z", "i", "j", "k", "phi1", "phi2", "feed", "line"];

/// Most bytes of a record batch, which is in memory as a whole.
const BATCH_BYTES: usize = 16 << 20;

/// Reads a stream of Arrow. The first row is line 1, unless the column `line` states another.
#[derive(Debug)]
pub(crate) struct TableReader {
    rows: RowBuilder,
    reader: Reader,
    /// Whether the names of the columns are checked.
    checked: bool,
    /// The number of rows so far.
    count: u32,
}

/// What cannot be read: the name of the value, and the reason.
struct BadValue(&'static str, String);

impl TableReader {
    pub(crate) fn new(options: &ReadOptions) -> Self {
        let reader = Reader::new(verne_rows::Format::Arrow, NUMBERS, BATCH_BYTES);
        Self { rows: RowBuilder::new(options), reader, checked: false, count: 0 }
    }

    /// Takes a piece of the stream.
    pub(crate) fn push(&mut self, bytes: &[u8]) -> ControlFlow<()> {
        self.reader.push(bytes);
        self.read()
    }

    /// The program under construction, after the last byte.
    pub(crate) fn into_builder(mut self) -> Builder {
        self.reader.end();
        let _ = self.read();
        self.rows.builder
    }

    pub(crate) fn builder(&mut self) -> &mut Builder {
        &mut self.rows.builder
    }

    fn read(&mut self) -> ControlFlow<()> {
        while !self.rows.builder.diagnostics.is_stopped() {
            match self.reader.next_chunk() {
                Ok(Some(chunk)) => {
                    self.check(chunk.columns());
                    self.chunk(&chunk);
                }
                Ok(None) => {
                    if let Some(columns) = self.reader.columns() {
                        self.check(&columns);
                    }
                    return ControlFlow::Continue(());
                }
                Err(ReadError::Column { name, detail }) => self.stop(&name, format!("the column {detail}")),
                Err(ReadError::Malformed(detail)) => self.stop("", detail),
            }
        }
        ControlFlow::Break(())
    }

    /// No row can be read.
    fn stop(&mut self, word: &str, detail: String) {
        let line = self.count.saturating_add(1);
        let error = ProgramError { line, column: 1, word: shortened(word), detail };
        self.rows.builder.diagnostics.stop(error);
    }

    /// Checks the columns, once.
    fn check(&mut self, columns: &[Column]) {
        if std::mem::replace(&mut self.checked, true) {
            return;
        }
        // Which columns there are is the same for all rows: a row of ones tells whether they are enough.
        let mut named = Named::default();
        for column in columns {
            let name = column.name();
            if let Some(number) = named.number(name) {
                *number = Some(1.0);
            } else if name == "kind" && !column.is_empty() && column.as_texts().is_none() {
                return self.stop(name, "the column must have texts: feed or rapid".to_owned());
            } else if !["kind", "line"].contains(&name) {
                self.rows.builder.diagnostics.warn(1, name, "the column is not read");
            }
        }
        if let Err(reason) = named.row() {
            self.stop("", format!("{reason}; accepted are {NAMES}"));
        }
    }

    fn chunk(&mut self, chunk: &Chunk) {
        let kinds = chunk.column("kind").and_then(Column::as_texts);
        for row in 0..chunk.rows() {
            if self.rows.builder.diagnostics.is_stopped() {
                return;
            }
            let Some(count) = self.count.checked_add(1) else {
                return self.stop("", "a program has fewer than 2^32 lines".to_owned());
            };
            self.count = count;
            let kind = kinds.as_ref().and_then(|kinds| kinds[row]);
            if let Err(BadValue(word, detail)) = self.row(chunk, row, kind) {
                let error = ProgramError { line: count, column: 1, word: word.to_owned(), detail };
                self.rows.builder.diagnostics.fault(error);
            }
        }
    }

    fn row(&mut self, chunk: &Chunk, row: usize, kind: Option<&str>) -> Result<(), BadValue> {
        let mut named = Named { kind: kind.map(read_kind).transpose()?, ..Named::default() };
        for name in NUMBERS {
            let numbers = chunk.column(name).and_then(Column::as_numbers);
            let Some(value) = numbers.and_then(|numbers| numbers.get(row)) else { continue };
            if !value.is_finite() {
                return Err(BadValue(name, format!("{name} must be a finite number")));
            }
            match named.number(name) {
                Some(number) => *number = Some(value),
                None => named.line = Some(read_line(value)?),
            }
        }
        let row = named.row().map_err(|reason| BadValue("", format!("{reason}; accepted are {NAMES}")))?;
        self.rows.row(self.count, &row).map_err(|(at, detail)| match at {
            At::Row => BadValue("", detail),
            At::Name(name) => BadValue(name, detail),
        })
    }
}

fn read_kind(text: &str) -> Result<MoveKind, BadValue> {
    match text {
        "feed" => Ok(MoveKind::Feed),
        "rapid" => Ok(MoveKind::Rapid),
        _ => Err(BadValue("kind", "there is no such kind; accepted are feed and rapid".to_owned())),
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked")]
fn read_line(value: f64) -> Result<u32, BadValue> {
    if value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value) {
        Ok(value as u32)
    } else {
        Err(BadValue("line", "line must be a whole number from 0 to 4294967295".to_owned()))
    }
}
