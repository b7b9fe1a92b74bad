//! Merges a dexterity map from the results of its subtasks: summary, meshes and grid cells.

use verne_mesh::{Mesh, Swatch};
use verne_solver::workspace::Observer;
use verne_solver::workspace::dexterity::{Dexterity, DexterityRequest, Region, merge};

use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::dexterity_subtasks::{compute_slab, compute_volumes, grid, read_slab, read_volumes};
use crate::operations::observers::equal_section;
use crate::operations::solver_errors::workspace_error;
use crate::operations::subtask::{Subtask, SubtaskRequest};
use crate::wire::degrees::to_degrees;
use crate::wire::dexterity::{
    DexterityCells, DexterityLinks, DexteritySummary, GridObject, SetName, SetObject,
};
use crate::wire::error::OperationError;
use crate::wire::json::write_json;
use crate::wire::limit::Unchecked;
use crate::wire::workspace_summary::{BoundsObject, value_and_error};

/// About the bytes of a summary.
const SUMMARY_BYTES: usize = 2048;

/// About the bytes of a point with its intervals.
const POINT_BYTES: usize = 32;

/// A computed map.
pub(crate) struct DexterityMap {
    /// The summary, as it is sent.
    pub summary: Vec<u8>,
    /// The intervals at the points of the grid, as they are sent.
    pub cells: Vec<u8>,
    /// The surfaces of the reachable and of the dexterous points.
    pub meshes: [Mesh; 2],
}

/// Computes a map, without a store for the results of its subtasks.
pub(crate) fn compute_map(
    question: &DexterityQuestion,
    observer: &dyn Observer,
) -> Result<DexterityMap, OperationError> {
    let subtasks = Subtask::of_map(question);
    let (mut slabs, mut volumes) = (Vec::new(), Vec::new());
    for (i, subtask) in subtasks.iter().enumerate() {
        let section = equal_section(observer, i, subtasks.len());
        match subtask.request {
            SubtaskRequest::Slab { number, count, .. } => {
                slabs.push(compute_slab(question, [number, count], &section)?);
            }
            SubtaskRequest::Volumes(_) => volumes = compute_volumes(question, &section)?,
            _ => return Err(OperationError::Internal),
        }
    }
    merge_map(question, &slabs, &volumes, observer)
}

/// Merges a map from its slabs, in any order, and its volumes. Call it on the compute pool.
pub(crate) fn merge_map(
    question: &DexterityQuestion,
    slabs: &[impl AsRef<[u8]>],
    volumes: &[u8],
    observer: &dyn Observer,
) -> Result<DexterityMap, OperationError> {
    let request = DexterityRequest::from(&question.request);
    let slabs = slabs.iter().map(|slab| read_slab(slab.as_ref())).collect::<Result<_, _>>()?;
    let map = merge(&request, &grid(question, observer)?, slabs, read_volumes(volumes)?, observer)
        .map_err(workspace_error)?;
    let meshes = [mesh(&map.reachable, SetName::Reachable)?, mesh(&map.dexterous, SetName::Dexterous)?];
    let summary = write_json(&summary(question, &map, &meshes), SUMMARY_BYTES)?;
    let bytes = POINT_BYTES * map.offsets.len();
    let cells = write_json(&cells(question, map), bytes)?;
    Ok(DexterityMap { summary, cells, meshes })
}

fn mesh(region: &Region, set: SetName) -> Result<Mesh, OperationError> {
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

fn summary(question: &DexterityQuestion, map: &Dexterity, meshes: &[Mesh; 2]) -> DexteritySummary {
    let path = question.id.path();
    let [reachable, dexterous] = [(&map.reachable, &meshes[0]), (&map.dexterous, &meshes[1])].map(figures);
    DexteritySummary {
        id: question.id,
        request: question.request,
        machine: question.machine.id.clone(),
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
    let [volume, volume_error] = value_and_error(region.volume);
    SetObject {
        volume,
        volume_error,
        bounds: mesh.bounds().map(BoundsObject::from),
        vertices: mesh.positions().len(),
        triangles: mesh.triangles().len(),
    }
}

fn cells(question: &DexterityQuestion, map: Dexterity) -> DexterityCells {
    DexterityCells {
        id: question.id,
        grid: GridObject::from(&map.grid),
        offsets: map.offsets,
        intervals: map.intervals.into_iter().flatten().map(to_degrees).collect(),
    }
}
