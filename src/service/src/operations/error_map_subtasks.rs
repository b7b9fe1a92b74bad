//! Computes the subtasks of an error map, and reads their results.

use serde::{Deserialize, Serialize};
use verne_solver::Point;
use verne_solver::workspace::Observer;
use verne_solver::workspace::dexterity::Grid;
use verne_solver::workspace::error_map::{
    NodeErrors, PointErrors, SurfaceErrors, error_grid, error_slab, surface_errors,
};

use crate::operations::error_map_question::ErrorMapQuestion;
use crate::operations::solver_errors::{MAX_GRID_POINTS, too_many_grid_points, workspace_error};
use crate::wire::error::OperationError;

/// The errors at a node as they are stored.
type StoredNode = (u32, [f64; 4]);

/// The surface with the errors at its vertices.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct ErrorSurface {
    /// The vertices, mm.
    pub positions: Vec<Point>,
    /// The vertices of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// The errors at each vertex, mm and rad; `None` where they have no bound.
    errors: Vec<Option<[f64; 4]>>,
}

impl ErrorSurface {
    /// The errors at each vertex.
    pub(crate) fn errors(&self) -> impl Iterator<Item = Option<PointErrors>> {
        self.errors.iter().map(|errors| errors.map(PointErrors))
    }
}

/// The grid of a map. A grid with too many points is an error.
pub(crate) fn grid(question: &ErrorMapQuestion, observer: &dyn Observer) -> Result<Grid, OperationError> {
    let grid =
        error_grid(&question.machine, &question.solver_request()?, observer).map_err(workspace_error)?;
    if grid.nodes() > MAX_GRID_POINTS { Err(too_many_grid_points(grid.nodes())) } else { Ok(grid) }
}

/// Computes slab `number` of `count` slabs of a map.
pub(crate) fn compute_slab(
    question: &ErrorMapQuestion,
    [number, count]: [u32; 2],
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let (grid, request) = (grid(question, observer)?, question.solver_request()?);
    let layers = grid.layers_of_slab(number, count);
    let nodes = error_slab(&question.machine, &request, &grid, layers, observer).map_err(workspace_error)?;
    let stored: Vec<StoredNode> = nodes.into_iter().map(|found| (found.node, found.errors.0)).collect();
    postcard::to_stdvec(&stored).map_err(|_| OperationError::Internal)
}

/// Reads the result of [`compute_slab`].
pub(crate) fn read_slab(bytes: &[u8]) -> Result<Vec<NodeErrors>, OperationError> {
    let stored: Vec<StoredNode> = postcard::from_bytes(bytes).map_err(|_| OperationError::Internal)?;
    Ok(stored.into_iter().map(|(node, errors)| NodeErrors { node, errors: PointErrors(errors) }).collect())
}

/// Computes the surface of a map's workspace with the errors at its vertices.
pub(crate) fn compute_surface(
    question: &ErrorMapQuestion,
    max_triangles: usize,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let request = question.solver_request()?;
    let found = surface_errors(&question.machine, &request, max_triangles, observer);
    let SurfaceErrors { surface, errors } = found.map_err(workspace_error)?;
    let errors = errors.into_iter().map(|errors| errors.map(|errors| errors.0)).collect();
    let stored = ErrorSurface { positions: surface.positions, triangles: surface.triangles, errors };
    postcard::to_stdvec(&stored).map_err(|_| OperationError::Internal)
}

/// Reads the result of [`compute_surface`].
pub(crate) fn read_surface(bytes: &[u8]) -> Result<ErrorSurface, OperationError> {
    postcard::from_bytes(bytes).map_err(|_| OperationError::Internal)
}
