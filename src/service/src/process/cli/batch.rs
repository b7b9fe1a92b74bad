//! `--batch` of `verne ik`, `verne fk`, `verne error-budget` and `verne contains`: answers the rows of a file while it
//! reads them.

pub(crate) mod summary;

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use verne_rows::Format;

use crate::operations::contains_columns::ContainsColumns;
use crate::operations::error_budget_columns::ErrorBudgetColumns;
use crate::operations::forward_columns::ForwardColumns;
use crate::operations::inverse_columns::InverseColumns;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::observers::ObserverFns;
use crate::operations::row_stream::{RowAnswer, RowStream};
use crate::process::cli::answer::{exit_status, machine, with_flags};
use crate::process::cli::batch::summary::{message, write_summary};
use crate::process::cli::files::{destination, is_standard, name_of, refuse_equal_files, remove, source};
use crate::process::cli::progress::ReadProgress;
use crate::wire::batch::{FkBatchNumbers, IkBatchNumbers};
use crate::wire::error::OperationError;
use crate::wire::error_budget::ErrorBudgetRowsQuery;
use crate::wire::machine_ref::MachineRef;
use crate::wire::row_query::{ContainsRowsQuery, FkRowsQuery, IkRowsQuery};
use crate::wire::workspace::WorkspaceRequest;

/// Bytes that are read at once.
const PIECE_BYTES: usize = 256 * 1024;

/// Greatest size of a message of Arrow, which has to be in memory as a whole.
const MESSAGE_BYTES: usize = 256 * 1024 * 1024;

/// A batch: its files, and what is not a row.
#[derive(Debug, Args)]
pub(crate) struct BatchCommand<Q: Args> {
    /// Answer each row of this file, which is a table with named columns: .csv, .ndjson, .jsonl or .arrow (the
    /// streaming format); `-` is standard input. Other columns are passed on, except those with the
    /// name of a column of the answer.
    #[arg(long, value_name = "FILE")]
    batch: PathBuf,
    /// Write the answers to this file, in the format of its extension. Default: standard output.
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    output: PathBuf,
    /// Format of standard input and standard output. Default: csv.
    #[arg(long, value_parser = format_parser())]
    format: Option<Format>,
    #[command(flatten)]
    query: Q,
}

/// What is not a row.
pub(crate) trait BatchQuery: Args {
    /// The name of the machine, or the path of its file.
    fn machine(&self) -> &str;

    /// Checks the request.
    fn into_answer(self, machine: MachineRef) -> Result<Box<dyn RowAnswer>, OperationError>;
}

impl BatchQuery for IkRowsQuery {
    fn machine(&self) -> &str {
        &self.machine
    }

    fn into_answer(self, machine: MachineRef) -> Result<Box<dyn RowAnswer>, OperationError> {
        let request = IkBatchNumbers { machine, ..self.into() };
        Ok(Box::new(InverseColumns::new(&request, &MachineRegistry::default())?))
    }
}

impl BatchQuery for FkRowsQuery {
    fn machine(&self) -> &str {
        &self.machine
    }

    fn into_answer(self, machine: MachineRef) -> Result<Box<dyn RowAnswer>, OperationError> {
        let request = FkBatchNumbers { machine, ..self.into() };
        Ok(Box::new(ForwardColumns::new(&request, &MachineRegistry::default())?))
    }
}

impl BatchQuery for ContainsRowsQuery {
    fn machine(&self) -> &str {
        &self.machine
    }

    fn into_answer(self, machine: MachineRef) -> Result<Box<dyn RowAnswer>, OperationError> {
        let request = WorkspaceRequest { machine, ..self.into() };
        Ok(Box::new(ContainsColumns::new(&request, &MachineRegistry::default())?))
    }
}

impl BatchQuery for ErrorBudgetRowsQuery {
    fn machine(&self) -> &str {
        &self.machine
    }

    fn into_answer(self, machine: MachineRef) -> Result<Box<dyn RowAnswer>, OperationError> {
        let request = self.into_request(machine)?;
        Ok(Box::new(ErrorBudgetColumns::new(&request, &MachineRegistry::default())?))
    }
}

impl<Q: BatchQuery> BatchCommand<Q> {
    /// Writes the answers to `out` or to a file, and a summary in words to `err`. The exit status is 3 if a row has no
    /// answer. No progress is shown over answers on a terminal.
    pub(crate) fn run(
        self,
        out: &mut impl Write,
        err: &mut impl Write,
        out_is_terminal: bool,
    ) -> Result<ExitCode, String> {
        let Self { batch, output, format, query } = self;
        let machine_file = Some(Path::new(query.machine())).filter(|path| path.is_file());
        let read = [("the rows", Some(&*batch)), ("the machine", machine_file)];
        refuse_equal_files(&read, &[("--output", Some(&*output))])?;
        if format.is_some() && !is_standard(&batch) && !is_standard(&output) {
            return Err(
                "--format is for standard input and output; a file has the format of its extension".into()
            );
        }
        let (from, to) = (format_of("--batch", &batch, format)?, format_of("--output", &output, format)?);
        let machine = machine(query.machine())?;
        let answer = query.into_answer(machine).map_err(with_flags)?;
        let progress = if is_standard(&output) && out_is_terminal {
            ReadProgress::hidden()
        } else {
            // A pipe has no length.
            let length = batch.metadata().ok().filter(std::fs::Metadata::is_file);
            ReadProgress::new(length.map(|file| file.len()))
        };
        let stream = RowStream::new(answer, from, to, MESSAGE_BYTES);
        let source = source(&batch)?;
        let mut rows = AnsweredRows {
            stream,
            source,
            name: name_of(&batch),
            piece: vec![0; PIECE_BYTES],
            ended: false,
            progress,
        };
        rows.write(&output, out)?;
        let AnsweredRows { stream, progress, .. } = rows;
        drop(progress);
        // If standard error is closed, answers and exit status still tell the outcome.
        drop(write_summary(stream.tally(), err));
        Ok(exit_status(stream.tally().unanswered() == 0))
    }
}

/// The rows of a file and their answers.
struct AnsweredRows {
    stream: RowStream,
    source: Box<dyn Read>,
    /// The file as messages name it.
    name: String,
    piece: Vec<u8>,
    /// Whether the file is read to its end.
    ended: bool,
    progress: ReadProgress,
}

impl AnsweredRows {
    /// Writes all answers. The file is created when the first rows are answered, and removed if a later one cannot be.
    fn write(&mut self, path: &Path, out: &mut dyn Write) -> Result<(), String> {
        let mut next = self.next()?;
        let mut destination = destination(path, out)?;
        let name = if is_standard(path) { "the answers".to_owned() } else { path.display().to_string() };
        let mut write_all = || {
            while let Some(bytes) = next.take() {
                let written = destination.write_all(&bytes).and_then(|()| destination.flush());
                written.map_err(|error| format!("cannot write {name}: {error}"))?;
                next = self.next()?;
            }
            Ok(())
        };
        let written = write_all();
        drop(destination);
        if written.is_err() && !is_standard(path) {
            remove(path);
        }
        written
    }

    /// The next answers; `None` at the end.
    fn next(&mut self) -> Result<Option<Vec<u8>>, String> {
        let observer = ObserverFns { progress: |_| (), cancelled: || false };
        loop {
            let answered = self.stream.next(&observer).map_err(|error| message(&self.name, error))?;
            if answered.is_some() || self.ended {
                return Ok(answered);
            }
            let count =
                self.source.read(&mut self.piece).map_err(|error| format!("{}: {error}", self.name))?;
            self.progress.add(count);
            if count == 0 {
                self.stream.end();
                self.ended = true;
            } else {
                self.stream.push(&self.piece[..count]);
            }
        }
    }
}

/// The format of a file by its extension; that of standard input or output as stated, or CSV.
pub(crate) fn format_of(flag: &str, path: &Path, stated: Option<Format>) -> Result<Format, String> {
    if is_standard(path) {
        return Ok(stated.unwrap_or(Format::Csv));
    }
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    Format::of_extension(extension).ok_or_else(|| {
        format!(
            "{flag} {} must end in .csv, .ndjson, .jsonl or .arrow, or be - (see --format)",
            path.display()
        )
    })
}

pub(crate) fn format_parser() -> impl TypedValueParser<Value = Format> {
    let names = Format::ALL.map(Format::name);
    PossibleValuesParser::new(names).try_map(|name| Format::of_extension(&name).ok_or("unknown"))
}
