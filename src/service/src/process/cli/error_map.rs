//! `verne error-map`: computes an error map without a server.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use serde_json::Value;

use crate::operations::error_map::compute_error_map;
use crate::operations::error_map_question::ErrorMapQuestion;
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::mesh_files::MeshDescription;
use crate::operations::question_text::QuestionKind;
use crate::process::cli::answer::{machine, with_flags};
use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::map_files::MapFiles;
use crate::process::cli::progress::TerminalProgress;
use crate::process::cli::terminal::Terminal;
use crate::process::cli::words::error_budgets;
use crate::wire::dexterity::default_cell;
use crate::wire::error_map::{ErrorMapBody, ErrorName, default_tolerance};
use crate::wire::json_text::JsonText;
use crate::wire::machine_ref::REFERENCE;
use crate::wire::parameter_tolerances::ParameterTolerances;
use crate::wire::parse::parse_body;
use crate::wire::strict_object::StrictObject;
use crate::wire::workspace::KindName;

/// The command.
#[derive(Debug, Args)]
pub(crate) struct ErrorMapCommand {
    /// Name of the machine, or the path of a machine file.
    #[arg(long, default_value = REFERENCE)]
    machine: String,
    /// Point and frame of the positions and of the errors.
    #[arg(long, default_value = "platform")]
    kind: KindName,
    /// Distance from P to the tool end, mm. Kind `platform` ignores it.
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Only kind `part` has it. The default is the limit of the machine; if the machine has none,
    /// verne does not check the table.
    #[arg(long, allow_hyphen_values = true)]
    table_clearance: Option<f64>,
    /// Radius of the tool's end circle, which is perpendicular to the tool's axis, mm. Only --table-clearance uses it.
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    tool_radius: f64,
    /// Inclination of the tool in the part frame, degrees. Only kind `part` uses it.
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    phi1: f64,
    /// Azimuth of the tool in the part frame, degrees. Only kind `part` uses it.
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    phi2: f64,
    /// The tolerances of the parameters as JSON, mm and degrees, such as `{"L1":0.02,"tilt_zero":0.001}`.
    #[arg(long, value_name = "JSON")]
    parameter_tolerances: JsonText<StrictObject<ParameterTolerances>>,
    /// Distance between neighbouring points of the grid, mm.
    #[arg(long, default_value_t = default_cell(), allow_hyphen_values = true)]
    cell: f64,
    /// Greatest distance between the mesh and the true surface of the workspace, in both directions, mm.
    #[arg(long, default_value_t = default_tolerance(), allow_hyphen_values = true)]
    tolerance: f64,
    /// Write the mesh of the workspace, in bands of --error, to this file: .glb, .stl, .ply or .json.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// The error that the colours of the mesh of --output show.
    #[arg(long, value_enum, default_value = "tip_worst", requires = "output")]
    error: ErrorName,
    /// Write the errors at each point of the grid inside the workspace to this file: .json, or a row for each point as
    /// .csv, .ndjson or .arrow.
    #[arg(long, value_name = "FILE")]
    cells: Option<PathBuf>,
    #[command(flatten)]
    format: AnswerFormat,
}

impl ErrorMapCommand {
    /// Writes the files, and the summary to `out`.
    pub(crate) fn run(self, out: &mut impl Write, terminal: Option<Terminal>) -> Result<(), String> {
        let files = MapFiles::new(&self.machine, self.output.as_deref(), self.cells.as_deref())?;
        let question =
            ErrorMapQuestion::new(&self.body()?, &MachineRegistry::default()).map_err(with_flags)?;
        let progress = TerminalProgress::new();
        let map = compute_error_map(&question, &progress).map_err(with_flags)?;
        drop(progress);
        let description = MeshDescription::of_errors(&question, self.error);
        files.write_mesh(&description, &map.meshes[self.error as usize])?;
        files.write_cells(QuestionKind::ErrorMap, &map.cells)?;
        let summary: Value = parse_body(&map.summary).map_err(with_flags)?;
        self.format.write(&summary, error_budgets::map, out, terminal)
    }

    fn body(&self) -> Result<ErrorMapBody, String> {
        Ok(ErrorMapBody {
            machine: machine(&self.machine)?,
            kind: self.kind,
            tool_length: self.tool_length,
            table_clearance: self.table_clearance,
            tool_radius: self.tool_radius,
            phi1: self.phi1,
            phi2: self.phi2,
            parameter_tolerances: self.parameter_tolerances.0.0,
            cell: self.cell,
            tolerance: self.tolerance,
        })
    }
}
