//! `POST /workspace` with lists: a family of workspaces, and its table.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::wire::answer::MachineId;
use crate::wire::limit::Unchecked;
use crate::wire::machine_ref::MachineRef;
use crate::wire::sweep::Span;
use crate::wire::workspace::{CanonicalRequest, KindName, WorkspaceRequest, default_tolerance};
use crate::wire::workspace_summary::BoundsObject;

/// A request for a workspace. With lists it is a request for a family: one workspace for each combination of the
/// values.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = WorkspaceRequest)]
pub(crate) struct WorkspaceBody {
    /// The machine: the name of a published machine, or a machine object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Point and frame of the positions.
    #[serde(default)]
    pub kind: KindName,
    /// Distance from P to the tool end, mm, from 0 to 1e7. Kind `platform` ignores it.
    #[serde(default)]
    pub tool_length: Span,
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
    pub phi1: Span,
    /// Azimuth of the tool in the part frame, degrees. Only kind `part` uses it.
    #[serde(default)]
    pub phi2: Span,
    /// Greatest distance between the mesh and the true surface, in both directions, mm. It must be at least a millionth
    /// of the machine's longest dimension.
    #[serde(default = "default_tolerance")]
    #[schema(minimum = 0.01, maximum = 1000, default = 1.0)]
    pub tolerance: f64,
}

impl WorkspaceBody {
    /// The one workspace that is asked for; nothing where it is a family.
    pub(crate) fn single(&self) -> Option<WorkspaceRequest> {
        let (&Span::One(tool_length), &Span::One(phi1), &Span::One(phi2)) =
            (&self.tool_length, &self.phi1, &self.phi2)
        else {
            return None;
        };
        let Self { machine, kind, table_clearance, tool_radius, tolerance, .. } = self.clone();
        Some(WorkspaceRequest {
            machine,
            kind,
            tool_length,
            table_clearance,
            tool_radius,
            phi1,
            phi2,
            tolerance,
        })
    }
}

/// The request of a family with its lists in full.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub(crate) struct FamilyRequest {
    /// Point and frame of the positions.
    pub kind: KindName,
    /// Distance from P to the tool end, mm.
    pub tool_length: Vec<f64>,
    /// Table clearance, mm. Only kind `part` with a table check has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub table_clearance: Option<f64>,
    /// Tool radius, mm. Only kind `part` with a table check has it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub tool_radius: Option<f64>,
    /// Inclination of the tool, degrees.
    pub phi1: Vec<f64>,
    /// Azimuth of the tool, degrees.
    pub phi2: Vec<f64>,
    /// Tolerance, mm.
    pub tolerance: f64,
}

/// Summary of a family of workspaces.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct FamilySummary {
    /// BLAKE3 hash of the lists and of the members' ids.
    pub id: String,
    /// The request with its lists in full.
    pub request: FamilyRequest,
    /// The machine.
    pub machine: MachineId,
    /// The workspaces in order; phi2 varies fastest, then phi1. Each workspace has a result of its own.
    pub members: Vec<FamilyMember>,
    /// Conditions that the service did not check.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Path of the table.
    pub links: FamilyLinks,
}

/// Paths of a family.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct FamilyLinks {
    /// This table.
    #[serde(rename = "self")]
    pub itself: String,
}

/// One workspace of a family.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct FamilyMember {
    /// Id of the workspace: `/workspace/{id}` has its summary, mesh and slices.
    pub id: String,
    /// Request of the workspace.
    pub request: CanonicalRequest,
    /// Figures of the workspace. They are missing if the computation failed.
    #[serde(flatten)]
    #[schema(inline)]
    pub figures: Option<Figures>,
    /// The reason why the computation failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub failure: Option<String>,
}

/// Figures from the summary of a workspace.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = WorkspaceFigures)]
pub(crate) struct Figures {
    /// Volume, mm³; null if the workspace folds.
    pub volume: Option<f64>,
    /// The true volume lies within `volume` ± this, mm³.
    pub volume_error: Option<f64>,
    /// Area, mm².
    pub area: f64,
    /// Least and greatest coordinates of the mesh, mm; null if the mesh is empty.
    pub bounds: Option<BoundsObject>,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Whether two platform positions reach the same position of the workspace.
    pub folded: bool,
}
