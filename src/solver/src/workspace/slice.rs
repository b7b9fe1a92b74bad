//! The cut of a workspace at a height of its own frame.

mod contour;
mod polygon;

use super::cover::{Cover, Purpose};
use super::domain::Domain;
use super::observer::{Observer, check_cancelled};
use super::plane::{LATTICES, PlaneMesh};
use super::request::{Request, WorkspaceError};
use crate::machine::Machine;
use crate::request_range::MAX_INPUT;
use contour::contours_at;
use polygon::{polygons, ring_area};

pub use contour::Contour;
pub use polygon::Polygon;
pub(crate) use polygon::nested;

/// The cut of a workspace at one height: (x, y) in the frame of the request's kind, mm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slice {
    /// The components of the cut. Empty if the plane misses the workspace.
    pub polygons: Vec<Polygon>,
    /// Lines of constant alpha within the cut.
    pub contours: Vec<Contour>,
}

/// Cuts the workspace at z = `height` of the frame of the request's kind. The polygons are within the request's
/// tolerance of the true cut; this is checked at sample points, not proved. Lines show where alpha has one of the
/// values `alphas`.
///
/// If the request's map folds, polygons may overlap.
///
/// # Units
///
/// `height` and all points are millimetres; `alphas` are radians.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: `height` or a number of the request is not finite, beyond [`MAX_INPUT`] or, for
///   the tolerance, below 0.001 mm.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
/// - [`WorkspaceError::TooFine`]: the cut has more vertices than 32 bits can number.
/// - [`WorkspaceError::Open`]: the outlines could not be closed on any of three lattices.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eq (16) for the lines of constant
/// alpha; the cut is ours.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, slice};
///
/// let request = Request::new(Kind::Platform, 20.0);
/// let cut = slice(&Machine::verne(), &request, 1200.0, &[0.1], &Unobserved)?;
/// assert_eq!(cut.polygons.len(), 1);
/// assert!(!cut.contours.is_empty());
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn slice(
    machine: &Machine,
    request: &Request,
    height: f64,
    alphas: &[f64],
    observer: &dyn Observer,
) -> Result<Slice, WorkspaceError> {
    request.check()?;
    if height.is_nan() || height.abs() > MAX_INPUT {
        return Err(WorkspaceError::OutOfDomain { field: "height" });
    }
    check_cancelled(observer)?;
    let domain = Domain::new(machine, request, Some(height));
    let polygons = polygons(&closed(&domain, request.tolerance, observer)?);
    let mut contours = Vec::new();
    if !polygons.is_empty() {
        for &alpha in alphas {
            check_cancelled(observer)?;
            contours.extend(contours_at(&domain, alpha, request.tolerance));
        }
    }
    observer.progress(1.0);
    Ok(Slice { polygons, contours })
}

/// The domain on the first lattice on which its sides close.
fn closed(domain: &Domain<'_>, tolerance: f64, observer: &dyn Observer) -> Result<PlaneMesh, WorkspaceError> {
    let cover = Cover::of(domain, Purpose::Meshing(tolerance), observer)?;
    for squares in LATTICES {
        let plane = PlaneMesh::trace(domain, &cover, squares, tolerance, usize::MAX, observer)?;
        if plane.closes() {
            return Ok(plane);
        }
    }
    Err(WorkspaceError::Open)
}

impl Slice {
    /// The area of the polygons less that of their holes.
    ///
    /// # Units
    ///
    /// mm².
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, slice};
    ///
    /// let request = Request::new(Kind::Platform, 20.0);
    /// let cut = slice(&Machine::verne(), &request, 1200.0, &[], &Unobserved)?;
    /// assert!(cut.area() > 1e5 && cut.area() < 657_682.0, "the domain's area bounds it");
    /// # Ok::<(), WorkspaceError>(())
    /// ```
    pub fn area(&self) -> f64 {
        let rings = self.polygons.iter().flat_map(|polygon| polygon.holes.iter().chain([&polygon.outer]));
        rings.map(|ring| ring_area(ring)).sum()
    }
}
