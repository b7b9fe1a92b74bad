//! `verne dexterity`: computes a dexterity map without a server.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::Value;

use crate::operations::dexterity_map::{DexterityMap, compute_map};
use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::mesh_files::{MeshDescription, write_mesh};
use crate::operations::question_text::QuestionKind;
use crate::process::cli::answer::{machine, with_flags};
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::files::refuse_equal_files;
use crate::process::cli::map_files::{format_of, write_cells};
use crate::process::cli::progress::TerminalProgress;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::workspaces;
use crate::wire::dexterity::{DexterityBody, Inclinations, SetName};
use crate::wire::format::MeshFormat;
use crate::wire::machine_ref::REFERENCE;
use crate::wire::parse::parse_body;

/// The command.
#[derive(Debug, Args)]
pub(crate) struct DexterityCommand {
    /// Name of the machine, or the path of a machine file.
    #[arg(long, default_value = REFERENCE)]
    machine: String,
    /// The range of inclinations FROM,TO, degrees, at most one turn.
    #[arg(long, value_name = "FROM,TO", allow_hyphen_values = true, value_parser = inclinations)]
    phi1: Inclinations,
    /// Azimuth of the tool in the part frame, degrees.
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    phi2: f64,
    /// Distance from P to the tool end, mm.
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. The default is the limit of the machine; if the machine has none, verne does not check the
    /// table.
    #[arg(long, allow_hyphen_values = true)]
    table_clearance: Option<f64>,
    /// Radius of the tool's end circle, which is perpendicular to the tool's axis, mm. Only --table-clearance uses it.
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    tool_radius: f64,
    /// Distance between neighbouring points of the grid, mm.
    #[arg(long, default_value_t = 20.0, allow_hyphen_values = true)]
    cell: f64,
    /// Write the mesh of --set to this file: .glb, .stl, .ply or .json.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The points that the mesh of --output encloses.
    #[arg(long, value_enum, default_value = "reachable", requires = "output")]
    set: SetName,
    /// Write the intervals of phi1 at each point of the grid to this file: .json, or a row for each interval as .csv,
    /// .ndjson or .arrow.
    #[arg(long, value_name = "FILE")]
    cells: Option<PathBuf>,
    #[command(flatten)]
    format: AnswerFormat,
}

impl DexterityCommand {
    /// Writes the files, and the summary to `out`.
    pub(crate) fn run(self, out: &mut impl Write, terminal: Option<Terminal>) -> Result<(), String> {
        let (output, cells) = (self.output.as_deref(), self.cells.as_deref());
        let machine_file = Some(Path::new(&self.machine)).filter(|path| path.is_file());
        refuse_equal_files(&[("the machine", machine_file)], &[("--output", output), ("--cells", cells)])?;
        // Before the computation: the extension may be unknown.
        let mesh_format =
            output.map(|path| format_of("--output", path, ".glb, .stl, .ply or .json")).transpose()?;
        let cells_format =
            cells.map(|path| format_of("--cells", path, ".json, .csv, .ndjson or .arrow")).transpose()?;
        let body = DexterityBody {
            machine: machine(&self.machine)?,
            tool_length: self.tool_length,
            table_clearance: self.table_clearance,
            tool_radius: self.tool_radius,
            phi1: self.phi1,
            phi2: self.phi2,
            cell: self.cell,
        };
        let question = DexterityQuestion::new(&body, &MachineRegistry::default()).map_err(with_flags)?;
        let progress = TerminalProgress::new();
        let map = compute_map(&question, &progress).map_err(with_flags)?;
        drop(progress);
        if let (Some(path), Some(format)) = (output, mesh_format) {
            write_set(&question, &map, self.set, format, path)?;
        }
        if let (Some(path), Some(format)) = (cells, cells_format) {
            write_cells(QuestionKind::Dexterity, &map.cells, format, path)?;
        }
        let summary: Value = parse_body(&map.summary).map_err(with_flags)?;
        self.format.write(&summary, workspaces::dexterity, out, terminal)
    }
}

/// `FROM,TO`.
fn inclinations(text: &str) -> Result<Inclinations, String> {
    let numbers = text.split_once(',').map(|(from, to)| (from.trim().parse(), to.trim().parse()));
    match numbers {
        Some((Ok(from), Ok(to))) => Ok(Inclinations { from, to }),
        _ => Err("expected two numbers separated by a comma".to_owned()),
    }
}

fn write_set(
    question: &DexterityQuestion,
    map: &DexterityMap,
    set: SetName,
    format: MeshFormat,
    path: &Path,
) -> Result<(), String> {
    let [reachable, dexterous] = &map.meshes;
    let mesh = if set == SetName::Reachable { reachable } else { dexterous };
    let file = write_mesh(&MeshDescription::of_set(question, set), mesh, format).map_err(with_flags)?;
    std::fs::write(path, file).map_err(|error| format!("{}: {error}", path.display()))
}
