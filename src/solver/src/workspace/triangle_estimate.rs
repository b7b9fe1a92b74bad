//! An estimate of the number of triangles of a surface.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::cover::{Cover, Purpose};
use super::domain::Domain;
use super::observer::{Observer, check_cancelled, count};
use super::plane::{LATTICES, PlaneMesh};
use super::request::{Request, WorkspaceError};
use crate::machine::Machine;

/// Number of triangles from which a coarse surface predicts the number of a fine one.
const ENOUGH: usize = 4_000;
/// Factor by which the tolerance is lowered until there are enough triangles.
const STEP: f64 = 4.0;
/// Calls of the observer after which a trace is abandoned. A trace that ends has a few for each triangle.
const MOST_CALLS: usize = 100_000;
/// First tolerance, as a fraction of the workspace's greatest possible size.
const COARSE: f64 = 0.02;

/// Estimates how many triangles [`surface`](super::surface()) makes. If they are few, it is the number before short
/// edges are collapsed. The estimate takes about as long as some thousand triangles. If that does not suffice, the
/// number is a guess.
///
/// The function traces the domain at tolerances that are too coarse, ever finer, until there are enough triangles.
/// From there their number grows as 1/tolerance: curved sheets and walls along which columns turn need so many. The
/// chords of a curve grow only as the root of it, so the estimate is rather too high.
///
/// # Units
///
/// The request's tolerance is in mm.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number of the request is not finite, beyond [`MAX_INPUT`](crate::MAX_INPUT)
///   or, for the tolerance, below 0.001 mm.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, expected_triangles};
///
/// let request = Request::new(Kind::Platform, 20.0);
/// let count = expected_triangles(&Machine::verne(), &request, &Unobserved)?;
/// assert!(count > 100.0 && count < 10_000.0, "{count}");
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn expected_triangles(
    machine: &Machine,
    request: &Request,
    observer: &dyn Observer,
) -> Result<f64, WorkspaceError> {
    request.check()?;
    let domain = Domain::new(machine, request, None);
    let mut tolerance = request.tolerance.max(COARSE * size(machine, &domain));
    let mut last = None;
    loop {
        check_cancelled(observer)?;
        let bounded = Bounded { observer, calls: AtomicUsize::new(0) };
        let found = match traced(&domain, tolerance, &bounded) {
            Ok(plane) => plane.surface_triangles(),
            Err(WorkspaceError::Cancelled) if !observer.cancelled() => ENOUGH,
            Err(error) => return Err(error),
        };
        if tolerance <= request.tolerance {
            return Ok(count(found));
        }
        if let Some(before) = last.filter(|_| found >= ENOUGH) {
            // The triangles that the last step added grow as 1/tolerance. The others were there at any tolerance.
            let added = count(found.saturating_sub(before)) * STEP / (STEP - 1.0);
            return Ok(count(found) + added * (tolerance / request.tolerance - 1.0));
        }
        last = Some(found);
        tolerance = (tolerance / STEP).max(request.tolerance);
    }
}

fn traced(domain: &Domain<'_>, tolerance: f64, observer: &dyn Observer) -> Result<PlaneMesh, WorkspaceError> {
    let cover = Cover::of(domain, Purpose::Meshing(tolerance), observer)?;
    let [squares, ..] = LATTICES;
    PlaneMesh::trace(domain, &cover, squares, tolerance, usize::MAX, observer)
}

/// Stops a trace that takes far longer than an estimate should. On some domains a trace refines many triangles that
/// it discards later.
struct Bounded<'a> {
    observer: &'a dyn Observer,
    calls: AtomicUsize,
}

impl Observer for Bounded<'_> {
    fn progress(&self, _fraction: f64) {}

    fn cancelled(&self) -> bool {
        self.calls.fetch_add(1, Ordering::Relaxed) >= MOST_CALLS || self.observer.cancelled()
    }
}

/// Greatest extent that the workspace may have, mm.
fn size(machine: &Machine, domain: &Domain<'_>) -> f64 {
    let [low, high] = domain.rectangle();
    let strokes = machine.limits().stroke.iter().map(|[low, high]| high - low);
    strokes.fold((high[0] - low[0]).max(high[1] - low[1]), f64::max)
}
