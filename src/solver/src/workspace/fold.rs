//! Detection of a workspace that two regions of the platform's domain cover.
//!
//! The map from the platform's position to the tool's or the part's keeps x, and rotates or shifts the plane x =
//! const depending on alpha. Two separate regions can have the same image although the Jacobian determinant has one
//! sign. So the inverse problem is solved at points of the workspace: a second feasible solution is a second platform
//! position.

use super::contains::{every_working, margins};
use super::domain::Domain;
use super::observer::{Observer, check_cancelled};
use super::request::{Kind, Request, WorkspaceError};
use crate::machine::Machine;
use crate::pose::Point;

/// Greatest number of sample positions in the rectangle.
const POSITIONS: u32 = 50_000;
/// Number of points of the workspace that are examined.
const POINTS: u32 = 2_000;
/// Factor for the number of points if some point has a second solution that violates a limit.
const SUSPECTED: u32 = 10;
/// If none of n points lies in a region of the workspace, the region's fraction of the volume is less than this over n
/// in 95 of 100 cases.
const UNSEEN: f64 = 3.0;
/// Distance below which two platform positions are the same, as a fraction of the machine's size.
const SAME: f64 = 1e-7;
/// Additive recurrence in three dimensions with the least discrepancy (the powers of the inverse
/// of the real root of x⁴ = x + 1).
const STEPS: [f64; 3] = [0.819_172_513_396_164_5, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3];

/// The number of times that the map covers a workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Covering {
    /// Once, except for a region of this fraction of the volume that may have been missed.
    Once { unseen: f64 },
    /// A point has two feasible solutions.
    Twice,
}

/// The other working solutions of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum OtherSolutions {
    None,
    /// Some are within the table's range and violate another limit.
    Infeasible,
    Feasible,
}

/// Examines points that are spread evenly over the domain's columns.
pub(super) fn covering(
    machine: &Machine,
    request: &Request,
    domain: &Domain<'_>,
    observer: &dyn Observer,
) -> Result<Covering, WorkspaceError> {
    if request.kind == Kind::Platform {
        return Ok(Covering::Once { unseen: 0.0 });
    }
    let rectangle = domain.rectangle();
    let (mut suspected, mut seen) = (false, 0);
    for number in 0..SUSPECTED * POSITIONS {
        let wanted = if suspected { SUSPECTED } else { 1 };
        if seen >= wanted * POINTS || number >= wanted * POSITIONS {
            break;
        }
        if number % 64 == 0 {
            check_cancelled(observer)?;
        }
        if let Some(sample) = feasible_sample(domain, rectangle, number) {
            seen += 1;
            match other_solutions(machine, request, sample.platform, sample.image) {
                OtherSolutions::None => {}
                OtherSolutions::Infeasible => suspected = true,
                OtherSolutions::Feasible => return Ok(Covering::Twice),
            }
        }
    }
    let unseen = if suspected { (UNSEEN / f64::from(seen.max(1))).min(1.0) } else { 0.0 };
    Ok(Covering::Once { unseen })
}

/// A point of the workspace and a platform position that reaches it.
struct FeasibleSample {
    platform: Point,
    image: Point,
}

fn feasible_sample(domain: &Domain<'_>, [low, high]: [[f64; 2]; 2], number: u32) -> Option<FeasibleSample> {
    let fraction = STEPS.map(|step| (0.5 + step * f64::from(number)).fract());
    let [x, y] = [0, 1].map(|axis| low[axis] + fraction[axis] * (high[axis] - low[axis]));
    let column = domain.column([x, y]);
    let inside = domain.values(&column).iter().all(|value| *value >= 0.0);
    let [bottom, top] = domain.ends(&column);
    let z = bottom + fraction[2] * (top - bottom);
    (inside && bottom <= top)
        .then(|| FeasibleSample { platform: [x, y, z], image: domain.image.point(&column, z) })
}

/// Classifies the solutions at a point of the workspace other than the known one.
fn other_solutions(machine: &Machine, request: &Request, known: Point, point: Point) -> OtherSolutions {
    let clearance = request.clearance(machine);
    let same = SAME * machine.mechanism.longest;
    let found = every_working(machine, request, point);
    let others = found.iter().filter(|posture| {
        let pose = &posture.pose;
        (pose.y - known[1]).hypot(pose.z - known[2]) > same
    });
    let classes = others.map(|posture| {
        let margins = margins(machine, request, clearance.as_ref(), posture);
        let in_range = margins.tilt.iter().chain(&margins.rotary).flatten().all(|margin| *margin >= 0.0);
        match (margins.feasible(), in_range) {
            (true, _) => OtherSolutions::Feasible,
            (false, true) => OtherSolutions::Infeasible,
            (false, false) => OtherSolutions::None,
        }
    });
    classes.max().unwrap_or(OtherSolutions::None)
}
