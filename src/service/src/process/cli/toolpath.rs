//! `verne toolpath`: plans the joint motion of a program without a server.

mod output;
mod summary;

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use flate2::read::GzDecoder;
use verne_program::joint_program::JointProgramOptions;
use verne_program::{Format, line_texts};

use crate::operations::joint_program::JointProgramText;
use crate::operations::programs::receiver::ReceivedProgram;
use crate::operations::toolpath::compute_toolpath;
use crate::operations::toolpath_question::ToolpathQuestion;
use crate::operations::toolpath_report::is_feasible;
use crate::operations::toolpath_row_text::{RowText, RowWriter};
use crate::process::cli::answer::exit_status;
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::files::{is_standard, remove};
use crate::process::cli::program_arguments::ProgramArguments;
use crate::process::cli::progress::TerminalProgress;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::toolpath::output::{OutputFormat, RowsOutput};
use crate::process::cli::toolpath::summary::Summary;
use crate::wire::error::OperationError;
use crate::wire::joint_program::JointProgramQuery;

/// The command.
#[derive(Debug, Args)]
pub(crate) struct ToolpathCommand {
    #[command(flatten)]
    program: ProgramArguments,
    #[command(flatten)]
    joint_program: JointProgramQuery,
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
        // Before the computation: the extension may be unknown.
        let format = output.map(output::format).transpose()?;
        let written = [("--output", output), ("--report", self.report.as_deref())];
        let (checked, file) = self.program.checked(&written)?;
        let faults = |error| file.message(error);
        let options = self.joint_program.into_options().map_err(faults)?;
        let (question, received) = file.receive(checked)?;
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
