//! How many triangles a surface will have, before it is made.

use super::domain::Domain;
use super::observer::{Observer, go_on};
use super::plane::{ATTEMPTS, Plane};
use super::request::{Request, WorkspaceError};
use crate::machine::Machine;

/// Triangles from which a coarse surface tells the number of a fine one.
const ENOUGH: usize = 4_000;
/// By how much the tolerance is lowered until there are enough.
const STEP: f64 = 4.0;
/// First tolerance, as a part of the workspace's greatest possible size.
const COARSE: f64 = 0.02;

/// About how many triangles [`surface`](super::surface) makes; where they are few, the number before short edges are
/// contracted. It takes the time of some thousand triangles.
///
/// The domain is traced at tolerances that are too coarse, ever finer, until there are enough triangles. From there their
/// number grows as 1/tolerance: curved sheets and walls along which columns turn need so many. The chords of a curve
/// grow as the root only, so the estimate is rather too high.
pub fn expected_triangles(
    machine: &Machine,
    request: &Request,
    observer: &dyn Observer,
) -> Result<f64, WorkspaceError> {
    request.check()?;
    let domain = Domain::new(machine, request, None);
    let mut tolerance = request.tolerance.max(COARSE * size(machine, &domain));
    loop {
        go_on(observer)?;
        let plane = Plane::trace(&domain, ATTEMPTS[0], tolerance, usize::MAX, observer)?;
        let found = plane.surface_triangles();
        if tolerance <= request.tolerance || found >= ENOUGH {
            return Ok(count(found) * (tolerance / request.tolerance));
        }
        tolerance = (tolerance / STEP).max(request.tolerance);
    }
}

/// Greatest extent that the workspace may have, mm.
fn size(machine: &Machine, domain: &Domain<'_>) -> f64 {
    let [low, high] = domain.rectangle();
    let strokes = machine.limits().stroke.iter().map(|[low, high]| high - low);
    strokes.fold((high[0] - low[0]).max(high[1] - low[1]), f64::max)
}

#[expect(clippy::cast_precision_loss, reason = "an estimate")]
fn count(n: usize) -> f64 {
    n as f64
}
