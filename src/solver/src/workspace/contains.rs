//! Membership by the inverse solution and its margins; no mesh.

use rayon::prelude::*;

use super::observer::{Observer, go_on};
use super::request::{Kind, Request, WorkspaceError};
use crate::inverse::{part_working, platform_working, tool_working};
use crate::limit::{Margin, Refusal};
use crate::machine::Machine;
use crate::margins::Margins;
use crate::pose::{PartPose, Point};
use crate::table::table_angles;

/// Points between two looks at the observer.
const BATCH: usize = 1024;

/// How a point stands to a workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Membership {
    /// Whether the working mode reaches the point and keeps every limit.
    pub inside: bool,
    /// The worst margin, as [`Margins::worst`] has it: not negative inside; `None` where the point
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
    let batches: Result<Vec<Vec<Membership>>, WorkspaceError> = points
        .par_chunks(BATCH)
        .map(|batch| {
            go_on(observer)?;
            Ok(batch.iter().map(|&point| member(machine, request, point)).collect())
        })
        .collect();
    observer.progress(1.0);
    Ok(batches?.concat())
}

/// One point, in the frame of the request's kind.
#[inline]
fn member(machine: &Machine, request: &Request, point: Point) -> Membership {
    let length = request.tool_length;
    let answer = match request.kind {
        Kind::Platform => platform_working(machine, point).map(|posture| (posture, None)),
        Kind::Tool => tool_working(machine, point, length).map(|posture| (posture, None)),
        Kind::Part => {
            let ([x, y, z], phi1, phi2) = (point, request.phi1, request.phi2);
            part_working(machine, &PartPose { x, y, z, phi1, phi2 }, length)
                .map(|posture| (posture, Some(table_angles(machine, posture.pose.alpha, phi1, phi2))))
        }
    };
    match answer {
        Ok((posture, table)) => {
            let margin = Margins::of(machine, &posture, table).worst(machine);
            Membership { inside: margin.value >= 0.0, margin: Some(margin) }
        }
        Err(Refusal::Blocked(margin)) => Membership { inside: false, margin: Some(margin) },
        Err(_) => Membership { inside: false, margin: None },
    }
}
