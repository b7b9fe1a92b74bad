//! `POST /workspace/dexterity`: with which inclinations the points of the part are reached.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};
use verne_solver::workspace::dexterity::Grid;

use super::answer::MachineId;
use super::degrees::to_degrees;
use super::format::MeshFormat;
use super::limit::Unchecked;
use super::machine_ref::MachineRef;
use super::numbers::{Counts, Exactly, Triple};
use super::object::object;
use super::workspace_summary::BoundsObject;

/// With which inclinations is each point of the part reached, and where with some or with all of them?
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DexterityBody {
    /// The machine: a published name, or the whole object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Distance from P to the tool's tip, mm.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_length: f64,
    /// Least height of the tool's end and of the platform's six joints over the table, the plane Z = 0 of the part
    /// frame, mm. Left out: the machine's own limit; without one the table is not checked.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, a circle perpendicular to its axis, mm; counts for `table_clearance` alone.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// The inclinations that matter.
    #[serde(deserialize_with = "object")]
    #[schema(inline)]
    pub phi1: Inclinations,
    /// Azimuth of the tool in the table frame, degrees.
    #[serde(default)]
    #[schema(minimum = -36000, maximum = 36000, default = 0.0)]
    pub phi2: f64,
    /// Distance of neighbouring points of the grid, mm.
    #[serde(default = "default_cell")]
    #[schema(minimum = 1, maximum = 1000, default = 20.0)]
    pub cell: f64,
}

fn default_cell() -> f64 {
    20.0
}

/// A range of phi1, degrees, at most a turn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Inclinations {
    /// The least.
    #[schema(minimum = -36000, maximum = 36000)]
    pub from: f64,
    /// The greatest.
    #[schema(minimum = -36000, maximum = 36000)]
    pub to: f64,
}

/// A request with its defaults filled in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = CanonicalDexterityRequest)]
pub(crate) struct CanonicalDexterity {
    /// mm.
    pub tool_length: f64,
    /// mm; where the table is checked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub table_clearance: Option<f64>,
    /// mm; where the table is checked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub tool_radius: Option<f64>,
    /// The inclinations that matter, degrees.
    pub phi1: Inclinations,
    /// Degrees.
    pub phi2: f64,
    /// mm.
    pub cell: f64,
}

/// A set of points: `reachable`, those reached with some inclination of the range; `dexterous`, those reached with all
/// of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ToSchema, ValueEnum)]
#[serde(rename_all = "snake_case")]
#[schema(as = PointSet)]
pub(crate) enum SetName {
    /// Reached with some inclination.
    Reachable,
    /// Reached with all of them.
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

/// Parameters of GET /workspace/{id}/mesh.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(crate) struct KeptMeshQuery {
    /// The mesh in this format, whatever Accept says.
    #[param(inline, nullable = false)]
    pub format: Option<MeshFormat>,
    /// Which set's mesh of a dexterity map; without it that of what is reachable.
    #[param(inline, nullable = false)]
    pub set: Option<SetName>,
}

/// A dexterity map in figures.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct DexteritySummary {
    /// BLAKE3 of the request, the machine and the solver's version.
    pub id: String,
    /// The request with its defaults.
    pub request: CanonicalDexterity,
    /// The machine.
    pub machine: MachineId,
    /// The grid of points.
    pub grid: GridObject,
    /// Points of the grid that are reached with some inclination.
    pub reached: usize,
    /// What is reached with some inclination of the range.
    pub reachable: SetObject,
    /// What is reached with all of them.
    pub dexterous: SetObject,
    /// What was not checked.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Where the results are.
    pub links: DexterityLinks,
}

/// A set of points of the part in figures.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = PointSetFigures)]
pub(crate) struct SetObject {
    /// Volume, mm³, by integration and not from the mesh; null where the workspace folds.
    pub volume: Option<f64>,
    /// The true volume lies within `volume` ± this, mm³.
    pub volume_error: Option<f64>,
    /// The mesh's least and greatest coordinates, mm; null where it is empty.
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
    /// The mesh of what is reachable.
    pub reachable: String,
    /// The mesh of what is dexterous.
    pub dexterous: String,
    /// The intervals of phi1 at each point of the grid.
    pub cells: String,
}

/// Equally spaced points of the part frame. Point (i, j, k) is `origin` + step (i, j, k), turned about Z by `turn`; its
/// number is (i · counts[1] + j) · counts[2] + k.
#[derive(Clone, Debug, Serialize, ToSchema)]
#[schema(as = PointGrid)]
pub(crate) struct GridObject {
    /// Point (0, 0, 0) before the turn, mm.
    #[schema(inline)]
    pub origin: Triple,
    /// Distance of neighbours, mm.
    pub step: f64,
    /// Points along each axis; 0 where nothing is reachable.
    #[schema(inline)]
    pub counts: Counts,
    /// Degrees about Z; phi2.
    pub turn: f64,
}

impl From<&Grid> for GridObject {
    fn from(grid: &Grid) -> Self {
        Self {
            origin: Exactly(grid.origin),
            step: grid.step,
            counts: Exactly(grid.counts),
            turn: to_degrees(grid.turn),
        }
    }
}

/// The intervals of phi1 within the asked range, within every limit, at each point of the grid: exact, by root-finding
/// on the limits.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct DexterityCells {
    /// The map.
    pub id: String,
    /// The points.
    pub grid: GridObject,
    /// Point n's intervals are those from `offsets[n]` up to `offsets[n + 1]`.
    pub offsets: Vec<u32>,
    /// `from`, `to` of each interval in turn, degrees.
    pub intervals: Vec<f64>,
}
