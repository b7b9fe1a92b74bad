//! From the request to the answer.

use super::answer::{Atlas, Curve, PointKind, Region, SpecialPoint};
use super::arc::Arc;
use super::crossings::{insert_crossings, insert_ends};
use super::leg_one::Shape;
use super::rectangle::Rectangle;
use super::regions::{Count, Grid, counted, polygon};
use super::request::{AtlasError, AtlasRequest, Space, SpecialMachine};
use super::trace::{Traced, traced};
use crate::error::KinematicsError;
use crate::forward::forward;
use crate::inverse::platform;
use crate::machine::Machine;
use crate::workspace::Observer;

/// Computes the atlas of a window: where the numbers of solutions of the parallel module change, and what they are.
///
/// Strokes, cones of the joints and interference play no part. Equal requests have equal answers, to the last bit.
///
/// # Units
///
/// Millimetres. The frame of `Space::Platform` is the base frame; `Space::Joints` has differences of slider
/// positions.
///
/// # Errors
///
/// - [`AtlasError::OutOfDomain`]: window or tolerance are out of range.
/// - [`AtlasError::Cancelled`]: the observer asked the computation to stop.
/// - [`AtlasError::TooFine`]: the curves lie too close together for the limits of points and boxes.
/// - [`AtlasError::Disagreement`]: the solver found different numbers of solutions in a face between the curves.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), sections III.B and
/// III.D. The [module](super) has the derivation.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::atlas::{AtlasError, AtlasRequest, Space, atlas};
/// use verne_solver::workspace::Unobserved;
///
/// let request = AtlasRequest::new(&Machine::verne(), Space::Platform, None);
/// let found = atlas(&Machine::verne(), &request, &Unobserved)?;
/// assert_eq!(found.regions.iter().map(|region| region.solutions).max(), Some(16));
/// let area: f64 = found.regions.iter().map(|region| region.face.area).sum();
/// assert!((area - 2100.0 * 2100.0).abs() < 1e-3, "the regions are the window");
/// # Ok::<(), AtlasError>(())
/// ```
pub fn atlas(
    machine: &Machine,
    request: &AtlasRequest,
    observer: &dyn Observer,
) -> Result<Atlas, AtlasError> {
    request.check(machine)?;
    computed(machine, request, observer).map_err(|error| match error {
        AtlasError::TooFine { .. } => AtlasError::TooFine { near: SpecialMachine::near(machine) },
        AtlasError::Disagreement { .. } => AtlasError::Disagreement { near: SpecialMachine::near(machine) },
        other => other,
    })
}

fn computed(machine: &Machine, request: &AtlasRequest, observer: &dyn Observer) -> Result<Atlas, AtlasError> {
    let unit = machine.longest();
    let shapes: Vec<Shape> =
        Shape::branches(machine).iter().map(|branch| Shape::new(machine, *branch)).collect();
    let window = Rectangle {
        low: [request.window.u[0] / unit, request.window.v[0] / unit],
        high: [request.window.u[1] / unit, request.window.v[1] / unit],
    };
    let tolerance = request.tolerance / unit;
    let Traced { mut arcs, points } = traced(&shapes, request.space, &window, tolerance, observer)?;
    insert_ends(&mut arcs, tolerance);
    insert_crossings(&mut arcs);
    let grid = Grid::new(&window);
    let count = |at: [f64; 2]| count(machine, request.space, at.map(|coordinate| coordinate * unit));
    let counted = counted(&arcs, &grid, tolerance, &count, observer)?;
    let (faces, numbers) = counted.joined(|count| count.solutions);
    let regions = numbers
        .into_iter()
        .enumerate()
        .map(|(face, solutions)| Region { solutions, face: polygon(&faces, face, &arcs, &grid, unit) })
        .collect();
    let (faces, working) = counted.joined(|count| count.working);
    let working = working
        .into_iter()
        .enumerate()
        .filter(|(_, is_working)| *is_working)
        .map(|(face, _)| polygon(&faces, face, &arcs, &grid, unit))
        .collect();
    Ok(Atlas {
        curves: arcs.iter().filter_map(|arc| curve(arc, unit)).collect(),
        points: special_points(&arcs, &points, unit),
        regions,
        working,
        checked_points: counted.checked_points,
    })
}

/// The solver's number of solutions at a point of the plane; `None` if they form a curve.
fn count(machine: &Machine, space: Space, [u, v]: [f64; 2]) -> Option<Count> {
    let found = match space {
        Space::Platform => platform(machine, [u, v, 0.0]),
        Space::Joints => forward(machine, [0.0, u, v]),
    };
    match found {
        Ok(postures) => {
            Some(Count { solutions: postures.len(), working: postures.iter().any(|posture| posture.working) })
        }
        Err(KinematicsError::Unreachable(_)) => Some(Count { solutions: 0, working: false }),
        Err(_) => None,
    }
}

fn curve(arc: &Arc<'_>, unit: f64) -> Option<Curve> {
    let mut points: Vec<[f64; 2]> =
        arc.nodes.iter().map(|node| node.at.map(|coordinate| coordinate * unit)).collect();
    points.dedup();
    if arc.closed {
        points.pop();
    }
    Some(Curve { kind: arc.kind?, closed: arc.closed, points })
}

/// The marked points of all arcs and the points that are no arcs, each once.
fn special_points(arcs: &[Arc<'_>], others: &[(PointKind, [f64; 2])], unit: f64) -> Vec<SpecialPoint> {
    const SAME: f64 = 1e-9;
    let marked = arcs
        .iter()
        .filter(|arc| arc.kind.is_some())
        .flat_map(|arc| arc.nodes.iter().filter_map(|node| Some((node.mark?, node.at))));
    let mut points: Vec<(PointKind, [f64; 2])> = Vec::new();
    for (kind, at) in others.iter().copied().chain(marked) {
        let is_same = |known: &(PointKind, [f64; 2])| (0..2).all(|i| (known.1[i] - at[i]).abs() < SAME);
        if !points.iter().any(is_same) {
            points.push((kind, at));
        }
    }
    points.sort_by(|a, b| a.0.cmp(&b.0).then(a.1[0].total_cmp(&b.1[0])).then(a.1[1].total_cmp(&b.1[1])));
    points
        .into_iter()
        .map(|(kind, at)| SpecialPoint { kind, at: at.map(|coordinate| coordinate * unit) })
        .collect()
}
