//! `verne toolpath-placement`: finds the set-up with the greatest reserve without a server.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use serde_json::Value;

use crate::operations::machine_registry::MachineRegistry;
use crate::operations::placement::compute_placement;
use crate::operations::placement_question::CheckedPlacement;
use crate::operations::toolpath_question::CheckedToolpath;
use crate::operations::toolpath_report::is_feasible;
use crate::process::cli::answer::{exit_status, machine, to_json};
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::files::{name_of, refuse_equal_files};
use crate::process::cli::progress::TerminalProgress;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::toolpath::{message, receive};
use crate::wire::json_text::JsonText;
use crate::wire::placement::{FreeParameters, PlacementFields, Reserve};
use crate::wire::program_query::ProgramQuery;
use crate::wire::strict_object::StrictObject;
use crate::wire::toolpath::ToolpathRequest;
use crate::wire::toolpath_query::ToolpathQuery;

/// The command.
#[derive(Debug, Args)]
pub(crate) struct PlacementCommand {
    /// The file of the program; `-` is standard input. Without --format its extension tells the format.
    #[arg(value_name = "FILE")]
    file: PathBuf,
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
    reading: ProgramQuery,
    #[command(flatten)]
    query: ToolpathQuery,
    #[command(flatten)]
    format: AnswerFormat,
}

impl PlacementCommand {
    /// Writes the answer as JSON, with line breaks on a terminal. The exit status is 3 if the machine cannot run the
    /// program in any set-up that was found.
    pub(crate) fn run(self, out: &mut impl Write, terminal: Option<Terminal>) -> Result<ExitCode, String> {
        let machine_file = Some(Path::new(&self.query.machine)).filter(|path| path.is_file());
        refuse_equal_files(&[("the program", Some(&*self.file)), ("the machine", machine_file)], &[])?;
        let file = name_of(&self.file);
        let faults = |error| message(&file, error);
        let machine = machine(&self.query.machine)?;
        let request = ToolpathRequest { machine, ..self.query.into_request() };
        let checked = CheckedToolpath::new(&request, &MachineRegistry::default()).map_err(faults)?;
        let fields = PlacementFields { free: Some(self.free.0.0), reserve: Some(self.reserve.0.0) };
        let fields = CheckedPlacement::new(&fields, &checked).map_err(faults)?;
        let received = receive(&self.file, &self.reading, faults)?;
        let toolpath = checked.question(received.id).with_program(&received.program).map_err(faults)?;
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
