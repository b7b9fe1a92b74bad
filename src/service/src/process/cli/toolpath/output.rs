//! The files of `verne toolpath`.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use clap::ValueEnum;
use serde_json::Value;

use crate::operations::toolpath_question::ToolpathQuestion;
use crate::operations::toolpath_row_text::RowTextWriter;
use crate::operations::toolpath_rows::read_chunk;
use crate::process::cli::answer::to_json;
use crate::wire::toolpath_row::RowFormat;

/// Whether a path means standard input or output.
pub(super) fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// The format that the extension of a file of rows names.
pub(super) fn format(path: &Path) -> Result<RowFormat, String> {
    if is_standard(path) {
        return Ok(RowFormat::Csv);
    }
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    RowFormat::from_str(extension, true)
        .map_err(|_| format!("--output {} must end in .csv, .ndjson or .json", path.display()))
}

/// A file, or standard output for `-`.
fn destination<'a>(path: &Path, out: &'a mut dyn Write) -> Result<Box<dyn Write + 'a>, String> {
    if is_standard(path) {
        return Ok(Box::new(out));
    }
    let file = File::create(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(Box::new(BufWriter::new(file)))
}

/// The file of the rows, which is written while they are planned.
pub(super) struct RowsOutput<'a> {
    name: String,
    destination: Box<dyn Write + 'a>,
    writer: RowTextWriter,
}

impl<'a> RowsOutput<'a> {
    /// Creates the file.
    pub(super) fn new(
        path: &Path,
        format: RowFormat,
        question: &ToolpathQuestion,
        out: &'a mut dyn Write,
    ) -> Result<Self, String> {
        let (name, writer) = (path.display().to_string(), RowTextWriter::new(format, 0));
        let mut output = Self { name, destination: destination(path, out)?, writer };
        let head = output.writer.head(question.id);
        output.write_text(&head)?;
        Ok(output)
    }

    /// Writes a chunk of rows.
    pub(super) fn write(&mut self, chunk: &[u8]) -> Result<(), String> {
        let text = self.writer.rows(read_chunk(chunk)).map_err(|error| error.to_string())?;
        self.write_text(&text)
    }

    /// Writes the end of the file.
    pub(super) fn finish(mut self) -> Result<(), String> {
        let tail = self.writer.tail();
        self.write_text(&tail)?;
        self.destination.flush().map_err(|error| format!("{}: {error}", self.name))
    }

    fn write_text(&mut self, text: &str) -> Result<(), String> {
        self.destination.write_all(text.as_bytes()).map_err(|error| format!("{}: {error}", self.name))
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
    written.map_err(|error| format!("{}: {error}", path.display()))
}
