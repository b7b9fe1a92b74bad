//! The boundary surface of a workspace: two sheets over the plane domain and the walls between.

mod assembly;
mod edge_collapse;
mod half_edge;
mod manifold_split;
mod mesh;

pub use mesh::Surface;

use super::cover::{Cover, Purpose};
use super::domain::Domain;
use super::observer::{Observer, StepCounter, check_cancelled};
use super::plane::{LATTICES, PlaneMesh};
use super::request::{Request, WorkspaceError};
use crate::machine::Machine;
use edge_collapse::collapse_short_edges;
use manifold_split::split;

/// Fractions of the work that are done when the patches are welded, when the surface is a manifold, and when its
/// short edges are collapsed.
const WELDED: f64 = 0.93;
const SPLIT: f64 = 0.95;
const COLLAPSED: f64 = 0.98;

/// Computes the boundary surface, within the request's tolerance of the true one, in both directions. The tolerance is
/// checked at sample points (see the [module's documentation](super)), not proved.
///
/// A workspace that is nowhere as thick as the tolerance has no triangles. If the request's map folds (see
/// [`super::Measure::folded`]), the surface is the image of the platform workspace's boundary and passes through
/// itself.
///
/// # Units
///
/// Millimetres, in the frame of the request's kind.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number of the request is not finite, beyond [`MAX_INPUT`](crate::MAX_INPUT)
///   or, for the tolerance, below 0.001 mm.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
/// - [`WorkspaceError::TooFine`]: the surface has more vertices than 32 bits can number.
/// - [`WorkspaceError::Open`]: the surface could not be closed on any of three lattices.
/// - [`WorkspaceError::Disagreement`]: the surface is empty although the cover proves that the domain contains a box
///   as wide as the tolerance.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Figs 7 and 8; Eqs (26) and (27)
/// as maps; the construction is ours.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, surface};
///
/// let request = Request::new(Kind::Platform, 20.0);
/// let surface = surface(&Machine::verne(), &request, &Unobserved)?;
/// assert_eq!(surface.triangles.len(), surface.bindings.len());
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn surface(
    machine: &Machine,
    request: &Request,
    observer: &dyn Observer,
) -> Result<Surface, WorkspaceError> {
    surface_within(machine, request, usize::MAX, observer)
}

/// Computes the same surface as [`surface()`], but stops as soon as it has more triangles than `most`.
///
/// # Units
///
/// Millimetres, in the frame of the request's kind.
///
/// # Errors
///
/// Those of [`surface()`], and:
///
/// - [`WorkspaceError::TooManyTriangles`]: there are more than `most`.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): as for [`surface()`].
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, surface_within};
///
/// let request = Request::new(Kind::Platform, 20.0);
/// let refused = surface_within(&Machine::verne(), &request, 10, &Unobserved);
/// assert_eq!(refused, Err(WorkspaceError::TooManyTriangles { most: 10 }));
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn surface_within(
    machine: &Machine,
    request: &Request,
    most: usize,
    observer: &dyn Observer,
) -> Result<Surface, WorkspaceError> {
    request.check()?;
    check_cancelled(observer)?;
    let domain = Domain::new(machine, request, None);
    let mut surface = closed(&domain, request.tolerance, most, observer)?;
    let mut steps = StepCounter::new(observer);
    let mut volume = 0.0;
    for triangle in &surface.triangles {
        steps.step()?;
        volume += surface.six_volumes(triangle);
    }
    if volume < 0.0 {
        // The map turns the workspace inside out.
        for triangle in &mut surface.triangles {
            steps.step()?;
            triangle.swap(1, 2);
        }
    }
    observer.progress(1.0);
    Ok(surface)
}

/// Makes the surface over the first lattice on which it closes.
fn closed(
    domain: &Domain<'_>,
    tolerance: f64,
    most: usize,
    observer: &dyn Observer,
) -> Result<Surface, WorkspaceError> {
    let mut answer = Err(WorkspaceError::Open);
    let cover = Cover::of(domain, Purpose::Meshing(tolerance), observer)?;
    for squares in LATTICES {
        let plane = PlaneMesh::trace(domain, &cover, squares, tolerance, most, observer)?;
        check_cancelled(observer)?;
        if plane.triangles.is_empty() && cover.has_inside_box(tolerance) {
            return Err(WorkspaceError::Disagreement);
        }
        if plane.is_thin(&cover, tolerance) {
            return Ok(Surface::default());
        }
        observer.progress(WELDED);
        let mut steps = StepCounter::new(observer);
        answer = made_manifold(Surface::over(domain, &plane, &mut steps)?, tolerance, &mut steps);
        if answer != Err(WorkspaceError::Open) {
            break;
        }
    }
    answer
}

fn made_manifold(
    mut surface: Surface,
    tolerance: f64,
    steps: &mut StepCounter<'_>,
) -> Result<Surface, WorkspaceError> {
    split(&mut surface, steps)?;
    steps.observer.progress(SPLIT);
    collapse_short_edges(&mut surface, tolerance, steps)?;
    steps.observer.progress(COLLAPSED);
    // The collapse preserves manifolds. This checks the result at little cost.
    split(&mut surface, steps)?;
    Ok(surface)
}
