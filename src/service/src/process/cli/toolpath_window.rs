//! `verne toolpath-window`: finds the window of a parameter without a server.

use std::io::Write;
use std::process::ExitCode;

use clap::Args;
use serde_json::Value;

use crate::operations::window::compute_window;
use crate::operations::window_question::CheckedWindow;
use crate::process::cli::answer::exit_status;
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::program_arguments::ProgramArguments;
use crate::process::cli::progress::TerminalProgress;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::windows;
use crate::wire::window::{WindowFields, WindowParameter};

/// The command.
#[derive(Debug, Args)]
pub(crate) struct WindowCommand {
    #[command(flatten)]
    program: ProgramArguments,
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
    format: AnswerFormat,
}

impl WindowCommand {
    /// Writes the answer to `out`, which may be a terminal. The exit status is 3 if the machine cannot run the program
    /// with any value that was found.
    pub(crate) fn run(self, out: &mut impl Write, terminal: Option<Terminal>) -> Result<ExitCode, String> {
        let (mut checked, file) = self.program.checked(&[])?;
        let faults = |error| file.message(error);
        let fields =
            WindowFields { parameter: Some(self.parameter), from: Some(self.from), to: Some(self.to) };
        let fields = CheckedWindow::new(&fields, &mut checked).map_err(faults)?;
        let (toolpath, received) = file.receive(checked)?;
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
