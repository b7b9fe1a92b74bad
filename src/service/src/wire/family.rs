//! The table of a family of workspaces.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::wire::answer::MachineId;
use crate::wire::limit::Unchecked;
use crate::wire::result_id::ResultId;
use crate::wire::workspace::{CanonicalWorkspace, KindName};
use crate::wire::workspace_summary::BoundsObject;

/// The request of a family with its lists in full.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = FamilyRequest)]
pub(crate) struct CanonicalFamily {
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

impl CanonicalFamily {
    /// The request of every combination; phi2 varies fastest, then phi1. They have no fields without effect.
    pub(crate) fn members(&self) -> impl Iterator<Item = CanonicalWorkspace> {
        let (tool, part) = (self.kind != KindName::Platform, self.kind == KindName::Part);
        self.tool_length.iter().flat_map(move |&tool_length| {
            self.phi1.iter().flat_map(move |&phi1| {
                self.phi2.iter().map(move |&phi2| CanonicalWorkspace {
                    kind: self.kind,
                    tool_length: tool.then_some(tool_length),
                    table_clearance: self.table_clearance,
                    tool_radius: self.tool_radius,
                    phi1: part.then_some(phi1),
                    phi2: part.then_some(phi2),
                    tolerance: self.tolerance,
                })
            })
        })
    }
}

/// Summary of a family of workspaces.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct FamilySummary {
    /// BLAKE3 hash of the lists and of the members' ids.
    #[schema(value_type = String)]
    pub id: ResultId,
    /// The request with its lists in full.
    pub request: CanonicalFamily,
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
    #[schema(value_type = String)]
    pub id: ResultId,
    /// Request of the workspace.
    pub request: CanonicalWorkspace,
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
