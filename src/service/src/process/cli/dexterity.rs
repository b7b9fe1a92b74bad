//! `verne dexterity`: computes a dexterity map without a server.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use serde_json::Value;

use crate::operations::dexterity_map::compute_map;
use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::mesh_files::MeshDescription;
use crate::operations::question_text::QuestionKind;
use crate::process::cli::answer::{machine, with_flags};
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::map_files::MapFiles;
use crate::process::cli::progress::TerminalProgress;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::workspaces;
use crate::wire::dexterity::{DexterityBody, Inclinations, SetName};
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
        let files = MapFiles::new(&self.machine, self.output.as_deref(), self.cells.as_deref())?;
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
        let [reachable, dexterous] = &map.meshes;
        let mesh = if self.set == SetName::Reachable { reachable } else { dexterous };
        files.write_mesh(&MeshDescription::of_set(&question, self.set), mesh)?;
        files.write_cells(QuestionKind::Dexterity, &map.cells)?;
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
