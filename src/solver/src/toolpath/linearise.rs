//! The rows between two stops: so few that between any two of them the joints may change linearly.

use super::bound::BoundEnd;
use super::joint_segment::{Deviation, JointSegment, Stop, Track};
use super::node::Node;
use crate::error::KinematicsError;
use crate::pose::PartPose;

/// The fraction of the tolerance that is used: the greatest deviation may lie between the places that are examined.
const USED: f64 = 0.97;
/// The fraction of the tolerance that a step aims at.
const AIM: f64 = 0.88;
/// Greatest and least ratio of a step to the one before.
const RATIOS: [f64; 2] = [0.2, 2.5];
/// The remaining path is halved if it is shorter than this many steps.
const LAST: f64 = 1.9;
/// Least step, as a fraction of a motion.
const LEAST_STEP: f64 = 1e-9;

/// Why a path between two stops cannot be divided into rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum LineariseError {
    /// A place between the stops has no solution.
    Refused(f64, KinematicsError),
    /// The joints jump at this parameter: however short a segment is, the tool leaves the path.
    Jump(f64),
}

/// Divides the path between two stops into segments, and calls `found` with the end of each.
pub(super) fn linearise(
    track: &Track<'_>,
    start: Stop,
    end: Stop,
    tolerance: &Deviation,
    mut found: impl FnMut(&Stop, Option<&JointSegment>, Deviation),
) -> Result<(), LineariseError> {
    if let Some(deviation) = bounded(track, &start, &end).filter(|bound| bound.ratio(tolerance) <= USED) {
        found(&end, None, deviation);
        return Ok(());
    }
    let mut now = start;
    let mut step = end.s - start.s;
    while now.s < end.s {
        let rest = end.s - now.s;
        let (next, is_last) = if step >= rest {
            (end, true)
        } else {
            let width = if step * LAST > rest { 0.5 * rest } else { step };
            (stop_at(track, now.s + width, &now.node)?, false)
        };
        let width = next.s - now.s;
        let segment = JointSegment::new(track.setting.machine, &now.node, &next.node);
        let deviation =
            segment.as_ref().and_then(|segment| segment.deviation(track, [now.s, next.s], tolerance));
        let ratio = deviation.map_or(f64::INFINITY, |deviation| deviation.ratio(tolerance));
        // The deviation grows with the square of the step.
        let scale = if ratio > 0.0 { (AIM / ratio).sqrt() } else { RATIOS[1] };
        let scale = scale.clamp(RATIOS[0], RATIOS[1]);
        match (segment, deviation) {
            (Some(segment), Some(deviation)) if ratio <= USED => {
                found(&next, Some(&segment), deviation);
                now = next;
                step = if is_last { step } else { width * scale };
            }
            _ if width < LEAST_STEP => return Err(LineariseError::Jump(now.s)),
            _ => step = width * scale.min(0.9),
        }
    }
    Ok(())
}

/// An upper bound of the deviation of a single segment between two stops.
fn bounded(track: &Track<'_>, start: &Stop, end: &Stop) -> Option<Deviation> {
    let machine = track.setting.machine;
    let (a, b) = (&start.node, &end.node);
    let ends = [a, b].map(|node| BoundEnd::new(machine, node));
    let joints = ends[0].second_derivatives(machine, [a, b], &ends[1], track.tool_length)?;
    let width = end.s - start.s;
    let [tip, axis] = track.path.second_derivatives().map(|second| second * width * width);
    // Inside a cap the axis is off its path at the ends, too.
    let off = if track.span.stretch().is_some() { track.setting.pole } else { 0.0 };
    Some(Deviation { tip: 0.125 * (joints.tip + tip), axis: off + 0.125 * (joints.axis + axis) })
}

fn stop_at(track: &Track<'_>, s: f64, before: &Node) -> Result<Stop, LineariseError> {
    let node =
        track.node(s, Some(before.pose.alpha)).map_err(|refusal| LineariseError::Refused(s, refusal))?;
    Ok(Stop { s, node })
}

impl Track<'_> {
    /// The joints at a parameter.
    pub(super) fn node(&self, s: f64, alpha: Option<f64>) -> Result<Node, KinematicsError> {
        self.setting.node(&self.target(s), self.tool_length, alpha)
    }

    /// The pose of the tool at a parameter.
    pub(super) fn target(&self, s: f64) -> PartPose {
        self.setting.target(&self.span, s, &self.path.at(s), self.h)
    }
}
