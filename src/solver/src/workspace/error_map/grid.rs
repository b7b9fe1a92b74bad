//! The grid of an error map.

use super::request::ErrorMapRequest;
use crate::machine::Machine;
use crate::workspace::dexterity::Grid;
use crate::workspace::observer::Observer;
use crate::workspace::request::{Request, WorkspaceError};
use crate::workspace::surface::surface;

/// The tolerance of the surface over which the grid is placed is at least this part of a cell.
const FINEST_TOLERANCE: f64 = 0.5;

/// Places a grid over the workspace. Its axes are those of the frame of the workspace's kind. Its outermost nodes are
/// outside.
///
/// # Units
///
/// Millimetres.
///
/// # Errors
///
/// - Those of [`surface()`].
/// - [`WorkspaceError::OutOfDomain`]: the cell is below 0.1 mm.
/// - [`WorkspaceError::TooManyNodes`]: the grid would have more nodes than
///   [`MOST_NODES`](crate::workspace::dexterity::MOST_NODES).
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::error_budget::Tolerances;
/// use verne_solver::workspace::error_map::{ErrorMapRequest, error_grid};
/// use verne_solver::workspace::{Kind, Request, Unobserved};
///
/// let (workspace, tolerances) = (Request::new(Kind::Platform, 20.0), Tolerances::new([])?);
/// let request = ErrorMapRequest { workspace, tolerances, cell: 100.0 };
/// let grid = error_grid(&Machine::verne(), &request, &Unobserved)?;
/// assert!(grid.nodes() > 100 && grid.turn == 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn error_grid(
    machine: &Machine,
    request: &ErrorMapRequest,
    observer: &dyn Observer,
) -> Result<Grid, WorkspaceError> {
    request.check()?;
    let (step, turn) = (request.cell, 0.0);
    // A surface within half a cell suffices: at least a whole cell is added on each side.
    let tolerance = request.workspace.tolerance.max(FINEST_TOLERANCE * step);
    let surface = surface(machine, &Request { tolerance, ..request.workspace }, observer)?;
    match surface.bounds() {
        Some(bounds) => Grid::over(bounds, [tolerance; 3], step, turn),
        None => Ok(Grid::empty(step, turn)),
    }
}
