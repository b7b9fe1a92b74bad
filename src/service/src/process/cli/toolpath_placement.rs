//! `verne toolpath-placement`: finds the set-up with the greatest reserve without a server.

use std::io::Write;
use std::process::ExitCode;

use clap::Args;
use serde_json::Value;

use crate::operations::placement::compute_placement;
use crate::operations::placement_question::CheckedPlacement;
use crate::operations::toolpath_report::is_feasible;
use crate::process::cli::answer::{exit_status, to_json};
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::program_arguments::ProgramArguments;
use crate::process::cli::progress::TerminalProgress;
use crate::process::cli::terminal::Terminal;
use crate::wire::json_text::JsonText;
use crate::wire::placement::{FreeParameters, PlacementFields, Reserve};
use crate::wire::strict_object::StrictObject;

/// The command.
#[derive(Debug, Args)]
pub(crate) struct PlacementCommand {
    #[command(flatten)]
    program: ProgramArguments,
    /// The free parameters, each with its least and its greatest value, as JSON such as
    /// `{"setup.x":[-200,200],"tool_length":[80,150]}`: any of setup.x, setup.y, setup.z (mm), setup.c (degrees), and
    /// `tool_length` (mm).
    #[arg(long, value_name = "JSON")]
    free: JsonText<StrictObject<FreeParameters>>,
    /// The distance to keep from limits as JSON by constraint, such as `{"stroke":20,"slider_joint":2}`: mm, degrees,
    /// or none.
    #[arg(long, value_name = "JSON")]
    reserve: JsonText<StrictObject<Reserve>>,
    #[command(flatten)]
    format: AnswerFormat,
}

impl PlacementCommand {
    /// Writes the answer as JSON, with line breaks on a terminal. The exit status is 3 if the machine cannot run the
    /// program in any set-up that was found.
    pub(crate) fn run(self, out: &mut impl Write, terminal: Option<Terminal>) -> Result<ExitCode, String> {
        let (checked, file) = self.program.checked(&[])?;
        let faults = |error| file.message(error);
        let fields = PlacementFields { free: Some(self.free.0.0), reserve: Some(self.reserve.0.0) };
        let fields = CheckedPlacement::new(&fields, &checked).map_err(faults)?;
        let (toolpath, received) = file.receive(checked)?;
        let progress = TerminalProgress::new();
        let answer = compute_placement(&fields.question(toolpath), &received.program, &progress);
        drop(progress);
        let answer = answer.map_err(faults)?;
        let verdict = is_feasible(&answer);
        let answer: Value = serde_json::from_slice(&answer).map_err(|error| error.to_string())?;
        writeln!(out, "{}", to_json(&answer, self.format.has_line_breaks(terminal))?)
            .map_err(|error| format!("cannot write the answer: {error}"))?;
        Ok(exit_status(verdict))
    }
}
