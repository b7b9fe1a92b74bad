//! Comma-separated values below a row of names.

use csv_core::ReadRecordResult;

use crate::chunk::Chunk;
use crate::column::Column;
use crate::error::ReadError;
use crate::header::Header;
use crate::limits::{CHUNK_ROWS, LONGEST_ROW, MOST_COLUMNS};
use crate::reader::builders::{Builders, Texts, empty_columns};
use crate::source::Source;

/// The mark that some editors put before UTF-8 text.
const UTF8_MARK: &str = "\u{FEFF}";

/// Reads CSV. A row with a wrong number of values is a fault of this row alone.
#[derive(Debug)]
pub(crate) struct CsvSource {
    numbers: &'static [&'static str],
    records: Records,
    table: Option<(Header, Builders)>,
}

impl CsvSource {
    pub(crate) fn new(numbers: &'static [&'static str]) -> Self {
        Self { numbers, records: Records::new(), table: None }
    }

    fn header(&mut self, ended: bool) -> Result<bool, ReadError> {
        if self.table.is_some() {
            return Ok(true);
        }
        if !self.records.next(ended)? {
            return if ended {
                Err(ReadError::Malformed("the first row must name the columns; there is none".to_owned()))
            } else {
                Ok(false)
            };
        }
        let names = (0..self.records.count()).map(|field| self.records.field(field));
        let names: Vec<String> =
            names.map(|name| name.trim_start_matches(UTF8_MARK).trim().to_owned()).collect();
        if let Some(number) = names.iter().find(|name| name.parse::<f64>().is_ok()) {
            return Err(ReadError::Malformed(format!(
                "the first row must name the columns; it contains {number}"
            )));
        }
        let header = Header::new(names, self.numbers)?;
        let builders = Builders::new(&header, Texts::Plain);
        self.table = Some((header, builders));
        Ok(true)
    }
}

impl Source for CsvSource {
    fn push(&mut self, bytes: &[u8]) {
        self.records.push(bytes);
    }

    fn next_chunk(&mut self, ended: bool) -> Result<Option<Chunk>, ReadError> {
        if !self.header(ended)? {
            return Ok(None);
        }
        let Some((header, builders)) = &mut self.table else { return Ok(None) };
        while builders.rows() < CHUNK_ROWS && self.records.next(ended)? {
            let (count, expected) = (self.records.count(), header.len());
            for (field, name) in header.names.iter().enumerate() {
                let text = (field < count).then(|| self.records.field(field));
                let text = if name.is_number {
                    // The numbers of a row that has too few or too many values may be those of other columns.
                    text.as_deref().map(str::trim).filter(|_| count == expected)
                } else {
                    text.as_deref()
                };
                builders.push(field, text);
            }
            let fault =
                (count != expected).then(|| format!("the row has {count} values instead of {expected}"));
            builders.end_row(self.records.line, fault);
        }
        Ok(builders.finish(header))
    }

    fn columns(&self) -> Option<Vec<Column>> {
        self.table.as_ref().map(|(header, _)| empty_columns(header, Texts::Plain))
    }
}

/// Splits bytes into records.
#[derive(Debug)]
struct Records {
    parser: csv_core::Reader,
    input: Vec<u8>,
    /// The bytes of the input that are read.
    at: usize,
    /// The fields of the record, one after the other.
    output: Vec<u8>,
    written: usize,
    /// The ends of the fields in the output.
    ends: Vec<usize>,
    ended: usize,
    /// Whether the record is complete.
    complete: bool,
    /// Records so far.
    number: u64,
    /// The line on which the record ends.
    line: u64,
}

impl Records {
    fn new() -> Self {
        Self {
            parser: csv_core::Reader::new(),
            input: Vec::new(),
            at: 0,
            output: vec![0; 1024],
            written: 0,
            // One more than a row may have, to find the rows that have too many.
            ends: vec![0; MOST_COLUMNS + 1],
            ended: 0,
            complete: true,
            number: 0,
            line: 0,
        }
    }

    fn push(&mut self, bytes: &[u8]) {
        self.input.drain(..self.at);
        self.at = 0;
        self.input.extend_from_slice(bytes);
    }

    /// Reads the next record. False if more bytes are needed, or at the end.
    fn next(&mut self, at_end: bool) -> Result<bool, ReadError> {
        if self.complete {
            (self.written, self.ended, self.complete) = (0, 0, false);
        }
        loop {
            let input = &self.input[self.at..];
            // An empty input is the end for the parser.
            if input.is_empty() && !at_end {
                return Ok(false);
            }
            let (output, ends) = (&mut self.output[self.written..], &mut self.ends[self.ended..]);
            let (result, read, written, ended) = self.parser.read_record(input, output, ends);
            let ends_line = input[..read].ends_with(b"\n");
            self.at += read;
            self.written += written;
            self.ended += ended;
            match result {
                ReadRecordResult::InputEmpty => {}
                ReadRecordResult::OutputFull if self.output.len() < LONGEST_ROW => {
                    self.output.resize(2 * self.output.len(), 0);
                }
                ReadRecordResult::OutputFull => {
                    return Err(
                        self.fault(&format!("is longer than {LONGEST_ROW} bytes: a quote may be open"))
                    );
                }
                ReadRecordResult::OutputEndsFull => {
                    return Err(self.fault(&format!("has more than {MOST_COLUMNS} values")));
                }
                ReadRecordResult::Record => {
                    self.number += 1;
                    self.line = self.parser.line() - u64::from(ends_line);
                    self.complete = true;
                    return Ok(true);
                }
                ReadRecordResult::End => return Ok(false),
            }
        }
    }

    fn fault(&self, detail: &str) -> ReadError {
        ReadError::Malformed(format!("row {} of the CSV text {detail}", self.number + 1))
    }

    fn count(&self) -> usize {
        self.ended
    }

    fn field(&self, field: usize) -> std::borrow::Cow<'_, str> {
        let start = if field == 0 { 0 } else { self.ends[field - 1] };
        String::from_utf8_lossy(&self.output[start..self.ends[field]])
    }
}
