//! The answer of `/workspace`.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::answer::MachineId;
use super::limit::Unchecked;
use super::numbers::Triple;
use super::workspace::{CanonicalRequest, FrameName, KindName};
use crate::result_id::ResultId;

/// A workspace in figures.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct WorkspaceSummary {
    /// BLAKE3 of the request, the machine and the solver's version: equal questions have equal ids.
    pub id: String,
    /// Whose positions.
    pub kind: KindName,
    /// The frame of bounds, mesh and slices.
    pub frame: FrameName,
    /// The request with its defaults, without the fields that have no effect on this kind.
    pub request: CanonicalRequest,
    /// The machine.
    pub machine: MachineId,
    /// Volume, mm³, by integration and not from the mesh; null where the workspace folds.
    pub volume: Option<f64>,
    /// The true volume lies within `volume` ± this, mm³.
    pub volume_error: Option<f64>,
    /// Area of the plane domain of the platform positions (x, y) that the workspace stands on, mm².
    pub area: f64,
    /// The true area lies within `area` ± this, mm².
    pub area_error: f64,
    /// The mesh's least and greatest coordinates, within the tolerance of the true ones; null where it has no triangles.
    pub bounds: Option<BoundsObject>,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Whether some positions are reached from two platform positions. Found where the map's Jacobian determinant has
    /// both signs, and where one of 2,000 points spread evenly over the workspace has two feasible inverse solutions:
    /// a doubly covered part of less than about 0.15 % of the workspace may be missed. Where a second working
    /// solution exists that is not feasible, 20,000 points are looked at, and `volume_error` includes what may have
    /// been missed.
    pub folded: bool,
    /// What was not checked.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// Why there is no volume, or why there are no triangles though the area is not zero; else absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, value_type = String)]
    pub explanation: Option<&'static str>,
    /// Where the results are.
    pub links: Links,
}

/// A box along the axes, mm.
#[derive(Clone, Copy, Debug, Serialize, Deserialize, ToSchema)]
#[schema(as = Bounds)]
pub(crate) struct BoundsObject {
    /// Least x, y, z.
    #[schema(inline)]
    pub min: Triple,
    /// Greatest x, y, z.
    #[schema(inline)]
    pub max: Triple,
}

/// Paths of the results.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct Links {
    /// This summary.
    #[serde(rename = "self")]
    pub itself: String,
    /// The mesh.
    pub mesh: String,
}

impl Links {
    /// The paths of a workspace.
    pub(crate) fn of(id: ResultId) -> Self {
        Self { itself: format!("/workspace/{id}"), mesh: format!("/workspace/{id}/mesh") }
    }
}
