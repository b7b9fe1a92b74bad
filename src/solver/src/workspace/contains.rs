//! Membership: the inverse problem's solution and its margins decide. No mesh is used.

use arrayvec::ArrayVec;
use rayon::prelude::*;

use super::observer::{Observer, StepCounter, check_cancelled};
use super::request::{Kind, Request, WorkspaceError};
use crate::clearance::Clearance;
use crate::error::KinematicsError;
use crate::inverse::{
    part_every_working, part_working_rows, platform_working_rows, tool_every_working, tool_working_rows,
};
use crate::limit::Margin;
use crate::machine::Machine;
use crate::margins::Margins;
use crate::margins::margin_batch::MarginBatch;
use crate::pose::{PartPose, Point};
use crate::posture::{Posture, Postures};
use crate::registers::{ROWS, Registers};
use crate::table::table_angles;

/// Points between two calls of the observer.
const BATCH: usize = 1024;

/// Whether a point belongs to a workspace, and its worst margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Membership {
    /// Whether the working mode reaches the point with a solution that keeps every limit.
    pub inside: bool,
    /// The worst margin by [`Margins::worst`](crate::Margins::worst); not negative inside. `None` if the point is out
    /// of domain, or if the platform could move with its sliders locked.
    pub margin: Option<Margin>,
}

/// Decides for each point, in the frame of the request's kind, whether it belongs to the workspace. The answers have
/// the order of the points.
///
/// The function solves the inverse problem and reads the margins. It uses no mesh, and folds do not matter to it. A
/// point that the solver refuses is outside; it is not an error.
///
/// # Units
///
/// Points are millimetres. A margin has the unit of its constraint: mm, rad, or none.
///
/// # Errors
///
/// - [`WorkspaceError::OutOfDomain`]: a number of the request is not finite, beyond [`MAX_INPUT`](crate::MAX_INPUT)
///   or, for the tolerance, below 0.001 mm.
/// - [`WorkspaceError::Cancelled`]: the observer asked to stop.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (15), (26), (27), constraints
/// of section IV.A.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::workspace::{Kind, Request, Unobserved, WorkspaceError, contains};
///
/// let request = Request::new(Kind::Platform, 20.0);
/// let points = [[0.0, 0.0, 1200.0], [0.0, 0.0, 600.0]];
/// let memberships = contains(&Machine::verne(), &request, &points, &Unobserved)?;
/// assert!(memberships[0].inside && !memberships[1].inside);
/// # Ok::<(), WorkspaceError>(())
/// ```
pub fn contains(
    machine: &Machine,
    request: &Request,
    points: &[Point],
    observer: &dyn Observer,
) -> Result<Vec<Membership>, WorkspaceError> {
    request.check()?;
    let part = request.kind == Kind::Part;
    let clearance = request.clearance(machine);
    let nothing = Membership { inside: false, margin: None };
    let mut memberships = StepCounter::new(observer).filled(&nothing, points.len())?;
    points.par_chunks(BATCH).zip(memberships.par_chunks_mut(BATCH)).try_for_each(
        |(points, memberships)| {
            check_cancelled(observer)?;
            // All solutions first, then all margins: the processor overlaps similar short computations.
            let mut solved = MarginBatch::new();
            for (points, memberships) in points.chunks(ROWS).zip(memberships.chunks_mut(ROWS)) {
                solved.clear();
                solutions(machine, request, points, |i, answer| match answer {
                    Ok(posture) => solved.push(i, &posture),
                    Err(refusal) => memberships[i] = refused(&refusal),
                });
                solved.worst(
                    machine,
                    |alpha| part.then(|| table_angles(machine, alpha, request.phi1, request.phi2)),
                    clearance.as_ref(),
                    |i, margin| {
                        memberships[i] = Membership { inside: margin.value >= 0.0, margin: Some(margin) }
                    },
                );
                for (&point, member) in points.iter().zip(memberships) {
                    if !member.inside && request.kind != Kind::Platform {
                        consider_other_solutions(machine, request, clearance.as_ref(), point, member);
                    }
                }
            }
            Ok(())
        },
    )?;
    observer.progress(1.0);
    Ok(memberships)
}

/// Calls `found` with the posture in the working mode at each of at most [`ROWS`] points in the frame of the request's
/// kind.
fn solutions(
    machine: &Machine,
    request: &Request,
    points: &[Point],
    found: impl FnMut(usize, Result<Posture, KinematicsError>),
) {
    let Request { tool_length, phi1, phi2, .. } = *request;
    match request.kind {
        Kind::Platform => platform_working_rows(machine, points, Registers::Widest, found),
        Kind::Tool => tool_working_rows(machine, points, tool_length, Registers::Widest, found),
        Kind::Part => {
            let poses = points.iter().map(|&[x, y, z]| PartPose { x, y, z, phi1, phi2 });
            let poses: ArrayVec<_, ROWS> = poses.take(ROWS).collect();
            part_working_rows(machine, &poses, tool_length, Registers::Widest, found);
        }
    }
}

/// Decides a point for which the working mode has several solutions. The point is inside if one of them keeps every
/// limit. The reported margin is that of the solution with the best worst margin.
fn consider_other_solutions(
    machine: &Machine,
    request: &Request,
    clearance: Option<&Clearance>,
    point: Point,
    member: &mut Membership,
) {
    let found = every_working(machine, request, point);
    if found.len() < 2 {
        return;
    }
    let weighed = found
        .iter()
        .map(|posture| margins(machine, request, clearance, posture).worst_with_fraction(machine));
    if let Some((margin, _)) = weighed.max_by(|(_, a), (_, b)| a.total_cmp(b)) {
        *member = Membership { inside: margin.value >= 0.0, margin: Some(margin) };
    }
}

/// Every posture of the working mode at a point of a `tool` or `part` workspace, in mm in the frame of that kind.
pub(super) fn every_working(machine: &Machine, request: &Request, [x, y, z]: Point) -> Postures {
    let Request { kind, tool_length, phi1, phi2, .. } = *request;
    let found = match kind {
        Kind::Part => part_every_working(machine, &PartPose { x, y, z, phi1, phi2 }, tool_length),
        _ => tool_every_working(machine, [x, y, z], tool_length),
    };
    found.unwrap_or_default()
}

/// The margins of a posture, those of the table for a `part` workspace only.
pub(super) fn margins(
    machine: &Machine,
    request: &Request,
    clearance: Option<&Clearance>,
    posture: &Posture,
) -> Margins {
    let table = (request.kind == Kind::Part)
        .then(|| table_angles(machine, posture.pose.alpha, request.phi1, request.phi2));
    Margins::above_table(machine, posture, table, clearance)
}

fn refused(refusal: &KinematicsError) -> Membership {
    let margin = if let KinematicsError::Unreachable(margin) = refusal { Some(*margin) } else { None };
    Membership { inside: false, margin }
}
