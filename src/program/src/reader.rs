//! Reads a program from chunks of bytes or from a source.

use std::io::BufRead;
use std::ops::ControlFlow;

use crate::apt::AptReader;
use crate::builder::Builder;
use crate::error::{ProgramErrors, ReadError};
use crate::format::Format;
use crate::gcode::GcodeReader;
use crate::lines::{LineReader, LineSplitter};
use crate::options::ReadOptions;
use crate::program::Program;
use crate::rows::csv::CsvReader;
use crate::rows::ndjson::NdjsonReader;
use crate::rows::table::TableReader;

/// Reads a program whose bytes arrive in chunks.
///
/// ```
/// use verne_program::{Format, ReadOptions, Reader};
///
/// let mut reader = Reader::new(Format::Csv, &ReadOptions::default());
/// for chunk in ["x,y", ",z\n1,2,", "3\n"] {
///     if reader.push(chunk.as_bytes()).is_break() {
///         break;
///     }
/// }
/// assert_eq!(reader.finish()?.moves()[0].tip(), [1.0, 2.0, 3.0]);
/// # Ok::<(), verne_program::ProgramErrors>(())
/// ```
#[derive(Debug)]
pub struct Reader(Input);

#[derive(Debug)]
enum Input {
    /// Text, line by line.
    Lines(LineSplitter, Box<dyn LineReader>),
    /// A table in binary form.
    Table(Box<TableReader>),
}

impl Reader {
    /// A reader that has read nothing yet.
    pub fn new(format: Format, options: &ReadOptions) -> Self {
        let format: Box<dyn LineReader> = match format {
            Format::Apt => Box::new(AptReader::new(options)),
            Format::Gcode => Box::new(GcodeReader::new(options)),
            Format::Csv => Box::new(CsvReader::new(options)),
            Format::Ndjson => Box::new(NdjsonReader::new(options)),
            Format::Arrow => return Self(Input::Table(Box::new(TableReader::new(options)))),
        };
        Self(Input::Lines(LineSplitter::default(), format))
    }

    /// Reads the next bytes. `Break` says that the program is refused and no more bytes are needed;
    /// [`finish`](Self::finish) then returns the faults.
    pub fn push(&mut self, chunk: &[u8]) -> ControlFlow<()> {
        if self.builder().diagnostics.is_stopped() {
            return ControlFlow::Break(());
        }
        match &mut self.0 {
            Input::Lines(lines, format) => lines.push(chunk, format.as_mut()),
            Input::Table(table) => table.push(chunk),
        }
    }

    /// About the bytes of memory that the program takes so far.
    ///
    /// ```
    /// use verne_program::{Format, ReadOptions, Reader};
    ///
    /// let mut reader = Reader::new(Format::Csv, &ReadOptions::default());
    /// let _ = reader.push(b"x,y,z\n1,2,3\n");
    /// assert_eq!(reader.memory(), 72);
    /// ```
    pub fn memory(&mut self) -> usize {
        self.builder().memory()
    }

    /// The program, after its last byte.
    ///
    /// # Errors
    ///
    /// The faults of the program.
    pub fn finish(mut self) -> Result<Program, ProgramErrors> {
        let is_stopped = self.builder().diagnostics.is_stopped();
        let builder = match self.0 {
            Input::Lines(mut lines, mut format) => {
                if !is_stopped {
                    lines.finish(format.as_mut());
                }
                format.into_builder()
            }
            Input::Table(table) => table.into_builder(),
        };
        builder.finish()
    }

    fn builder(&mut self) -> &mut Builder {
        match &mut self.0 {
            Input::Lines(_, format) => format.builder(),
            Input::Table(table) => table.builder(),
        }
    }
}

/// Reads a program from a source, in memory that depends on the program alone and not on the size of the source.
///
/// # Errors
///
/// - [`ReadError::Source`]: the source cannot be read.
/// - [`ReadError::Program`]: the program has faults.
///
/// ```
/// use verne_program::{Format, ReadOptions, read};
///
/// let rows = "[0, 0, 300, 0, 0]\n{\"x\": 10, \"y\": 0, \"z\": 300, \"phi1\": 20, \"phi2\": 45, \"feed\": 800}\n";
/// let program = read(Format::Ndjson, rows.as_bytes(), &ReadOptions::default())?;
/// assert_eq!(program.moves().len(), 2);
/// # Ok::<(), verne_program::ReadError>(())
/// ```
pub fn read(format: Format, mut source: impl BufRead, options: &ReadOptions) -> Result<Program, ReadError> {
    let mut reader = Reader::new(format, options);
    loop {
        let chunk = source.fill_buf()?;
        let length = chunk.len();
        if length == 0 || reader.push(chunk).is_break() {
            return Ok(reader.finish()?);
        }
        source.consume(length);
    }
}
