//! `POST /workspace/dexterity`: the inclinations that reach the points of a grid in the part frame.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};
use verne_solver::workspace::dexterity::Grid;

use crate::wire::answer::MachineId;
use crate::wire::degrees::{from_degrees, to_degrees};
use crate::wire::fixed_array::{Counts, FixedArray, Triple};
use crate::wire::limit::Unchecked;
use crate::wire::machine_ref::MachineRef;
use crate::wire::result_id::ResultId;
use crate::wire::row_format::RowFormat;
use crate::wire::strict_object::strict_object;
use crate::wire::workspace_summary::BoundsObject;

/// A request for the inclinations that reach each point of the part.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DexterityBody {
    /// The machine: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Distance from P to the tool end, mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end circle and of the platform's six joints over the table (the plane Z = 0 of the
    /// part frame), mm. The default is the limit of the machine; if the machine has none, the service does not check
    /// the table.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end circle, which is perpendicular to the tool's axis, mm. Only `table_clearance` uses it.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// The range of inclinations.
    #[serde(deserialize_with = "strict_object")]
    #[schema(inline)]
    pub phi1: Inclinations,
    /// Azimuth of the tool in the part frame, degrees.
    #[serde(default)]
    #[schema(minimum = -36000, maximum = 36000, default = 0.0)]
    pub phi2: f64,
    /// Distance between neighbouring points of the grid, mm.
    #[serde(default = "default_cell")]
    #[schema(minimum = 1, maximum = 1000, default = 20.0)]
    pub cell: f64,
}

/// Step of a grid without one, mm.
pub(crate) fn default_cell() -> f64 {
    20.0
}

/// A range of phi1 in degrees, at most one turn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Inclinations {
    /// Lower end of the range.
    #[schema(minimum = -36000, maximum = 36000)]
    pub from: f64,
    /// Upper end of the range.
    #[schema(minimum = -36000, maximum = 36000)]
    pub to: f64,
}

/// The request with its default values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = CanonicalDexterityRequest)]
pub(crate) struct CanonicalDexterity {
    /// Distance from P to the tool end, mm.
    pub tool_length: f64,
    /// Table clearance, mm. Only a request with a table check has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub table_clearance: Option<f64>,
    /// Tool radius, mm. Only a request with a table check has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub tool_radius: Option<f64>,
    /// The range of inclinations, degrees.
    pub phi1: Inclinations,
    /// Azimuth of the tool, degrees.
    pub phi2: f64,
    /// Distance between neighbouring grid points, mm.
    pub cell: f64,
}

/// Point set of a dexterity map: `reachable`, the points that at least one inclination of the range reaches;
/// `dexterous`, the points that all inclinations of the range reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[schema(as = PointSet)]
pub(crate) enum SetName {
    /// The points that at least one inclination reaches.
    Reachable,
    /// The points that all inclinations reach.
    Dexterous,
}

impl SetName {
    /// The name.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Reachable => "reachable",
            Self::Dexterous => "dexterous",
        }
    }
}

/// Parameters of GET /workspace/{id}/cells.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct CellsQuery {
    /// Return the points in this format. It overrides Accept.
    #[param(inline, nullable = false)]
    pub format: Option<RowFormat>,
}

/// Summary of a dexterity map.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct DexteritySummary {
    /// BLAKE3 hash of the request, the machine, and the version and the target of the binary.
    #[schema(value_type = String)]
    pub id: ResultId,
    /// The request with its default values.
    pub request: CanonicalDexterity,
    /// The machine.
    pub machine: MachineId,
    /// The grid of points.
    pub grid: GridObject,
    /// Number of grid points that at least one inclination reaches.
    pub reached: usize,
    /// The points that at least one inclination of the range reaches.
    pub reachable: SetObject,
    /// The points that all inclinations of the range reach.
    pub dexterous: SetObject,
    /// Conditions that the service did not check.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Paths of the results.
    pub links: DexterityLinks,
}

/// Figures of a set of points of the part.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = PointSetFigures)]
pub(crate) struct SetObject {
    /// Volume, mm³; null if the workspace folds. The service integrates it and does not use the mesh.
    pub volume: Option<f64>,
    /// The true volume lies within `volume` ± this, mm³.
    pub volume_error: Option<f64>,
    /// Least and greatest coordinates of the mesh, mm; null if the mesh is empty.
    pub bounds: Option<BoundsObject>,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
}

/// Paths of a dexterity map.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct DexterityLinks {
    /// This summary.
    #[serde(rename = "self")]
    pub itself: String,
    /// The mesh of the reachable points.
    pub reachable: String,
    /// The mesh of the dexterous points.
    pub dexterous: String,
    /// The intervals of phi1 at each point of the grid.
    pub cells: String,
}

/// Equally spaced points. Point (i, j, k) is `origin` + step (i, j, k), turned about Z by `turn`; its
/// number is (i · counts[1] + j) · counts[2] + k.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = PointGrid)]
pub(crate) struct GridObject {
    /// Point (0, 0, 0) before the turn, mm.
    #[schema(inline)]
    pub origin: Triple,
    /// Distance between neighbours, mm.
    pub step: f64,
    /// Number of points along each axis; 0 if no point is reachable.
    #[schema(inline)]
    pub counts: Counts,
    /// Rotation about Z, degrees: phi2 in a dexterity map, otherwise 0.
    pub turn: f64,
}

impl GridObject {
    /// The place of a point, by its number, mm.
    #[expect(clippy::cast_precision_loss, reason = "a grid has far fewer points")]
    pub(crate) fn position(&self, point: usize) -> [f64; 3] {
        let [_, y, z] = self.counts.0.map(|count| count.max(1) as usize);
        let steps = [point / (y * z), point / z % y, point % z];
        let [x, y, z] = std::array::from_fn(|axis| self.origin.0[axis] + self.step * steps[axis] as f64);
        let (sin, cos) = from_degrees(self.turn).sin_cos();
        [cos * x - sin * y, sin * x + cos * y, z]
    }
}

impl From<&Grid> for GridObject {
    fn from(grid: &Grid) -> Self {
        Self {
            origin: FixedArray(grid.origin),
            step: grid.step,
            counts: FixedArray(grid.counts),
            turn: to_degrees(grid.turn),
        }
    }
}

/// The intervals of phi1, within the requested range, that keep every limit at each point of the grid. They are exact:
/// the service finds the roots of the limits.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
pub(crate) struct DexterityCells {
    /// Id of the map.
    #[schema(value_type = String)]
    pub id: ResultId,
    /// The points.
    pub grid: GridObject,
    /// Point n's intervals are those from `offsets[n]` up to `offsets[n + 1]`.
    pub offsets: Vec<u32>,
    /// `from` and `to` of each interval, one after the other, degrees.
    pub intervals: Vec<f64>,
}
