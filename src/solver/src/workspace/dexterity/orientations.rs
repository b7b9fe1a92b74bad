//! The inclinations that reach one point.

use super::arc::{Arc, arcs};
use super::inclination::{InclinationInterval, joined, turns};
use super::monotone_piece::MonotonePiece;
use super::request::DexterityRequest;
use super::section::ToolWorkspace;
use crate::limit::{Constraint, Element};
use crate::machine::Machine;
use crate::pose::Point;
use crate::request_range::MAX_INPUT;
use crate::workspace::domain::Binding;
use crate::workspace::request::WorkspaceError;

/// Computes the intervals of phi1 within the request's range for which the working mode reaches the part point and
/// keeps every limit. They are in ascending order. Intervals less than 1e-9 rad apart are one.
///
/// The intervals are arcs of a circle (see the [workspace documentation](crate::workspace)). On it each stroke's limit
/// is examined at steps of at most 1/48 of a turn, taken for a parabola between them, and examined again half-way if
/// it may vanish twice. An interval or gap wider than the steps is always found. A narrower one is missed only if a
/// limit turns twice between two steps.
///
/// # Units
///
/// `point` is in the part frame, mm. phi1 is in radians; the ends are precise to 1e-9 rad.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number or `point` is not finite or beyond [`MAX_INPUT`], the range of phi1 is
///   not ordered or longer than a revolution, or the cell is below 0.1 mm.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (9), (14), (26), (27); the
/// intervals are derived in the [workspace documentation](crate::workspace).
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::dexterity::{DexterityRequest, orientations};
/// use verne_solver::workspace::WorkspaceError;
///
/// let request = DexterityRequest { tool_length: 150.0, ..DexterityRequest::new([-0.5, 0.5], 200.0) };
/// let machine = Machine::verne();
/// let found = orientations(&machine, [100.0, 50.0, 300.0], &request)?;
/// assert_eq!(found.len(), 1);
/// assert_eq!(found[0].ends, [-0.5, 0.5], "the whole range");
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn orientations(
    machine: &Machine,
    point: Point,
    request: &DexterityRequest,
) -> Result<Vec<InclinationInterval>, WorkspaceError> {
    request.check()?;
    if !point.iter().all(|coordinate| coordinate.abs() <= MAX_INPUT) {
        return Err(WorkspaceError::OutOfDomain { field: "point" });
    }
    let tool = ToolWorkspace::new(machine, request);
    let [x, y, z] = point;
    let (s, c) = request.phi2.sin_cos();
    let section = tool.section(x * c + y * s);
    Ok(intervals_at(&tool, &section, [y * c - x * s, z], request.phi1))
}

/// The intervals at a section's point (V1, Z).
pub(super) fn intervals_at(
    tool: &ToolWorkspace<'_>,
    section: &[MonotonePiece],
    [v1, z]: [f64; 2],
    range: [f64; 2],
) -> Vec<InclinationInterval> {
    let up = z - tool.machine.table().dt;
    let (radius, psi) = (v1.hypot(up), (-v1).atan2(up));
    let mut found = Vec::new();
    if !section.is_empty() {
        for arc in arcs(tool, section, radius) {
            within_tilt(&arc, psi, &mut |ends, bindings| {
                inclinations(&arc, psi, range, ends, bindings, &mut found);
            });
        }
    }
    let found = joined(found);
    match &tool.floor {
        Some(floor) => floor.cut(z, found),
        None => found,
    }
}

/// Finds the portions of an arc on which theta1 is within its range.
fn within_tilt(arc: &Arc<'_>, psi: f64, portion: &mut dyn FnMut([f64; 2], [Option<Binding>; 2])) {
    let Some([middle, half]) = arc.circle.tool.tilt else {
        portion(arc.ends, arc.bindings);
        return;
    };
    let ([from, to], middle) = (arc.ends, middle + psi);
    for turn in turns(from - middle - half, to - middle + half) {
        let [low, high] = [middle + turn - half, middle + turn + half];
        let tilt = |high| Some(Binding { constraint: Constraint::Tilt, element: Element::Range { high } });
        let (start, first) = if low > from { (low, tilt(false)) } else { (from, arc.bindings[0]) };
        let (end, last) = if high < to { (high, tilt(true)) } else { (to, arc.bindings[1]) };
        if start <= end {
            portion([start, end], [first, last]);
        }
    }
}

/// phi1 along a portion of an arc, within the range.
fn inclinations(
    arc: &Arc<'_>,
    psi: f64,
    [from, to]: [f64; 2],
    ends: [f64; 2],
    [first, last]: [Option<Binding>; 2],
    found: &mut Vec<InclinationInterval>,
) {
    let [start, end] = ends.map(|beta| arc.circle.alpha(beta) - beta + psi);
    let (low, high, bindings) =
        if arc.folded { (start, end, [first, last]) } else { (end, start, [last, first]) };
    for turn in turns(from - high, to - low) {
        let (least, below) = if low + turn > from { (low + turn, bindings[0]) } else { (from, None) };
        let (greatest, above) = if high + turn < to { (high + turn, bindings[1]) } else { (to, None) };
        if least <= greatest {
            found.push(InclinationInterval { ends: [least, greatest], bindings: [below, above] });
        }
    }
}
