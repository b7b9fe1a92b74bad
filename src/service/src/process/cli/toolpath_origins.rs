//! `verne toolpath-origins`: computes the region of origins of a program without a server.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde_json::Value;

use crate::operations::mesh_files::{MeshDescription, write_mesh};
use crate::operations::origins::{compute_origins, slice_of_origins};
use crate::operations::origins_question::CheckedOrigins;
use crate::process::cli::answer::to_json;
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::program_arguments::ProgramArguments;
use crate::process::cli::progress::TerminalProgress;
use crate::process::cli::terminal::Terminal;
use crate::wire::format::{MeshFormat, SliceFormat};
use crate::wire::origins::OriginsFields;

/// The command.
#[derive(Debug, Args)]
pub(crate) struct OriginsCommand {
    #[command(flatten)]
    program: ProgramArguments,
    /// Step of the grid from which the surface is made, mm.
    #[arg(long, default_value_t = 20.0, allow_hyphen_values = true)]
    cell: f64,
    /// Write the mesh of the region to this file: .glb, .stl, .ply or .json. With --slice, write the cut: .svg, .dxf or
    /// .json.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Cut the region at this z of the origins, mm.
    #[arg(long, value_name = "Z", allow_hyphen_values = true, requires = "output")]
    slice: Option<f64>,
    #[command(flatten)]
    format: AnswerFormat,
}

/// What the file of --output has.
enum Output {
    Mesh(MeshFormat),
    Slice(f64, SliceFormat),
}

impl OriginsCommand {
    /// Writes the file, and the summary as JSON to `out`, with line breaks on a terminal.
    pub(crate) fn run(self, out: &mut impl Write, terminal: Option<Terminal>) -> Result<(), String> {
        let output = self.output.as_deref();
        // Before the computation: the extension may be unknown.
        let written = match (output, self.slice) {
            (Some(path), Some(z)) => Some((path, Output::Slice(z, format(path, ".svg, .dxf or .json")?))),
            (Some(path), None) => Some((path, Output::Mesh(format(path, ".glb, .stl, .ply or .json")?))),
            (None, _) => None,
        };
        let (checked, file) = self.program.checked(&[("--output", output)])?;
        let faults = |error| file.message(error);
        let fields = OriginsFields { cell: Some(self.cell) };
        let fields = CheckedOrigins::new(&fields, &checked).map_err(faults)?;
        let (toolpath, received) = file.receive(checked)?;
        let question = fields.question(toolpath);
        let progress = TerminalProgress::new();
        let region = compute_origins(&question, &received.program, &progress);
        drop(progress);
        let region = region.map_err(faults)?;
        if let Some((path, output)) = written {
            let bytes = match output {
                Output::Mesh(format) => {
                    write_mesh(&MeshDescription::of_origins(&question), &region.mesh, format)
                }
                Output::Slice(z, format) => {
                    slice_of_origins(question.id, question.cell, &region.mesh, z, format)
                }
            };
            let bytes = bytes.map_err(faults)?;
            std::fs::write(path, bytes).map_err(|error| format!("{}: {error}", path.display()))?;
        }
        let summary: Value = serde_json::from_slice(&region.summary).map_err(|error| error.to_string())?;
        writeln!(out, "{}", to_json(&summary, self.format.has_line_breaks(terminal))?)
            .map_err(|error| format!("cannot write the answer: {error}"))
    }
}

/// The format that the extension of a file names.
fn format<F: ValueEnum>(path: &Path, known: &str) -> Result<F, String> {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    F::from_str(extension, true).map_err(|_| format!("--output {} must end in {known}", path.display()))
}
