//! Volume by integration against the volume that the surface encloses.

use super::measure::{Measure, Volume};
use super::observer::{Observer, Pace};
use super::request::WorkspaceError;
use super::surface::Surface;

/// Most that a surface's volume may be off, over its area times its tolerance.
const ALLOWED: f64 = 2.0;

/// Checks that a surface of this tolerance encloses the measured volume: an error if they disagree by
/// more than the volume's error and the tolerance on both sides of the surface allow.
///
/// A folded workspace has no volume to compare. An empty surface stands for any volume: that the
/// workspace is empty or thinner than the tolerance is seen to where the surface is made.
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
    let mut pace = Pace::new(observer);
    let (mut area, mut enclosed) = (0.0, 0.0);
    for triangle in &surface.triangles {
        pace.step()?;
        area += surface.area_of(triangle);
        enclosed += surface.six_volumes(triangle) / 6.0;
    }
    let empty = value <= error && measure.area <= measure.area_error;
    if empty || (enclosed - value).abs() > error + ALLOWED * tolerance * area {
        return Err(WorkspaceError::Disagreement);
    }
    Ok(())
}
