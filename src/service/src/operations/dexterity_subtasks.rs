//! Computes the subtasks of a dexterity map, and reads their results.

use serde::{Deserialize, Serialize};
use verne_solver::workspace::dexterity::{Crossing, DexterityRequest, Grid, Slab, slab, volumes};
use verne_solver::workspace::{Observer, Volume};

use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::solver_errors::{MAX_GRID_POINTS, too_many_grid_points, workspace_error};
use crate::wire::error::OperationError;

/// A slab as it is stored.
#[derive(Serialize, Deserialize)]
struct StoredSlab {
    layers: [u32; 2],
    counts: Vec<u8>,
    intervals: Vec<[f64; 2]>,
    crossings: [Vec<(u64, [f64; 3])>; 2],
}

/// The grid of a map. A grid with too many points is an error.
pub(crate) fn grid(question: &DexterityQuestion, observer: &dyn Observer) -> Result<Grid, OperationError> {
    let request = DexterityRequest::from(&question.request);
    let grid = Grid::new(&question.machine, &request, observer).map_err(workspace_error)?;
    if grid.nodes() > MAX_GRID_POINTS { Err(too_many_grid_points(grid.nodes())) } else { Ok(grid) }
}

/// Computes slab `number` of `count` slabs of a map.
pub(crate) fn compute_slab(
    question: &DexterityQuestion,
    [number, count]: [u32; 2],
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let (grid, request) = (grid(question, observer)?, DexterityRequest::from(&question.request));
    let layers = grid.layers_of_slab(number, count);
    let slab = slab(&question.machine, &request, &grid, layers, observer).map_err(workspace_error)?;
    let Slab { layers, counts, intervals, crossings } = slab;
    let crossings =
        crossings.map(|found| found.into_iter().map(|crossing| (crossing.edge, crossing.at)).collect());
    let stored = StoredSlab { layers: [layers.start, layers.end], counts, intervals, crossings };
    postcard::to_stdvec(&stored).map_err(|_| OperationError::Internal)
}

/// Reads the result of [`compute_slab`].
pub(crate) fn read_slab(bytes: &[u8]) -> Result<Slab, OperationError> {
    let StoredSlab { layers: [start, end], counts, intervals, crossings } =
        postcard::from_bytes(bytes).map_err(|_| OperationError::Internal)?;
    let crossings =
        crossings.map(|stored| stored.into_iter().map(|(edge, at)| Crossing { edge, at }).collect());
    Ok(Slab { layers: start..end, counts, intervals, crossings })
}

/// Computes the volumes of a map's two sets.
pub(crate) fn compute_volumes(
    question: &DexterityQuestion,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let request = DexterityRequest::from(&question.request);
    let volumes = volumes(&question.machine, &request, observer).map_err(workspace_error)?;
    let stored = volumes.map(|volume| match volume {
        Volume::Value { value, error } => Some([value, error]),
        Volume::Folded => None,
    });
    postcard::to_stdvec(&stored).map_err(|_| OperationError::Internal)
}

/// Reads the result of [`compute_volumes`].
pub(crate) fn read_volumes(bytes: &[u8]) -> Result<[Volume; 2], OperationError> {
    let stored: [Option<[f64; 2]>; 2] = postcard::from_bytes(bytes).map_err(|_| OperationError::Internal)?;
    Ok(stored.map(|volume| volume.map_or(Volume::Folded, |[value, error]| Volume::Value { value, error })))
}
