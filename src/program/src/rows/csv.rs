//! Rows below a row of names. The row of names tells whether commas, semicolons or tabs separate the columns.

use csv_core::{ReadRecordResult, Reader, ReaderBuilder};

use crate::builder::Builder;
use crate::diagnostics::shortened;
use crate::error::ProgramError;
use crate::lines::LineReader;
use crate::moves::MoveKind;
use crate::options::ReadOptions;
use crate::rows::row::{NAMES, Named};
use crate::rows::row_builder::{At, RowBuilder};

/// The most columns of a file.
const MOST_COLUMNS: usize = 256;

/// The separators of columns. If a row of names has as many of one as of another, the first of them counts.
const SEPARATORS: [u8; 3] = *b",;\t";

/// The columns that are read.
const KNOWN: [&str; 11] = ["x", "y", "z", "i", "j", "k", "phi1", "phi2", "feed", "kind", "line"];

/// Reads CSV.
#[derive(Debug)]
pub(crate) struct CsvReader {
    rows: RowBuilder,
    fields: Fields,
    /// The name of each column: an index into the known ones.
    columns: Option<Vec<Option<usize>>>,
}

/// A value that cannot be read: its column in the file, and the reason.
struct BadValue {
    field: usize,
    detail: String,
}

impl CsvReader {
    pub(crate) fn new(options: &ReadOptions) -> Self {
        Self { rows: RowBuilder::new(options), fields: Fields::new(), columns: None }
    }

    fn header(&mut self, number: u32) -> Result<Vec<Option<usize>>, BadValue> {
        let mut columns = Vec::new();
        for field in 0..self.fields.count {
            let name = self.fields.get(field).to_ascii_lowercase();
            let known = KNOWN.iter().position(|known| *known == name);
            if known.is_none() {
                if name.parse::<f64>().is_ok() {
                    let detail = format!("the first row must name the columns; accepted are {NAMES}");
                    return Err(BadValue { field, detail });
                }
                self.rows.builder.diagnostics.warn(number, &name, "the column is not read");
            } else if columns.contains(&known) {
                return Err(BadValue { field, detail: "the column is named twice".to_owned() });
            }
            columns.push(known);
        }
        // Which columns there are is the same for all rows: a row of ones tells whether they are enough.
        let mut named = Named::default();
        for known in columns.iter().flatten() {
            // A kind is no number, and none is needed here.
            let _ = set(&mut named, *known, "1");
        }
        named.row().map_err(not_a_row)?;
        Ok(columns)
    }

    fn row(&mut self, number: u32, columns: &[Option<usize>]) -> Result<(), BadValue> {
        let count = self.fields.count;
        if count != columns.len() {
            let detail =
                format!("the row has {count} values; accepted are {}, one per column", columns.len());
            return Err(BadValue { field: count.saturating_sub(1), detail });
        }
        let mut named = Named::default();
        for (field, known) in columns.iter().enumerate() {
            if let Some(known) = known {
                let value = self.fields.get(field);
                set(&mut named, *known, value).map_err(|detail| BadValue { field, detail })?;
            }
        }
        let row = named.row().map_err(not_a_row)?;
        self.rows.row(number, &row).map_err(|(at, detail)| {
            let field = match at {
                At::Row => 0,
                At::Name(name) => columns
                    .iter()
                    .position(|known| known.is_some_and(|known| KNOWN[known] == name))
                    .unwrap_or(0),
            };
            BadValue { field, detail }
        })
    }
}

fn not_a_row(reason: &str) -> BadValue {
    BadValue { field: 0, detail: format!("{reason}; accepted are {NAMES}") }
}

/// Sets a named value from its text. An empty text sets nothing.
fn set(named: &mut Named, known: usize, text: &str) -> Result<(), String> {
    if text.is_empty() {
        return Ok(());
    }
    let name = KNOWN[known];
    let Some(place) = named.number(name) else {
        if name == "kind" {
            named.kind = Some(match text.to_ascii_lowercase().as_str() {
                "feed" => MoveKind::Feed,
                "rapid" => MoveKind::Rapid,
                _ => return Err("there is no such kind; accepted are feed and rapid".to_owned()),
            });
        } else {
            let line = text.parse();
            named.line =
                Some(line.map_err(|_| "line must be a whole number from 0 to 4294967295".to_owned())?);
        }
        return Ok(());
    };
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => *place = Some(value),
        _ => {
            let point = text.replacen(',', ".", 1);
            return Err(if text.contains(',') && point.parse::<f64>().is_ok() {
                format!("{name} has a decimal comma; write {point}")
            } else {
                format!("{name} must be a finite number with a decimal point")
            });
        }
    }
    Ok(())
}

impl LineReader for CsvReader {
    fn line(&mut self, number: u32, line: &[u8]) {
        if line.trim_ascii().is_empty() {
            return;
        }
        if self.columns.is_none() {
            self.fields.separate_as(line);
        }
        let outcome = if !self.fields.split(line) {
            let detail = format!("a row has at most {MOST_COLUMNS} values, and quotes end in their row");
            Err(BadValue { field: 0, detail })
        } else if let Some(columns) = self.columns.take() {
            let outcome = self.row(number, &columns);
            self.columns = Some(columns);
            outcome
        } else {
            self.header(number).map(|columns| self.columns = Some(columns))
        };
        let Err(BadValue { field, detail }) = outcome else { return };
        let error = ProgramError {
            line: number,
            column: self.fields.column(field, line),
            word: shortened(self.fields.get(field)),
            detail,
        };
        if self.columns.is_some() {
            self.rows.builder.diagnostics.fault(error);
        } else {
            // Without names no row can be read.
            self.rows.builder.diagnostics.stop(error);
        }
    }

    fn end(&mut self, _terminated: bool) {}

    fn builder(&mut self) -> &mut Builder {
        &mut self.rows.builder
    }

    fn into_builder(self: Box<Self>) -> Builder {
        self.rows.builder
    }
}

/// The fields of one line.
#[derive(Debug)]
struct Fields {
    separator: u8,
    parser: Reader,
    input: Vec<u8>,
    output: Vec<u8>,
    ends: [usize; MOST_COLUMNS],
    count: usize,
}

impl Fields {
    fn new() -> Self {
        Self {
            separator: SEPARATORS[0],
            parser: Reader::new(),
            input: Vec::new(),
            output: Vec::new(),
            ends: [0; MOST_COLUMNS],
            count: 0,
        }
    }

    /// Fields are separated by what separates those of this line: the most frequent separator outside quotes.
    fn separate_as(&mut self, line: &[u8]) {
        let counts = SEPARATORS.map(|separator| unquoted(line, separator).count());
        let most = counts.iter().max();
        let chosen = SEPARATORS.into_iter().zip(&counts).find(|(_, count)| Some(*count) == most);
        self.separator = chosen.map_or(SEPARATORS[0], |(separator, _)| separator);
        self.parser = ReaderBuilder::new().delimiter(self.separator).build();
    }

    /// Splits a line. False if it has too many fields or an open quote.
    fn split(&mut self, line: &[u8]) -> bool {
        self.input.clear();
        self.input.extend_from_slice(line);
        self.input.push(b'\n');
        self.output.resize(self.input.len(), 0);
        self.parser.reset();
        let (result, _, _, count) = self.parser.read_record(&self.input, &mut self.output, &mut self.ends);
        self.count = if result == ReadRecordResult::Record { count } else { 0 };
        result == ReadRecordResult::Record
    }

    /// A field without the blanks around it; empty if the line has no such field.
    fn get(&self, field: usize) -> &str {
        if field >= self.count {
            return "";
        }
        let start = if field == 0 { 0 } else { self.ends[field - 1] };
        std::str::from_utf8(&self.output[start..self.ends[field]]).unwrap_or("\u{FFFD}").trim()
    }

    /// The byte of the line where a field begins, from 1.
    fn column(&self, field: usize, line: &[u8]) -> u32 {
        let mut separators = unquoted(line, self.separator);
        let at = match field.checked_sub(1) {
            Some(before) => separators.nth(before).map_or(line.len(), |at| at + 1),
            None => 0,
        };
        u32::try_from(at + 1).unwrap_or(u32::MAX)
    }
}

/// The places of a byte in a line outside quotes.
fn unquoted(line: &[u8], byte: u8) -> impl Iterator<Item = usize> {
    let mut quoted = false;
    line.iter().enumerate().filter_map(move |(at, here)| {
        quoted ^= *here == b'"';
        (*here == byte && !quoted).then_some(at)
    })
}
