//! `/workspace/dexterity`: inclinations at the points of a grid, and the sets that they make.

use verne_mesh::{Mesh, Swatch};
use verne_solver::workspace::dexterity::{Dexterity, DexterityRequest, Region, merge};
use verne_solver::workspace::{Observer, Volume};

use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::dexterity_subtasks::{grid, read_slab, read_volumes};
use crate::operations::workspace_question::workspace_error;
use crate::wire::degrees::to_degrees;
use crate::wire::dexterity::{
    DexterityCells, DexterityLinks, DexteritySummary, GridObject, SetName, SetObject,
};
use crate::wire::error::{FieldError, OperationError};
use crate::wire::fixed_array::Exactly;
use crate::wire::json::write_json;
use crate::wire::limit::Unchecked;
use crate::wire::workspace_summary::BoundsObject;

/// About the bytes of a summary.
const SUMMARY_BYTES: usize = 2048;

/// About the bytes of a point with its intervals.
const POINT_BYTES: usize = 32;

/// Most points of a grid: their intervals are a file of some 50 MB then.
pub(crate) const POINTS: usize = 2_000_000;

/// A computed map.
pub(crate) struct DexterityMap {
    /// The figures, as they are sent.
    pub summary: Vec<u8>,
    /// The intervals, as they are sent.
    pub cells: Vec<u8>,
    /// The surfaces of what is reachable and of what is dexterous.
    pub meshes: [Mesh; 2],
}

/// A map from its slabs, in any order, and its volumes.
pub(crate) fn merge_dexterity(
    question: &DexterityQuestion,
    slabs: &[impl AsRef<[u8]>],
    volumes: &[u8],
    observer: &dyn Observer,
) -> Result<DexterityMap, OperationError> {
    let request = DexterityRequest::from(&question.request);
    let slabs = slabs.iter().map(|slab| read_slab(slab.as_ref())).collect::<Result<_, _>>()?;
    let map = merge(&request, &grid(question, observer)?, slabs, read_volumes(volumes)?, observer)
        .map_err(workspace_error)?;
    let meshes = [meshed(&map.reachable, SetName::Reachable)?, meshed(&map.dexterous, SetName::Dexterous)?];
    let summary = write_json(&summarised(question, &map, &meshes), SUMMARY_BYTES)?;
    let bytes = POINT_BYTES * map.offsets.len();
    let cells = write_json(&listed(question, map), bytes)?;
    Ok(DexterityMap { summary, cells, meshes })
}

/// Refuses a grid of so many points.
pub(crate) fn too_many_points(points: impl std::fmt::Display) -> OperationError {
    OperationError::Fields(vec![FieldError::new(
        "/cell",
        format!("makes a grid of {points} points; the limit is {POINTS}"),
    )])
}

fn meshed(region: &Region, set: SetName) -> Result<Mesh, OperationError> {
    let rgb = match set {
        SetName::Reachable => [0, 90, 158],
        SetName::Dexterous => [0, 158, 115],
    };
    let palette = vec![Swatch { name: set.name().to_owned(), rgb }];
    let palette = if region.triangles.is_empty() { Vec::new() } else { palette };
    let tags = vec![0; region.triangles.len()];
    Mesh::new(region.positions.clone(), region.triangles.clone(), tags, palette)
        .map_err(|_| OperationError::Internal)
}

fn summarised(question: &DexterityQuestion, map: &Dexterity, meshes: &[Mesh; 2]) -> DexteritySummary {
    let path = question.id.path();
    let [reachable, dexterous] = [(&map.reachable, &meshes[0]), (&map.dexterous, &meshes[1])].map(figures);
    DexteritySummary {
        id: question.id.to_string(),
        request: question.request,
        machine: question.published.id.clone(),
        grid: GridObject::from(&map.grid),
        reached: map.offsets.windows(2).filter(|ends| ends[0] < ends[1]).count(),
        reachable,
        dexterous,
        not_checked: Unchecked::beside(question.request.table_clearance.is_some()),
        links: DexterityLinks {
            reachable: format!("{path}/mesh?set=reachable"),
            dexterous: format!("{path}/mesh?set=dexterous"),
            cells: format!("{path}/cells"),
            itself: path,
        },
    }
}

fn figures((region, mesh): (&Region, &Mesh)) -> SetObject {
    let (volume, volume_error) = match region.volume {
        Volume::Value { value, error } => (Some(value), Some(error)),
        Volume::Folded => (None, None),
    };
    let bounds =
        mesh.bounds().map(|bounds| BoundsObject { min: Exactly(bounds.min), max: Exactly(bounds.max) });
    SetObject {
        volume,
        volume_error,
        bounds,
        vertices: mesh.positions().len(),
        triangles: mesh.triangles().len(),
    }
}

fn listed(question: &DexterityQuestion, map: Dexterity) -> DexterityCells {
    DexterityCells {
        id: question.id.to_string(),
        grid: GridObject::from(&map.grid),
        offsets: map.offsets,
        intervals: map.intervals.into_iter().flatten().map(to_degrees).collect(),
    }
}
