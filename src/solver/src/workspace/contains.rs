//! Membership by the inverse solution and its margins; no mesh.

use arrayvec::ArrayVec;
use rayon::prelude::*;

use super::observer::{Observer, Pace, go_on};
use super::request::{Kind, Request, WorkspaceError};
use crate::inverse::{part_working, platform_working, tool_working};
use crate::limit::{Margin, Refusal};
use crate::machine::Machine;
use crate::margins::worst;
use crate::pose::{PartPose, Point, TableAngles};
use crate::posture::Posture;
use crate::table::table_angles;

/// Points between two looks at the observer.
const BATCH: usize = 1024;
/// Points whose solutions are kept until their margins are looked at.
const TOGETHER: usize = 32;

/// How a point stands to a workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Membership {
    /// Whether the working mode reaches the point and keeps every limit.
    pub inside: bool,
    /// The worst margin, as [`Margins::worst`](crate::Margins::worst) has it: not negative inside; `None` where the point
    /// is out of domain or the platform would move with its sliders locked.
    pub margin: Option<Margin>,
}

/// Whether each point, in the frame of the request's kind, belongs to the workspace; in order.
pub fn contains(
    machine: &Machine,
    request: &Request,
    points: &[Point],
    observer: &dyn Observer,
) -> Result<Vec<Membership>, WorkspaceError> {
    request.check()?;
    let nothing = Membership { inside: false, margin: None };
    let mut members = Pace::new(observer).filled(&nothing, points.len())?;
    points.par_chunks(BATCH).zip(members.par_chunks_mut(BATCH)).try_for_each(|(points, members)| {
        go_on(observer)?;
        for (points, places) in points.chunks(TOGETHER).zip(members.chunks_mut(TOGETHER)) {
            // All solutions, then all margins: a processor overlaps what is alike and short.
            let answers: ArrayVec<_, TOGETHER> =
                points.iter().map(|&point| solution(machine, request, point)).collect();
            for (answer, place) in answers.iter().zip(places) {
                *place = member(machine, answer);
            }
        }
        Ok(())
    })?;
    observer.progress(1.0);
    Ok(members)
}

/// The posture in the working mode at a point in the frame of the request's kind, and the table's
/// angles where it takes part.
type Solution = Result<(Posture, Option<TableAngles>), Refusal>;

#[inline]
fn solution(machine: &Machine, request: &Request, point: Point) -> Solution {
    let length = request.tool_length;
    match request.kind {
        Kind::Platform => platform_working(machine, point).map(|posture| (posture, None)),
        Kind::Tool => tool_working(machine, point, length).map(|posture| (posture, None)),
        Kind::Part => {
            let ([x, y, z], phi1, phi2) = (point, request.phi1, request.phi2);
            part_working(machine, &PartPose { x, y, z, phi1, phi2 }, length)
                .map(|posture| (posture, Some(table_angles(machine, posture.pose.alpha, phi1, phi2))))
        }
    }
}

#[inline]
fn member(machine: &Machine, solution: &Solution) -> Membership {
    match solution {
        Ok((posture, table)) => {
            let margin = worst(machine, posture, *table);
            Membership { inside: margin.value >= 0.0, margin: Some(margin) }
        }
        Err(Refusal::Blocked(margin)) => Membership { inside: false, margin: Some(*margin) },
        Err(_) => Membership { inside: false, margin: None },
    }
}
