//! A JSON object in each line.

use std::borrow::Cow;
use std::fmt;

use serde::de::{self, Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

use crate::chunk::Chunk;
use crate::column::Column;
use crate::error::ReadError;
use crate::header::Header;
use crate::limits::{CHUNK_ROWS, LONGEST_ROW};
use crate::reader::builders::{Builders, Texts, empty_columns};
use crate::source::Source;

/// Reads NDJSON. The first object names the columns. A later line that is no such object is a fault of this row alone.
#[derive(Debug)]
pub(crate) struct NdjsonSource {
    numbers: &'static [&'static str],
    lines: Lines,
    table: Option<(Header, Builders)>,
}

impl NdjsonSource {
    pub(crate) fn new(numbers: &'static [&'static str]) -> Self {
        Self { numbers, lines: Lines::default(), table: None }
    }
}

impl Source for NdjsonSource {
    fn push(&mut self, bytes: &[u8]) {
        self.lines.push(bytes);
    }

    fn next_chunk(&mut self, ended: bool) -> Result<Option<Chunk>, ReadError> {
        loop {
            if self.table.as_ref().is_some_and(|(_, builders)| builders.rows() == CHUNK_ROWS) {
                break;
            }
            let Some(line) = self.lines.next(ended)? else { break };
            if line.text.trim_ascii().is_empty() {
                continue;
            }
            let (number, row) = (line.number, read_row(line.text));
            if let Some((header, builders)) = &mut self.table {
                add_row(header, builders, number, row);
            } else {
                let row = row.map_err(|reason| {
                    ReadError::Malformed(format!("the first line must be a JSON object: {reason}"))
                })?;
                let header = Header::new(row.0.iter().map(|(name, _)| name.to_string()), self.numbers)?;
                let mut builders = Builders::new(&header, Texts::Json);
                add_row(&header, &mut builders, number, Ok(row));
                self.table = Some((header, builders));
            }
        }
        match &mut self.table {
            Some((header, builders)) => Ok(builders.finish(header)),
            None if ended => Err(ReadError::Malformed("there is no row, so no columns are known".to_owned())),
            None => Ok(None),
        }
    }

    fn columns(&self) -> Option<Vec<Column>> {
        self.table.as_ref().map(|(header, _)| empty_columns(header, Texts::Json))
    }
}

fn read_row(line: &[u8]) -> Result<Object<'_>, String> {
    let mut json = serde_json::Deserializer::from_slice(line);
    let object = Object::deserialize(&mut json).and_then(|object| json.end().map(|()| object));
    // The parser knows one line only: its own " at line 1 column 7" would mislead.
    object.map_err(|error| error.to_string().replace(" at line 1 column", ", column"))
}

fn add_row(header: &Header, builders: &mut Builders, line: u64, row: Result<Object<'_>, String>) {
    let (row, mut fault) = match row {
        Ok(row) => (row.0, None),
        Err(reason) => (Vec::new(), Some(format!("the line is no JSON object: {reason}"))),
    };
    let mut matched = 0;
    for (column, known) in header.names.iter().enumerate() {
        // Nearly always all rows have the same order.
        let value = match row.get(column) {
            Some((name, value)) if *name == known.name => Some(*value),
            _ => row.iter().find(|(name, _)| *name == known.name).map(|(_, value)| *value),
        };
        matched += usize::from(value.is_some());
        let text = value.map(RawValue::get).filter(|text| *text != "null");
        builders.push(column, text);
    }
    if matched < row.len() && fault.is_none() {
        let other = row.iter().find(|(name, _)| !header.names.iter().any(|known| known.name == *name));
        fault = Some(match other {
            Some((name, _)) => format!("{name:?} is no column: the first row names the columns"),
            None => "a name occurs twice".to_owned(),
        });
    }
    builders.end_row(line, fault);
}

/// The names and values of an object, in their order.
struct Object<'a>(Vec<(Cow<'a, str>, &'a RawValue)>);

impl<'de> Deserialize<'de> for Object<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Entries;
        impl<'de> Visitor<'de> for Entries {
            type Value = Object<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Object<'de>, A::Error> {
                let mut entries = Vec::new();
                while let Some(Name(name)) = map.next_key()? {
                    entries.push((name, map.next_value()?));
                }
                Ok(Object(entries))
            }
        }
        deserializer.deserialize_map(Entries)
    }
}

/// A name; only one with escapes is copied.
struct Name<'a>(Cow<'a, str>);

impl<'de> Deserialize<'de> for Name<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Text;
        impl<'de> Visitor<'de> for Text {
            type Value = Name<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a name")
            }

            fn visit_borrowed_str<E: de::Error>(self, name: &'de str) -> Result<Name<'de>, E> {
                Ok(Name(Cow::Borrowed(name)))
            }

            fn visit_str<E: de::Error>(self, name: &str) -> Result<Name<'de>, E> {
                Ok(Name(Cow::Owned(name.to_owned())))
            }
        }
        deserializer.deserialize_str(Text)
    }
}

/// A line of the text.
struct Line<'a> {
    /// From 1.
    number: u64,
    text: &'a [u8],
}

/// Splits bytes into lines.
#[derive(Debug, Default)]
struct Lines {
    bytes: Vec<u8>,
    /// The bytes that are read.
    at: usize,
    /// The bytes in which there is no further end of a line.
    searched: usize,
    number: u64,
}

impl Lines {
    fn push(&mut self, bytes: &[u8]) {
        self.bytes.drain(..self.at);
        self.searched -= self.at;
        self.at = 0;
        self.bytes.extend_from_slice(bytes);
    }

    /// The next line; the last one may have no end.
    fn next(&mut self, at_end: bool) -> Result<Option<Line<'_>>, ReadError> {
        let rest = &self.bytes[self.searched..];
        let end = rest.iter().position(|byte| *byte == b'\n').map(|length| self.searched + length);
        self.searched = end.map_or(self.bytes.len(), |end| end + 1);
        if self.searched - self.at > LONGEST_ROW {
            let number = self.number + 1;
            return Err(ReadError::Malformed(format!("line {number} is longer than {LONGEST_ROW} bytes")));
        }
        let start = self.at;
        let end = match end {
            Some(end) => end,
            None if at_end && start < self.bytes.len() => self.bytes.len(),
            None => return Ok(None),
        };
        self.at = self.searched;
        self.number += 1;
        Ok(Some(Line { number: self.number, text: &self.bytes[start..end] }))
    }
}
