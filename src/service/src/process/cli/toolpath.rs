//! `verne toolpath`: plans the joint motion of a program without a server.

mod output;
mod summary;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use flate2::read::GzDecoder;
use verne_program::joint_program::JointProgramOptions;
use verne_program::{Format, FormatError, line_texts};

use crate::operations::joint_program::JointProgramText;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::programs::receiver::{ProgramReceiver, ReceivedProgram};
use crate::operations::toolpath::compute_toolpath;
use crate::operations::toolpath_question::{CheckedToolpath, ToolpathQuestion};
use crate::operations::toolpath_report::is_feasible;
use crate::operations::toolpath_row_text::{RowText, RowWriter};
use crate::process::cli::answer::{exit_status, flags_of_query, machine};
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::files::{is_standard, name_of, refuse_equal_files, remove, source};
use crate::process::cli::progress::TerminalProgress;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::toolpath::output::{OutputFormat, RowsOutput};
use crate::process::cli::toolpath::summary::Summary;
use crate::wire::error::OperationError;
use crate::wire::joint_program::JointProgramQuery;
use crate::wire::program_query::ProgramQuery;
use crate::wire::toolpath::ToolpathRequest;
use crate::wire::toolpath_query::{ToolpathQuery, point_into_toolpath_query};

/// Bytes that are read at once.
const PIECE_BYTES: usize = 256 * 1024;

/// The command.
#[derive(Debug, Args)]
pub(crate) struct ToolpathCommand {
    /// The file of the program; `-` is standard input. Without --format its extension tells the format.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    reading: ProgramQuery,
    #[command(flatten)]
    query: ToolpathQuery,
    #[command(flatten)]
    program: JointProgramQuery,
    /// Write the joint motion to this file: its rows as .csv, .ndjson or .json, or a joint program as .ngc or .nc; `-`
    /// writes CSV to standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write the report, which is the JSON that the HTTP service would answer, to this file. Default: standard output,
    /// unless the rows go there or it is a terminal.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    #[command(flatten)]
    format: AnswerFormat,
}

impl ToolpathCommand {
    /// Writes rows and report, and a summary in words to `err`. The exit status is 3 if the machine cannot run the
    /// program.
    pub(crate) fn run(
        self,
        out: &mut impl Write,
        err: &mut impl Write,
        terminal: Option<Terminal>,
    ) -> Result<ExitCode, String> {
        let output = self.output.as_deref();
        let rows_take_standard_output = output.is_some_and(is_standard);
        if rows_take_standard_output && self.report.as_deref().is_some_and(is_standard) {
            return Err("--output and --report cannot both be standard output".to_owned());
        }
        let machine_file = Some(Path::new(&self.query.machine)).filter(|path| path.is_file());
        refuse_equal_files(
            &[("the program", Some(&*self.file)), ("the machine", machine_file)],
            &[("--output", output), ("--report", self.report.as_deref())],
        )?;
        // Before the computation: the extension may be unknown.
        let format = output.map(output::format).transpose()?;
        let file = name_of(&self.file);
        let faults = |error| message(&file, error);
        let machine = machine(&self.query.machine)?;
        let request = ToolpathRequest { machine, ..self.query.into_request() };
        let options = self.program.into_options().map_err(faults)?;
        let checked = CheckedToolpath::new(&request, &MachineRegistry::default()).map_err(faults)?;
        let received = receive(&self.file, &self.reading, faults)?;
        let question = checked.question(received.id).with_program(&received.program).map_err(faults)?;
        let rows = match (output, format) {
            (Some(path), Some(format)) => {
                let writer = writer(format, options, &question, &received).map_err(faults)?;
                Some(RowsOutput::new(path, writer, out)?)
            }
            _ => None,
        };
        let joint_program = output.filter(|_| format == Some(OutputFormat::JointProgram));
        let planned = plan(&question, &received, rows, faults);
        if let Some(path) = joint_program
            && !planned.as_ref().is_ok_and(|report| is_feasible(report))
        {
            remove(path);
        }
        let report = planned?;
        match self.report.as_deref() {
            // The summary says on a terminal what matters.
            None if rows_take_standard_output || self.format.words_on(terminal).is_some() => {}
            path => output::write_report(&report, path, out, self.format.has_line_breaks(terminal))?,
        }
        let summary = Summary::read(&report)?;
        // If standard error is closed, report and exit status still tell the verdict.
        drop(summary.write(err));
        Ok(exit_status(summary.is_ok()))
    }
}

/// The writer of the output.
fn writer(
    format: OutputFormat,
    options: JointProgramOptions,
    question: &ToolpathQuestion,
    received: &ReceivedProgram,
) -> Result<Box<dyn RowText>, OperationError> {
    Ok(match format {
        OutputFormat::Rows(format) => Box::new(RowWriter::new(question.id, format, 0)?),
        OutputFormat::JointProgram => Box::new(JointProgramText::new(options, question, &received.program)?),
    })
}

/// Plans the program, and returns the report as JSON.
fn plan(
    question: &ToolpathQuestion,
    received: &ReceivedProgram,
    mut rows: Option<RowsOutput<'_>>,
    faults: impl Fn(OperationError) -> String,
) -> Result<Vec<u8>, String> {
    let texts = |lines: &[u32]| {
        if received.format == Format::Arrow {
            return Ok(Vec::new());
        }
        let source = io::BufReader::new(GzDecoder::new(&*received.source));
        Ok(line_texts(source, lines).unwrap_or_default())
    };
    let mut failed = None;
    let put = |_, chunk: Vec<u8>| {
        let Some(rows) = &mut rows else { return Ok(()) };
        rows.write(&chunk).map_err(|error| {
            failed = Some(error);
            OperationError::Cancelled
        })
    };
    let progress = TerminalProgress::new();
    let report = compute_toolpath(question, &received.program, texts, put, &progress);
    drop(progress);
    if let Some(message) = failed {
        return Err(message);
    }
    let report = report.map_err(faults)?;
    rows.map_or(Ok(()), RowsOutput::finish)?;
    Ok(report)
}

/// Reads the program.
pub(crate) fn receive(
    path: &Path,
    reading: &ProgramQuery,
    faults: impl Fn(OperationError) -> String,
) -> Result<ReceivedProgram, String> {
    let name = path.file_name().and_then(|name| name.to_str()).filter(|_| !is_standard(path));
    let format = Format::detect(reading.format.as_deref(), name, None);
    let format = format.map_err(|error| match error {
        FormatError::Undetermined => format!("--format is missing: the name of {} tells none", name_of(path)),
        other => format!("{}: {other}", name_of(path)),
    })?;
    let unreadable = |error: io::Error| format!("{}: {error}", name_of(path));
    let mut source = source(path)?;
    let mut receiver = ProgramReceiver::new(format, &reading.options(format).map_err(&faults)?);
    let mut piece = vec![0; PIECE_BYTES];
    loop {
        let count = source.read(&mut piece).map_err(unreadable)?;
        if count == 0 || receiver.push(&piece[..count]).is_break() {
            return receiver.finish().map_err(faults);
        }
    }
}

/// An error as a message: faults of the program with the places in the file, invalid fields with their flags.
pub(crate) fn message(file: &str, error: OperationError) -> String {
    match error {
        OperationError::ProgramFaults(refused) => {
            let stopped = if refused.complete { "" } else { "\n  the reader stopped here" };
            let faults = refused.errors.iter().map(|fault| format!("\n  {fault}"));
            format!("{file} cannot be read as a program{}{stopped}", faults.collect::<String>())
        }
        OperationError::Fields(_) => flags_of_query(point_into_toolpath_query(error)),
        other => other.to_string(),
    }
}
