//! Rapids, and positions that are reached from anywhere.

use super::{RowKind, RowPlace, Rower};
use crate::pose::PartPose;
use crate::table::part_pose;
use crate::toolpath::choice::Chosen;
use crate::toolpath::differential::Differential;
use crate::toolpath::joint_segment::{JointSegment, Stop};
use crate::toolpath::linearise::linearise;
use crate::toolpath::meridian::Span;
use crate::toolpath::motion::Motion;
use crate::toolpath::node::Node;
use crate::toolpath::path::Path;
use crate::toolpath::report::{Departure, MOST_DEPARTURES};

impl Rower<'_> {
    /// A motion whose path is not the program's.
    pub(super) fn arrive(&mut self, index: usize, motion: &Motion, spans: &[Span]) {
        let chosen = self.next_choice();
        self.change_to(chosen);
        self.now = None;
        self.go_straight(index, motion, spans, &RowPlace::of_arrival(motion.end.tip), chosen);
    }

    /// Moves all joints straight to the end of a motion.
    fn go_straight(
        &mut self,
        index: usize,
        motion: &Motion,
        spans: &[Span],
        place: &RowPlace,
        chosen: Chosen,
    ) {
        let Some(span) = spans.last() else { return };
        let target = self.setting.target(span, 1.0, &motion.end, chosen.h);
        match self.setting.node(&target, motion.tool_length, chosen.alpha.map(f64::from)) {
            Ok(node) => {
                self.row(index, RowKind::Rapid, place, &node, motion.tool_length);
            }
            Err(refusal) => {
                self.refuse(index, target.pose, refusal);
                self.now = None;
            }
        }
    }

    pub(super) fn rapid(&mut self, index: usize, motion: &Motion, path: &Path, spans: &[Span]) {
        self.report.length[1] += path.length();
        let chosen = self.next_choice();
        let keeps = chosen.h == self.h && !self.settings.joint_rapids;
        self.change_to(chosen);
        if keeps && self.now.is_some() && self.keep_state(index, motion, path, spans, chosen) {
            return;
        }
        let before = self.now;
        self.go_straight(index, motion, spans, &RowPlace::on(path, 0.0, 1.0, 1.0), chosen);
        if let (Some(before), Some(after)) = (before, self.now) {
            self.depart(index, motion, path, &before, &after);
        }
    }

    /// Follows a rapid's path with continuous joints; nothing happens if that is not possible.
    fn keep_state(
        &mut self,
        index: usize,
        motion: &Motion,
        path: &Path,
        spans: &[Span],
        chosen: Chosen,
    ) -> bool {
        let Some(mut now) = self.now else { return false };
        let (mut rows, mut bend): (Vec<(f64, Span, Node)>, _) = (Vec::new(), self.bends[1]);
        for span in spans {
            let track = self.track(path, *span, motion.tool_length);
            let Ok(end) = track.node(span.to, Some(&now)) else { return false };
            let stops = [Stop { s: span.from, node: now }, Stop { s: span.to, node: end }];
            let result =
                linearise(&track, stops[0], &stops[1], &self.settings.rapid, &mut bend, |stop, _, _, _| {
                    rows.push((stop.s, *span, stop.node));
                });
            if result.is_err() {
                return false;
            }
            now = end;
        }
        let is_chosen = chosen.alpha.is_none_or(|alpha| (f64::from(alpha) - now.pose.alpha).abs() < 1e-6);
        if !is_chosen {
            return false;
        }
        if let ([.., span], true) = (spans, rows.is_empty()) {
            rows.push((1.0, *span, now));
        }
        self.bends[1] = bend;
        let mut from = 0.0;
        for (s, span, node) in rows {
            let before = self.now.zip(self.margin);
            self.row(index, RowKind::Rapid, &RowPlace::on(path, from, s, span.to), &node, motion.tool_length);
            let track = self.track(path, span, motion.tool_length);
            self.examine_way(index, &track, before, [from, s], None);
            from = s;
        }
        true
    }

    /// Notes how far a rapid with straight joints leaves its line.
    fn depart(&mut self, index: usize, motion: &Motion, path: &Path, before: &Node, after: &Node) {
        let machine = self.setting.machine;
        let differentials = [before, after].map(|node| Differential::of(machine, &node.rods(machine)));
        let segment = match &differentials {
            [Some(first), Some(last)] => JointSegment::new(machine, [before, after], [first, last]),
            _ => None,
        };
        if let Some(segment) = &segment {
            self.examine(index, segment, motion.tool_length);
        }
        self.report.departure_count += 1;
        if self.report.departures.len() >= MOST_DEPARTURES {
            return;
        }
        let greatest = segment.map(|segment| {
            let of =
                |node: &Node| part_pose(self.setting.machine, &node.pose, node.table, motion.tool_length);
            let farthest = segment.farthest(machine, |node| from_line(path, &of(node)).0);
            farthest.map_or((0.0, [0.0; 3]), |node| from_line(path, &of(&node)))
        });
        let departure = match greatest {
            Some((distance, direction)) => Departure { motion: index, distance: Some(distance), direction },
            None => Departure { motion: index, distance: None, direction: [0.0; 3] },
        };
        self.report.departures.push(departure);
    }
}

/// Distance of a tool position from the line between a path's ends, and the unit vector from the line to it.
fn from_line(path: &Path, tool: &PartPose) -> (f64, [f64; 3]) {
    let (start, end) = (path.at(0.0).tip, path.at(1.0).tip);
    let tip = [tool.x, tool.y, tool.z];
    let along: [f64; 3] = std::array::from_fn(|i| end[i] - start[i]);
    let from: [f64; 3] = std::array::from_fn(|i| tip[i] - start[i]);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let square = dot(along, along);
    let t = if square > 0.0 { (dot(from, along) / square).clamp(0.0, 1.0) } else { 0.0 };
    let off: [f64; 3] = std::array::from_fn(|i| from[i] - along[i] * t);
    let distance = dot(off, off).sqrt();
    (distance, if distance > 0.0 { off.map(|c| c / distance) } else { [0.0; 3] })
}
