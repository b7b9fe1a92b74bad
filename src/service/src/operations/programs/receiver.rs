//! Reads a program while its bytes arrive, hashes them, and keeps them compressed.

use std::io::{self, Write};
use std::ops::ControlFlow;
use std::sync::Arc;

use bytes::Bytes;
use flate2::Compression;
use flate2::write::GzEncoder;
use verne_program::{Format, Program, ReadOptions, Reader, Row, read_points};

use crate::wire::error::OperationError;
use crate::wire::program::{FileSize, ProgramSummary};
use crate::wire::result_id::ResultId;

/// Begins the hash of a program.
const ID_PREFIX: &[u8] = b"verne program 1";

/// A program that was received, and is not stored yet.
#[derive(Clone, Debug)]
pub(crate) struct ReceivedProgram {
    /// The hash of the file, its format, the options for reading, and the version and the target of the binary.
    pub id: ResultId,
    /// The format.
    pub format: Format,
    /// The program.
    pub program: Arc<Program>,
    /// The file, compressed with gzip.
    pub source: Bytes,
    /// The size of the file.
    pub size: FileSize,
}

impl ReceivedProgram {
    /// The summary, as it is sent.
    pub(crate) fn summary(&self) -> Option<ProgramSummary> {
        ProgramSummary::new(self.id, self.format, self.size, &self.program)
    }
}

/// Receives a program. It blocks the thread for the time that reading takes: call it on the compute pool.
#[derive(Debug)]
pub(crate) struct ProgramReceiver {
    format: Format,
    reader: Reader,
    file: ReceivedFile,
}

impl ProgramReceiver {
    /// A receiver that has got nothing yet.
    pub(crate) fn new(format: Format, options: &ReadOptions) -> Self {
        Self { format, reader: Reader::new(format, options), file: ReceivedFile::new(format, options) }
    }

    /// Takes the next bytes. `Break` says that the program is refused; [`finish`](Self::finish) then returns its
    /// faults.
    pub(crate) fn push(&mut self, chunk: &[u8]) -> ControlFlow<()> {
        self.reader.push(chunk)?;
        self.file.push(chunk);
        ControlFlow::Continue(())
    }

    /// About the bytes of memory that the receiver takes.
    pub(crate) fn memory(&mut self) -> usize {
        self.reader.memory() + self.file.source.get_ref().len()
    }

    /// The program, after its last byte.
    ///
    /// # Errors
    ///
    /// [`OperationError::ProgramFaults`]
    pub(crate) fn finish(self) -> Result<ReceivedProgram, OperationError> {
        let program = self.reader.finish().map_err(OperationError::ProgramFaults)?;
        self.file.with_program(self.format, program)
    }
}

/// The program of rows that a request contains. It has the id of the file that has one row per line, as NDJSON in its
/// shortest form, which is also its source.
///
/// # Errors
///
/// [`OperationError::ProgramFaults`]
pub(crate) fn receive_points(rows: &[Row], options: &ReadOptions) -> Result<ReceivedProgram, OperationError> {
    let program = read_points(rows.iter().copied(), options).map_err(OperationError::ProgramFaults)?;
    let mut file = ReceivedFile::new(Format::Ndjson, options);
    let mut line = Vec::new();
    for row in rows {
        line.clear();
        serde_json::to_writer(&mut line, row).map_err(|_| OperationError::Internal)?;
        line.push(b'\n');
        file.push(&line);
    }
    file.with_program(Format::Ndjson, program)
}

/// The bytes of a file.
#[derive(Debug)]
struct ReceivedFile {
    hasher: blake3::Hasher,
    source: GzEncoder<Vec<u8>>,
    /// The outcome of compressing so far.
    outcome: io::Result<()>,
    size: FileSize,
    /// Whether the last byte was not the end of a line.
    is_line_open: bool,
}

impl ReceivedFile {
    fn new(format: Format, options: &ReadOptions) -> Self {
        let mut hasher = ResultId::hasher(ID_PREFIX);
        // The text has no fixed length, its hash has.
        let reading = serde_json::json!([format.name(), options]).to_string();
        hasher.update(blake3::hash(reading.as_bytes()).as_bytes());
        let source = GzEncoder::new(Vec::new(), Compression::fast());
        Self { hasher, source, outcome: Ok(()), size: FileSize::default(), is_line_open: false }
    }

    fn push(&mut self, chunk: &[u8]) {
        self.hasher.update(chunk);
        if self.outcome.is_ok() {
            self.outcome = self.source.write_all(chunk);
        }
        let ends = chunk.split(|byte| *byte == b'\n').count() - 1;
        self.size.bytes += chunk.len() as u64;
        self.size.lines = self.size.lines.saturating_add(u32::try_from(ends).unwrap_or(u32::MAX));
        if let Some(last) = chunk.last() {
            self.is_line_open = *last != b'\n';
        }
    }

    fn with_program(self, format: Format, program: Program) -> Result<ReceivedProgram, OperationError> {
        let Self { hasher, source, outcome, mut size, is_line_open } = self;
        size.lines = size.lines.saturating_add(is_line_open.into());
        if format == Format::Arrow {
            // A line is a row.
            size.lines = u32::try_from(program.moves().len()).unwrap_or(u32::MAX);
        }
        let source = outcome.and_then(|()| source.finish()).map_err(|_| OperationError::Internal)?;
        let id = hasher.finalize().into();
        Ok(ReceivedProgram { id, format, program: Arc::new(program), source: source.into(), size })
    }
}
