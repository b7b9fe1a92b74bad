//! The program of a command: its file, how it is read, its tool and its set-up.

use std::io;
use std::path::{Path, PathBuf};

use clap::Args;
use verne_program::{Format, FormatError};

use crate::operations::machine_registry::MachineRegistry;
use crate::operations::programs::receiver::{ProgramReceiver, ReceivedProgram};
use crate::operations::toolpath_question::{CheckedToolpath, ToolpathQuestion};
use crate::process::cli::answer::{flags_of_query, machine};
use crate::process::cli::files::{NamedFile, is_standard, name_of, refuse_equal_files, source};
use crate::wire::error::OperationError;
use crate::wire::program_query::ProgramQuery;
use crate::wire::toolpath::ToolpathRequest;
use crate::wire::toolpath_query::{ToolpathQuery, point_into_toolpath_query};

/// Bytes that are read at once.
const PIECE_BYTES: usize = 256 * 1024;

/// The arguments of every command about a program.
#[derive(Debug, Args)]
pub(crate) struct ProgramArguments {
    /// The file of the program; `-` is standard input. Without --format its extension tells the format.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    reading: ProgramQuery,
    #[command(flatten)]
    query: ToolpathQuery,
}

/// The file of a program that is not read yet.
pub(crate) struct ProgramFile {
    path: PathBuf,
    reading: ProgramQuery,
}

impl ProgramArguments {
    /// The checked tool path, and the file of its program. Fails if the command would write over a file that it reads.
    pub(crate) fn checked(self, written: &[NamedFile<'_>]) -> Result<(CheckedToolpath, ProgramFile), String> {
        let machine_file = Some(Path::new(&self.query.machine)).filter(|path| path.is_file());
        let read = [("the program", Some(&*self.file)), ("the machine", machine_file)];
        refuse_equal_files(&read, written)?;
        let machine = machine(&self.query.machine)?;
        let file = ProgramFile { path: self.file, reading: self.reading };
        let request = ToolpathRequest { machine, ..self.query.into_request() };
        let checked = CheckedToolpath::new(&request, &MachineRegistry::default());
        Ok((checked.map_err(|error| file.message(error))?, file))
    }
}

impl ProgramFile {
    /// Reads the program.
    pub(crate) fn receive(
        &self,
        checked: CheckedToolpath,
    ) -> Result<(ToolpathQuestion, ReceivedProgram), String> {
        let received = self.read()?;
        let question = checked.question(received.id).with_program(&received.program);
        Ok((question.map_err(|error| self.message(error))?, received))
    }

    fn read(&self) -> Result<ReceivedProgram, String> {
        let path = &*self.path;
        let name = path.file_name().and_then(|name| name.to_str()).filter(|_| !is_standard(path));
        let format = Format::detect(self.reading.format.as_deref(), name, None);
        let format = format.map_err(|error| match error {
            FormatError::Undetermined => {
                format!("--format is missing: the name of {} tells none", name_of(path))
            }
            other => format!("{}: {other}", name_of(path)),
        })?;
        let unreadable = |error: io::Error| format!("{}: {error}", name_of(path));
        let faults = |error| self.message(error);
        let mut source = source(path)?;
        let mut receiver = ProgramReceiver::new(format, &self.reading.options(format).map_err(faults)?);
        let mut piece = vec![0; PIECE_BYTES];
        loop {
            let count = source.read(&mut piece).map_err(unreadable)?;
            if count == 0 || receiver.push(&piece[..count]).is_break() {
                return receiver.finish().map_err(faults);
            }
        }
    }

    /// An error as a message: faults of the program with the places in the file, invalid fields with their flags.
    pub(crate) fn message(&self, error: OperationError) -> String {
        match error {
            OperationError::ProgramFaults(refused) => {
                let file = name_of(&self.path);
                let stopped = if refused.complete { "" } else { "\n  the reader stopped here" };
                let faults = refused.errors.iter().map(|fault| format!("\n  {fault}"));
                format!("{file} cannot be read as a program{}{stopped}", faults.collect::<String>())
            }
            OperationError::Fields(_) => flags_of_query(point_into_toolpath_query(error)),
            other => other.to_string(),
        }
    }
}
