//! The largest error of a map.

use super::errors::{ErrorKind, Evaluation, PointErrors};
use super::request::ErrorMapRequest;
use crate::machine::Machine;
use crate::pose::Point;
use crate::workspace::observer::{Observer, check_cancelled};
use crate::workspace::request::WorkspaceError;

/// The step at which the ascent ends, as a fraction of a cell.
const LAST_STEP: f64 = 1e-3;
/// Most moves of an ascent.
const MOST_MOVES: usize = 200;

/// The largest error that was found, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Largest {
    /// The error: mm or rad, by its kind.
    pub value: f64,
    /// The point, mm, in the frame of the workspace's kind.
    pub at: Point,
}

/// Finds a large error of a kind: from the greatest of the given ones it goes upwards within the workspace, to where no
/// neighbour has a greater one. The answer is `None` without given errors.
///
/// The true maximum is not less than the answer. It may be greater if the given points miss the region of a greater
/// maximum.
///
/// # Units
///
/// Millimetres and radians.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number of the request is out of range.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::error_budget::Tolerances;
/// use verne_solver::parameter::Parameter;
/// use verne_solver::workspace::error_map::{ErrorKind, ErrorMapRequest, largest, surface_errors};
/// use verne_solver::workspace::{Kind, Request, Unobserved};
///
/// let (machine, workspace) = (Machine::verne(), Request::new(Kind::Platform, 20.0));
/// let request = ErrorMapRequest { workspace, tolerances: Tolerances::new([(Parameter::L1, 0.01)])?, cell: 100.0 };
/// let boundary = surface_errors(&machine, &request, usize::MAX, &Unobserved)?;
/// let given = boundary.surface.positions.iter().copied().zip(boundary.errors);
/// let given: Vec<_> = given.filter_map(|(at, errors)| Some((at, errors?))).collect();
/// let found = largest(&machine, &request, ErrorKind::TipWorst, &given, &Unobserved)?.expect("a surface");
/// assert!(given.iter().all(|(_, errors)| errors.of(ErrorKind::TipWorst) <= found.value));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn largest(
    machine: &Machine,
    request: &ErrorMapRequest,
    kind: ErrorKind,
    given: &[(Point, PointErrors)],
    observer: &dyn Observer,
) -> Result<Option<Largest>, WorkspaceError> {
    request.check()?;
    let evaluation = Evaluation::new(machine, request);
    let values = given.iter().map(|(at, errors)| Largest { value: errors.of(kind), at: *at });
    let Some(mut best) = values.max_by(|a, b| a.value.total_cmp(&b.value)) else { return Ok(None) };
    let mut step = 0.5 * request.cell;
    for _ in 0..MOST_MOVES {
        if step < LAST_STEP * request.cell {
            break;
        }
        check_cancelled(observer)?;
        let neighbours = directions().filter_map(|direction| {
            let at = [0, 1, 2].map(|axis| best.at[axis] + step * direction[axis]);
            Some(Largest { value: evaluation.inside(at)?.of(kind), at })
        });
        match neighbours.max_by(|a, b| a.value.total_cmp(&b.value)) {
            Some(neighbour) if neighbour.value > best.value => best = neighbour,
            _ => step *= 0.5,
        }
    }
    Ok(Some(best))
}

/// To the 26 neighbours of a cell.
fn directions() -> impl Iterator<Item = [f64; 3]> {
    let each = |x: f64| [-1.0, 0.0, 1.0].into_iter().flat_map(move |y| [-1.0, 0.0, 1.0].map(|z| [x, y, z]));
    [-1.0, 0.0, 1.0].into_iter().flat_map(each).filter(|direction| *direction != [0.0; 3])
}
