//! `verne workspace`: computes volumes, meshes and slices without a server.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use serde_json::Value;

use crate::operations::machine_registry::MachineRegistry;
use crate::operations::mesh_files::{MeshDescription, write_mesh};
use crate::operations::slice::answer_slice;
use crate::operations::workspace::compute_workspace;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::process::cli::answer::{machine, with_flags};
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::progress::TerminalProgress;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::workspaces;
use crate::wire::alphas::Alphas;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::format::{MeshFormat, SliceFormat};
use crate::wire::parse::parse_body;
use crate::wire::workspace::WorkspaceRequest;
use crate::wire::workspace_query::WorkspaceQuery;

/// The command.
#[derive(Debug, Args)]
pub(crate) struct WorkspaceCommand {
    #[command(flatten)]
    query: WorkspaceQuery,
    /// Write the mesh to this file: .glb, .stl, .ply or .json; with --slice: .json, .svg or .dxf. Without it, verne
    /// prints the answer of the HTTP service.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Height of the slice in the frame of the workspace, mm.
    #[arg(long, value_name = "Z", allow_hyphen_values = true)]
    slice: Option<f64>,
    /// Lines of constant alpha in the slice: true for a line every five degrees, or angles in degrees, separated by
    /// commas.
    #[arg(long, requires = "slice", default_value = "false", value_parser = str::parse::<Alphas>)]
    #[arg(allow_hyphen_values = true)]
    alpha: Alphas,
    #[command(flatten)]
    format: AnswerFormat,
}

/// The format of the file.
enum OutputFormat {
    Mesh(MeshFormat),
    Slice(SliceFormat),
}

impl WorkspaceCommand {
    /// Writes the file, or the answer to `out`.
    pub(crate) fn run(self, out: &mut impl Write, terminal: Option<Terminal>) -> Result<(), String> {
        // Before the computation: the extension may be unknown.
        let format = self.output.as_deref().map(|path| self.file_format(path)).transpose()?;
        let machine = machine(&self.query.machine)?;
        let request = WorkspaceRequest { machine, ..self.query.into_request() };
        let progress = TerminalProgress::new();
        let question = WorkspaceQuestion::new(&request, &MachineRegistry::default()).map_err(with_flags)?;
        let workspace = compute_workspace(&question, usize::MAX, &progress).map_err(with_flags)?;
        let slice = |format| {
            let z = self.slice.unwrap_or_default();
            answer_slice(&question, workspace.inclination, z, &self.alpha, format, &progress)
                .map_err(|error| with_flags(with_slice_flag(error)))
        };
        let bytes = match &format {
            Some(OutputFormat::Mesh(format)) => {
                write_mesh(&MeshDescription::of_workspace(&question), &workspace.mesh, *format)
                    .map_err(with_flags)?
            }
            Some(OutputFormat::Slice(format)) => slice(*format)?,
            None if self.slice.is_some() => slice(SliceFormat::Json)?,
            None => workspace.summary,
        };
        drop(progress);
        if let Some(path) = self.output {
            return std::fs::write(&path, bytes).map_err(|error| format!("{}: {error}", path.display()));
        }
        let answer: Value = parse_body(&bytes).map_err(with_flags)?;
        self.format.write(&answer, workspaces::workspace, out, terminal)
    }

    /// The format that the extension of a file names.
    fn file_format(&self, path: &Path) -> Result<OutputFormat, String> {
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        let (format, known) = if self.slice.is_some() {
            (SliceFormat::from_str(extension, true).map(OutputFormat::Slice), ".json, .svg or .dxf (a slice)")
        } else {
            (
                MeshFormat::from_str(extension, true).map(OutputFormat::Mesh),
                ".glb, .stl, .ply or .json (a mesh)",
            )
        };
        format.map_err(|_| format!("--output {} must end in {known}", path.display()))
    }
}

/// Names the height of a slice as the flag does.
fn with_slice_flag(error: OperationError) -> OperationError {
    let OperationError::Fields(faults) = error else { return error };
    let renamed = faults.into_iter().map(|fault| match fault.pointer.as_str() {
        "/z" => FieldError::new("/slice", fault.detail),
        _ => fault,
    });
    OperationError::Fields(renamed.collect())
}
