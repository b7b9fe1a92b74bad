//! `POST /workspace` with lists: a family of workspaces, and its table.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::answer::MachineId;
use super::limit::Unchecked;
use super::machine_ref::MachineRef;
use super::span::Span;
use super::workspace::{CanonicalRequest, KindName, WorkspaceRequest, default_tolerance};
use super::workspace_summary::BoundsObject;

/// Where can the machine go? With lists, a family: every combination of their values.
#[derive(Clone, Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = WorkspaceRequest)]
pub(crate) struct WorkspaceBody {
    /// The machine: a published name, or the whole object.
    #[serde(default)]
    pub machine: MachineRef,
    /// Whose positions the workspace is made of.
    #[serde(default)]
    pub kind: KindName,
    /// Distance from P to the tool's tip, mm, from 0 to 1e7; without effect on `platform`.
    #[serde(default)]
    pub tool_length: Span,
    /// Least height of the tool's end and of the platform's six joints over the table, the plane Z = 0 of the part
    /// frame, mm; only kind `part` has it. Left out: the machine's own limit; without one the table is not checked.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, nullable = false)]
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, a circle perpendicular to its axis, mm; counts for `table_clearance` alone.
    #[serde(default)]
    #[schema(minimum = 0, maximum = 1e7, default = 0.0)]
    pub tool_radius: f64,
    /// Inclination of the tool in the table frame, degrees; only `part` depends on it.
    #[serde(default)]
    pub phi1: Span,
    /// Azimuth of the tool in the table frame, degrees; only `part` depends on it.
    #[serde(default)]
    pub phi2: Span,
    /// Greatest distance between the mesh and the true surface, both ways, mm. At least a millionth of the machine's
    /// longest dimension.
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

/// A family's request with its lists written out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, ToSchema)]
pub(crate) struct FamilyRequest {
    /// Whose positions.
    pub kind: KindName,
    /// mm.
    pub tool_length: Vec<f64>,
    /// mm; for `part`, where the table is checked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub table_clearance: Option<f64>,
    /// mm; for `part`, where the table is checked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub tool_radius: Option<f64>,
    /// Degrees.
    pub phi1: Vec<f64>,
    /// Degrees.
    pub phi2: Vec<f64>,
    /// mm.
    pub tolerance: f64,
}

/// A family of workspaces in figures.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct FamilySummary {
    /// BLAKE3 of the lists and of its members' ids.
    pub id: String,
    /// The request with its lists written out.
    pub request: FamilyRequest,
    /// The machine.
    pub machine: MachineId,
    /// The workspaces, phi2 running fastest, then phi1; each is kept by itself.
    pub members: Vec<FamilyMember>,
    /// What was not checked.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Where the table is.
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
    /// Its id: `/workspace/{id}` has its summary, mesh and slices.
    pub id: String,
    /// Its request.
    pub request: CanonicalRequest,
    /// Its figures; nothing where it could not be computed.
    #[serde(flatten)]
    #[schema(inline)]
    pub figures: Option<Figures>,
    /// Why it could not be computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false)]
    pub failure: Option<String>,
}

/// The figures of a workspace, as its summary has them.
#[derive(Clone, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = WorkspaceFigures)]
pub(crate) struct Figures {
    /// mm³; null where the workspace folds.
    pub volume: Option<f64>,
    /// The true volume lies within `volume` ± this, mm³.
    pub volume_error: Option<f64>,
    /// mm².
    pub area: f64,
    /// The mesh's least and greatest coordinates, mm; null where it is empty.
    pub bounds: Option<BoundsObject>,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Whether some positions are reached from two platform positions.
    pub folded: bool,
}
