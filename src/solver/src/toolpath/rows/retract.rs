//! The tool leaves the part, the rotary axis turns by whole turns, and the tool returns the same way.

use nalgebra::Vector3;

use super::{Retraction, RowKind, RowPlace, Rower, Way};
use crate::error::KinematicsError;
use crate::limit::{Constraint, Element, Margin};
use crate::toolpath::choice::Chosen;
use crate::toolpath::joint_segment::{Stop, Track};
use crate::toolpath::linearise::{Bend, LineariseError, linearise};
use crate::toolpath::meridian::Span;
use crate::toolpath::motion::{Curve, Motion, MotionKind, ToolPosition, Turning};
use crate::toolpath::node::Node;
use crate::toolpath::path::Path;

/// Least cosine of theta1 with which the base's vertical leads away from the table.
const LEAST_COSINE: f64 = 0.05;

impl Rower<'_> {
    /// Changes to another winding off the part.
    pub(super) fn retract(&mut self, index: usize, motion: &Motion, chosen: Chosen) {
        let half_turns = self.h[1] - chosen.h[1];
        self.change_to(chosen);
        let (Some(now), Some(retraction)) = (self.now, self.settings.retraction) else { return };
        let Some(away) = self.way_off(index, motion.tool_length, &now, retraction) else {
            self.now = Some(now.wound_by(half_turns));
            return;
        };
        self.report.retracts += 1;
        for pair in away.windows(2) {
            self.straight_row(index, RowKind::Retract, [&pair[0], &pair[1]], motion.tool_length);
        }
        let back: Vec<Node> = away.iter().rev().map(|node| node.wound_by(half_turns)).collect();
        if let (Some(up), Some(turned)) = (away.last(), back.first()) {
            self.straight_row(index, RowKind::Rewind, [up, turned], motion.tool_length);
        }
        for pair in back.windows(2) {
            self.straight_row(index, RowKind::Approach, [&pair[0], &pair[1]], motion.tool_length);
        }
    }

    /// The nodes along the tool's axis, and up along the base's vertical. `None` if there are none, which is noted.
    fn way_off(
        &mut self,
        index: usize,
        tool_length: f64,
        now: &Node,
        Retraction { clearance, height }: Retraction,
    ) -> Option<Vec<Node>> {
        let start = position(self, now, tool_length);
        let tip = std::array::from_fn(|i| start.tip[i] + clearance * start.axis[i]);
        let leave = Motion {
            kind: MotionKind::Feed,
            end: ToolPosition { tip, axis: start.axis },
            curve: Curve::Line,
            turning: Turning::GreatCircle,
            tool_length,
        };
        let path = Path::new(start, &leave);
        let span = Span::held(-now.table.theta2);
        let track = Track { setting: self.setting, path: &path, span, h: [0; 2], tool_length };
        let mut away = vec![*now];
        let found = self.along(&track, now, &mut away);
        if let Err((s, refusal)) = found {
            self.refuse(index, track.target(s).pose, refusal);
            return None;
        }
        let last = *away.last()?;
        let missing = height - tip[2];
        if missing > 0.0 {
            let cosine = last.turns.tilt[1];
            if cosine < LEAST_COSINE {
                let refusal = no_way(Constraint::Tilt, Element::Range { high: last.table.theta1 > 0.0 });
                self.refuse(index, track.target(1.0).pose, refusal);
                return None;
            }
            // z points down: the sliders move with the platform.
            away.push(last.lifted(missing / cosine));
        }
        Some(away)
    }

    /// Adds the nodes along the tool's axis.
    fn along(
        &self,
        track: &Track<'_>,
        now: &Node,
        away: &mut Vec<Node>,
    ) -> Result<(), (f64, KinematicsError)> {
        if track.path.is_point() {
            return Ok(());
        }
        let end = track.node(1.0, Some(now)).map_err(|refusal| (1.0, refusal))?;
        let stops = [Stop { s: 0.0, node: *now }, Stop { s: 1.0, node: end }];
        let result = linearise(
            track,
            stops[0],
            &stops[1],
            &self.settings.feed,
            &mut Bend::default(),
            |stop, _, _, _| {
                away.push(stop.node);
            },
        );
        result.map_err(|error| match error {
            LineariseError::Refused(s, refusal) => (s, refusal),
            LineariseError::Jump(s) => (s, no_way(Constraint::ParallelSingularity, Element::Platform)),
        })
    }

    /// A row to which all joints move straight, with the margins on the way.
    fn straight_row(&mut self, index: usize, kind: RowKind, [from, to]: [&Node; 2], tool_length: f64) {
        let [before, at] = [from, to].map(|node| position(self, node, tool_length));
        let length = (Vector3::from(at.tip) - Vector3::from(before.tip)).norm();
        let way = Some(Way { fraction: 0.0, length, angle: (to.table.theta2 - from.table.theta2).abs() });
        self.row(index, kind, &RowPlace { tip: at.tip, way, ends_track: true }, to, tool_length);
        self.examine_between(index, [from, to], tool_length);
    }
}

fn position(rower: &Rower<'_>, node: &Node, tool_length: f64) -> ToolPosition {
    let [tip, axis] = node.tool(rower.setting.machine, tool_length).position();
    ToolPosition { tip: tip.into(), axis: axis.into() }
}

fn no_way(constraint: Constraint, element: Element) -> KinematicsError {
    KinematicsError::Unreachable(Margin { constraint, element, value: 0.0 })
}
