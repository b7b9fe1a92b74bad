//! The errors at the vertices of a workspace's surface.

use rayon::prelude::*;

use super::errors::{Evaluation, PointErrors};
use super::request::ErrorMapRequest;
use crate::machine::Machine;
use crate::workspace::observer::{Observer, ProgressCounter, Subprogress, check_cancelled};
use crate::workspace::request::WorkspaceError;
use crate::workspace::surface::{Surface, surface_within};

/// Fraction of the work that the surface takes.
const BY_SURFACE: f64 = 0.2;
/// Vertices between two calls of the observer.
const BATCH: usize = 16;

/// A workspace's surface with the errors at its vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceErrors {
    /// The surface.
    pub surface: Surface,
    /// The errors at each vertex; `None` at a parallel singularity, where they have no bound.
    pub errors: Vec<Option<PointErrors>>,
}

/// Computes the surface of the workspace and the errors at its vertices. The surface has at most `most` triangles.
///
/// # Units
///
/// Millimetres and radians.
///
/// # Errors
///
/// Those of [`surface_within`], and [`WorkspaceError::OutOfDomain`] if the cell is below 0.1 mm.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::error_budget::Tolerances;
/// use verne_solver::parameter::Parameter;
/// use verne_solver::workspace::error_map::{ErrorMapRequest, surface_errors};
/// use verne_solver::workspace::{Kind, Request, Unobserved};
///
/// let tolerances = Tolerances::new([(Parameter::L1, 0.01)])?;
/// let request = ErrorMapRequest { workspace: Request::new(Kind::Platform, 20.0), tolerances, cell: 100.0 };
/// let found = surface_errors(&Machine::verne(), &request, usize::MAX, &Unobserved)?;
/// assert_eq!(found.errors.len(), found.surface.positions.len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn surface_errors(
    machine: &Machine,
    request: &ErrorMapRequest,
    most: usize,
    observer: &dyn Observer,
) -> Result<SurfaceErrors, WorkspaceError> {
    request.check()?;
    let meshing = Subprogress::new(observer, 0.0, BY_SURFACE);
    let surface = surface_within(machine, &request.workspace, most, &meshing)?;
    let evaluation = Evaluation::new(machine, request);
    let evaluating = Subprogress::new(observer, BY_SURFACE, 1.0);
    let progress = ProgressCounter::new(&evaluating, surface.positions.len());
    let errors: Vec<Vec<Option<PointErrors>>> = surface
        .positions
        .par_chunks(BATCH)
        .map(|vertices| {
            check_cancelled(observer)?;
            progress.finished(vertices.len());
            Ok(vertices.iter().map(|vertex| evaluation.on_boundary(*vertex)).collect())
        })
        .collect::<Result<_, WorkspaceError>>()?;
    Ok(SurfaceErrors { surface, errors: errors.concat() })
}
