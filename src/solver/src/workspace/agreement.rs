//! Comparison of the integrated volume with the volume that the surface encloses.

use super::measure::{Measure, Volume};
use super::observer::{Observer, StepCounter};
use super::request::WorkspaceError;
use super::surface::Surface;

/// Greatest difference of the volumes beyond the stated error, over the surface's area times its tolerance.
const ALLOWED: f64 = 2.0;

/// Checks that a surface of this tolerance encloses the measured volume.
///
/// The two may differ by the volume's error plus twice the surface's area times the tolerance. A folded workspace has
/// no volume to compare and passes. An empty surface passes too: [`surface`](super::surface()) itself checks that the
/// workspace is empty or thinner than the tolerance.
///
/// # Units
///
/// mm for the tolerance; mm² and mm³ within.
///
/// # Errors
///
/// - [`WorkspaceError::Disagreement`]: the volumes differ by more: one of the two computations is wrong.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): constraints of section IV; the
/// [module's documentation](crate::workspace) derives the rest.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, agree, measure, surface};
///
/// let request = Request::new(Kind::Platform, 20.0);
/// let machine = Machine::verne();
/// let measured = measure(&machine, &request, &Unobserved)?;
/// let boundary = surface(&machine, &request, &Unobserved)?;
/// agree(&measured, &boundary, request.tolerance, &Unobserved)?;
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn agree(
    measure: &Measure,
    surface: &Surface,
    tolerance: f64,
    observer: &dyn Observer,
) -> Result<(), WorkspaceError> {
    let Volume::Value { value, error } = measure.volume else { return Ok(()) };
    if surface.triangles.is_empty() {
        return Ok(());
    }
    let mut steps = StepCounter::new(observer);
    let (mut area, mut enclosed) = (0.0, 0.0);
    for triangle in &surface.triangles {
        steps.step()?;
        area += surface.area_of(triangle);
        enclosed += surface.six_volumes(triangle) / 6.0;
    }
    let empty = value <= error && measure.area <= measure.area_error;
    if empty || (enclosed - value).abs() > error + ALLOWED * tolerance * area {
        return Err(WorkspaceError::Disagreement);
    }
    Ok(())
}
