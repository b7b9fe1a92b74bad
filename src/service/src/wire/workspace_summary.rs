//! The answer of `/workspace`.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;
use verne_mesh::Bounds;
use verne_solver::workspace::Volume;

use crate::wire::answer::MachineId;
use crate::wire::fixed_array::{FixedArray, Triple};
use crate::wire::limit::Unchecked;
use crate::wire::result_id::ResultId;
use crate::wire::workspace::{CanonicalWorkspace, FrameName, KindName};

/// Summary of a workspace.
#[derive(Clone, Debug, Serialize, ToSchema)]
pub(crate) struct WorkspaceSummary {
    /// BLAKE3 hash of the request, the machine, and the version and the target of the binary. Equal requests have equal
    /// ids.
    #[schema(value_type = String)]
    pub id: ResultId,
    /// Point and frame of the positions.
    pub kind: KindName,
    /// The frame of bounds, mesh and slices.
    pub frame: FrameName,
    /// The request with its default values, without the fields that have no effect on this kind.
    pub request: CanonicalWorkspace,
    /// The machine.
    pub machine: MachineId,
    /// Volume, mm³; null if the workspace folds. The service integrates it and does not use the mesh.
    pub volume: Option<f64>,
    /// The true volume lies within `volume` ± this, mm³.
    pub volume_error: Option<f64>,
    /// Area of the plane domain of the platform positions (x, y) that the workspace stands on, mm².
    pub area: f64,
    /// The true area lies within `area` ± this, mm².
    pub area_error: f64,
    /// Least and greatest coordinates of the mesh, within the tolerance of the true ones; null if the mesh has no
    /// triangles.
    pub bounds: Option<BoundsObject>,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Whether two platform positions reach the same position of the workspace. The service detects this if the map's
    /// Jacobian determinant has both signs, or if one of 2,000 points spread evenly over the workspace has two feasible
    /// inverse solutions. It may miss a doubly covered part of less than about 0.15 % of the workspace. If a second
    /// working solution exists that is not feasible, the service tests 20,000 points, and `volume_error` includes the
    /// part that it may have missed.
    pub folded: bool,
    /// Conditions that the service did not check.
    #[schema(value_type = Vec<Unchecked>)]
    pub not_checked: &'static [Unchecked],
    /// The reason why there is no volume, or why there are no triangles although the area is not zero; otherwise
    /// missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(nullable = false, value_type = String)]
    pub explanation: Option<&'static str>,
    /// Paths of the results.
    pub links: Links,
}

/// Box parallel to the axes, mm.
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

impl From<Bounds> for BoundsObject {
    fn from(bounds: Bounds) -> Self {
        Self { min: FixedArray(bounds.min), max: FixedArray(bounds.max) }
    }
}

/// The fields `volume` and `volume_error`; null if the workspace folds.
pub(crate) fn value_and_error(volume: Volume) -> [Option<f64>; 2] {
    match volume {
        Volume::Value { value, error } => [Some(value), Some(error)],
        Volume::Folded => [None, None],
    }
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
