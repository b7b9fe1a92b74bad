//! `POST /workspace/error-budget`: the errors of the tool over a workspace.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use verne_solver::workspace::error_map::ErrorKind;

use crate::wire::answer::MachineId;
use crate::wire::dexterity::{GridObject, default_cell};
use crate::wire::fixed_array::Triple;
use crate::wire::limit::Unchecked;
use crate::wire::machine_ref::MachineRef;
use crate::wire::parameter_tolerances::ParameterTolerances;
use crate::wire::result_id::ResultId;
use crate::wire::strict_object::strict_object;
use crate::wire::workspace::{CanonicalWorkspace, FrameName, KindName};
use crate::wire::workspace_summary::BoundsObject;

/// A request for the errors of the tool over a workspace.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = ErrorMapRequest)]
pub(crate) struct ErrorMapBody {
    /// The machine: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Point and frame of the positions and of the errors. With kind `part` the errors of the table count, too; with
    /// kind `platform` they are those of P.
    #[serde(default)]
    pub kind: KindName,
    /// Distance from P to the tool end, mm. Kind `platform` ignores it.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. Only kind `part` has it. The default is the limit of the machine; if the machine has none, the
    /// service does not check the table.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, which is perpendicular to the tool's axis, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Inclination of the tool in the part frame, degrees. Only kind `part` uses it.
    #[serde(default)]
    #[schema(minimum = -36000, maximum = 36000, default = 0.0)]
    pub phi1: f64,
    /// Azimuth of the tool in the part frame, degrees. Only kind `part` uses it.
    #[serde(default)]
    #[schema(minimum = -36000, maximum = 36000, default = 0.0)]
    pub phi2: f64,
    /// The tolerances of the parameters.
    #[serde(deserialize_with = "strict_object")]
    pub parameter_tolerances: ParameterTolerances,
    /// Distance between neighbouring points of the grid, mm.
    #[serde(default = "default_cell")]
    #[schema(minimum = 1, maximum = 1000, default = 20.0)]
    pub cell: f64,
    /// Greatest distance between the mesh and the true surface of the workspace, in both directions, mm.
    #[serde(default = "default_tolerance")]
    #[schema(minimum = 0.01, maximum = 1000, default = 5.0)]
    pub tolerance: f64,
}

/// Tolerance of a request that has none, mm: every vertex of the mesh has an error budget.
pub(crate) fn default_tolerance() -> f64 {
    5.0
}

/// The request with its default values, without the fields that have no effect.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = CanonicalErrorMapRequest)]
pub(crate) struct CanonicalErrorMap {
    /// The workspace.
    pub workspace: CanonicalWorkspace,
    /// The tolerances above 0.
    pub parameter_tolerances: ParameterTolerances,
    /// Distance between neighbouring grid points, mm.
    pub cell: f64,
}

/// An error of an error map: `tip_rms` and `tip_worst`, root mean square and greatest displacement of the tool end, mm;
/// `axis_rms` and `axis_worst`, the same of the angle of the tool's axis, degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[value(rename_all = "snake_case")]
#[schema(as = ErrorName)]
pub(crate) enum ErrorName {
    /// Root mean square displacement of the tool end.
    TipRms,
    /// Greatest displacement of the tool end.
    TipWorst,
    /// Root mean square angle of the tool's axis.
    AxisRms,
    /// Greatest angle of the tool's axis.
    AxisWorst,
}

impl ErrorName {
    /// All of them, in the order of [`ErrorKind::ALL`].
    pub(crate) const ALL: [Self; 4] = [Self::TipRms, Self::TipWorst, Self::AxisRms, Self::AxisWorst];

    /// The name.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::TipRms => "tip_rms",
            Self::TipWorst => "tip_worst",
            Self::AxisRms => "axis_rms",
            Self::AxisWorst => "axis_worst",
        }
    }

    /// The solver's name.
    pub(crate) const fn kind(self) -> ErrorKind {
        match self {
            Self::TipRms => ErrorKind::TipRms,
            Self::TipWorst => ErrorKind::TipWorst,
            Self::AxisRms => ErrorKind::AxisRms,
            Self::AxisWorst => ErrorKind::AxisWorst,
        }
    }

    /// Whether it is an angle.
    pub(crate) const fn is_angle(self) -> bool {
        matches!(self, Self::AxisRms | Self::AxisWorst)
    }
}

/// Summary of an error map.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct ErrorMapSummary {
    /// BLAKE3 hash of the request, the machine, and the version and the target of the binary.
    #[schema(value_type = String)]
    pub id: ResultId,
    /// The request with its default values.
    pub request: CanonicalErrorMap,
    /// The machine.
    pub machine: MachineId,
    /// The frame of grid, mesh and errors.
    pub frame: FrameName,
    /// The grid of points.
    pub grid: GridObject,
    /// Number of grid points inside the workspace.
    pub inside: usize,
    /// The errors over the workspace; null if it has no points.
    pub errors: Option<ErrorRanges>,
    /// Least and greatest coordinates of the mesh, mm; null if the mesh has no triangles.
    pub bounds: Option<BoundsObject>,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Vertices of the mesh at which errors have no bound: a parallel singularity. The mesh shows them as its largest
    /// errors.
    pub unbounded: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Conditions that the service did not check.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Paths of the results.
    pub links: ErrorMapLinks,
}

/// The range of each error over a workspace.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct ErrorRanges {
    /// Root mean square displacement of the tool end, mm.
    pub tip_rms: ErrorRange,
    /// Greatest displacement of the tool end, mm.
    pub tip_worst: ErrorRange,
    /// Root mean square angle of the tool's axis, degrees.
    pub axis_rms: ErrorRange,
    /// Greatest angle of the tool's axis, degrees.
    pub axis_worst: ErrorRange,
}

/// The range of an error over a workspace.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct ErrorRange {
    /// The least error at the examined points: those of the grid and the vertices of the mesh.
    pub least: f64,
    /// The largest error that was found: from the examined point with the greatest one the service goes upwards, as far
    /// as the workspace allows. The true maximum is at least this; a greater one elsewhere between the examined points
    /// is not excluded.
    pub largest: f64,
    /// Where it is, mm.
    #[schema(inline)]
    pub at: Triple,
}

/// Paths of an error map.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct ErrorMapLinks {
    /// This summary.
    #[serde(rename = "self")]
    pub itself: String,
    /// The mesh of the workspace, coloured by `tip_worst`.
    pub mesh: String,
    /// The errors at each point of the grid.
    pub cells: String,
}

/// The errors at the grid points inside the workspace, as columns.
#[derive(Clone, Debug, Default, Serialize, Deserialize, ToSchema)]
pub(crate) struct ErrorColumns {
    /// Root mean square displacement of the tool end, mm.
    pub tip_rms: Vec<f64>,
    /// Greatest displacement of the tool end, mm.
    pub tip_worst: Vec<f64>,
    /// Root mean square angle of the tool's axis, degrees.
    pub axis_rms: Vec<f64>,
    /// Greatest angle of the tool's axis, degrees.
    pub axis_worst: Vec<f64>,
}

/// The errors at the points of an error map.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
pub(crate) struct ErrorCells {
    /// Id of the map.
    #[schema(value_type = String)]
    pub id: ResultId,
    /// The points.
    pub grid: GridObject,
    /// Numbers of the points inside the workspace, ascending. The other fields have their order.
    pub points: Vec<u32>,
    /// The errors.
    #[serde(flatten)]
    pub errors: ErrorColumns,
}
