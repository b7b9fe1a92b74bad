//! `verne toolpath-window`: finds the window of a parameter without a server.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde_json::Value;

use crate::operations::machine_registry::MachineRegistry;
use crate::operations::toolpath_question::CheckedToolpath;
use crate::operations::window::compute_window;
use crate::operations::window_question::CheckedWindow;
use crate::process::cli::answer::{exit_status, machine};
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::files::{name_of, refuse_equal_files};
use crate::process::cli::progress::TerminalProgress;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::toolpath::{message, receive};
use crate::process::cli::words::windows;
use crate::wire::program_query::ProgramQuery;
use crate::wire::toolpath::ToolpathRequest;
use crate::wire::toolpath_query::ToolpathQuery;
use crate::wire::window::{WindowFields, WindowParameter};

/// The command.
#[derive(Debug, Args)]
pub(crate) struct WindowCommand {
    /// The file of the program; `-` is standard input. Without --format its extension tells the format.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The parameter. Its own value takes no part.
    #[arg(long)]
    parameter: WindowParameter,
    /// The least value, mm or degrees.
    #[arg(long, allow_hyphen_values = true)]
    from: f64,
    /// The greatest value, mm or degrees.
    #[arg(long, allow_hyphen_values = true)]
    to: f64,
    #[command(flatten)]
    reading: ProgramQuery,
    #[command(flatten)]
    query: ToolpathQuery,
    #[command(flatten)]
    format: AnswerFormat,
}

impl WindowCommand {
    /// Writes the answer to `out`, which may be a terminal. The exit status is 3 if the machine cannot run the program
    /// with any value that was found.
    pub(crate) fn run(self, out: &mut impl Write, terminal: Option<Terminal>) -> Result<ExitCode, String> {
        let machine_file = Some(Path::new(&self.query.machine)).filter(|path| path.is_file());
        refuse_equal_files(&[("the program", Some(&*self.file)), ("the machine", machine_file)], &[])?;
        let file = name_of(&self.file);
        let faults = |error| message(&file, error);
        let machine = machine(&self.query.machine)?;
        let request = ToolpathRequest { machine, ..self.query.into_request() };
        let mut checked = CheckedToolpath::new(&request, &MachineRegistry::default()).map_err(faults)?;
        let fields =
            WindowFields { parameter: Some(self.parameter), from: Some(self.from), to: Some(self.to) };
        let fields = CheckedWindow::new(&fields, &mut checked).map_err(faults)?;
        let received = receive(&self.file, &self.reading, faults)?;
        let toolpath = checked.question(received.id).with_program(&received.program).map_err(faults)?;
        let progress = TerminalProgress::new();
        let answer = compute_window(&fields.question(toolpath), &received.program, &progress);
        drop(progress);
        let answer: Value =
            serde_json::from_slice(&answer.map_err(faults)?).map_err(|error| error.to_string())?;
        self.format.write(&answer, windows::window, out, terminal)?;
        let intervals = answer["intervals"].as_array();
        Ok(exit_status(intervals.is_some_and(|intervals| !intervals.is_empty())))
    }
}
