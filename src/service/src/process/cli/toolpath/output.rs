//! The files of `verne toolpath`.

use std::io::{ErrorKind, Write};
use std::path::Path;

use clap::ValueEnum;
use serde_json::Value;

use crate::operations::toolpath_row_text::RowText;
use crate::operations::toolpath_rows::read_chunk;
use crate::process::cli::answer::to_json;
use crate::process::cli::files::{destination, is_standard};
use crate::wire::row_format::RowFormat;

/// What is written to the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OutputFormat {
    /// The rows.
    Rows(RowFormat),
    /// The joint program.
    JointProgram,
}

/// The format that the extension of the output names.
pub(super) fn format(path: &Path) -> Result<OutputFormat, String> {
    if is_standard(path) {
        return Ok(OutputFormat::Rows(RowFormat::Csv));
    }
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    if ["ngc", "nc"].iter().any(|known| extension.eq_ignore_ascii_case(known)) {
        return Ok(OutputFormat::JointProgram);
    }
    RowFormat::from_str(extension, true).map(OutputFormat::Rows).map_err(|_| {
        format!("--output {} must end in .arrow, .csv, .ndjson, .json, .ngc or .nc", path.display())
    })
}

/// The file of the rows, which is written while they are planned.
pub(super) struct RowsOutput<'a> {
    name: String,
    destination: Box<dyn Write + 'a>,
    writer: Box<dyn RowText>,
}

impl<'a> RowsOutput<'a> {
    /// Creates the file.
    pub(super) fn new(path: &Path, writer: Box<dyn RowText>, out: &'a mut dyn Write) -> Result<Self, String> {
        Ok(Self { name: path.display().to_string(), destination: destination(path, out)?, writer })
    }

    /// Writes a chunk of rows.
    pub(super) fn write(&mut self, chunk: &[u8]) -> Result<(), String> {
        let text = self.writer.rows(&mut read_chunk(chunk)).map_err(|error| error.to_string())?;
        self.write_text(&text)
    }

    /// Writes the end of the file.
    pub(super) fn finish(self) -> Result<(), String> {
        let Self { name, mut destination, writer } = self;
        let tail = writer.tail().map_err(|error| error.to_string())?;
        let written = destination.write_all(&tail).and_then(|()| destination.flush());
        written.map_err(|error| format!("{name}: {error}"))
    }

    fn write_text(&mut self, text: &[u8]) -> Result<(), String> {
        self.destination.write_all(text).map_err(|error| format!("{}: {error}", self.name))
    }
}

/// Writes the report to a file, or to standard output with line breaks if `pretty`.
pub(super) fn write_report(
    report: &[u8],
    path: Option<&Path>,
    out: &mut dyn Write,
    pretty: bool,
) -> Result<(), String> {
    let path = path.unwrap_or(Path::new("-"));
    let answer: Value = serde_json::from_slice(report).map_err(|error| error.to_string())?;
    let text = to_json(&answer, pretty || !is_standard(path))?;
    let mut destination = destination(path, out)?;
    let written = writeln!(destination, "{text}").and_then(|()| destination.flush());
    if is_standard(path) && written.as_ref().is_err_and(|error| error.kind() == ErrorKind::BrokenPipe) {
        // The reader has read enough, and the verdict is known.
        return Ok(());
    }
    written.map_err(|error| format!("{}: {error}", path.display()))
}
