//! The margins between rows.

use super::Rower;
use crate::limit::{Constraint, Margin};
use crate::machine::Machine;
use crate::margins::Margins;
use crate::table::part_pose;
use crate::toolpath::differential::Differential;
use crate::toolpath::golden_section::{STEPS, beside, least};
use crate::toolpath::joint_segment::{JointSegment, Track};
use crate::toolpath::meridian::Span;
use crate::toolpath::node::{ClosedRods, Node};
use crate::toolpath::path::places;

/// Fraction of a margin's range below which a segment's margins are examined between its ends.
const GUARD: f64 = 0.02;
/// The same for the exact path, which is as near to the rows as the tolerance.
const PATH_GUARD: f64 = 0.005;
/// Fraction of a margin's range, to both sides of the limit, within which the place of the least margin is found.
const NEAR: f64 = 0.002;
/// Number of intervals between the places from which that search begins.
const INTERVALS: u32 = 8;

impl Rower<'_> {
    /// Examines the places of a path that has no rows, for the report.
    pub(super) fn survey(&mut self, index: usize, track: &Track<'_>) {
        let Span { from, to, .. } = track.span;
        let count = places(self.setting.machine.longest(), track.path, to - from);
        for place in 0..count {
            let s = from + (to - from) * f64::from(place) / f64::from(count);
            match track.node(s, None) {
                Ok(node) => {
                    self.meet(index, (&node, track.tool_length));
                }
                Err(refusal) => self.refuse(index, track.target(s).pose, refusal),
            }
        }
    }

    /// Examines the margins on the way from the row before, with its margin, to the last row: along the joints' motion,
    /// and along the exact path between its parameters.
    pub(super) fn examine_way(
        &mut self,
        index: usize,
        track: &Track<'_>,
        before: Option<(Node, f64)>,
        [from, to]: [f64; 2],
        segment: Option<&JointSegment<'_>>,
    ) {
        let (Some((before, fraction)), Some((now, last))) = (before, self.now.zip(self.margin)) else {
            return;
        };
        let fraction = fraction.min(last);
        match segment {
            Some(segment) if fraction < GUARD => self.examine(index, segment, track.tool_length),
            None if fraction < PATH_GUARD => {
                self.examine_between(index, [&before, &now], track.tool_length);
            }
            _ => {}
        }
        if fraction < PATH_GUARD {
            let at = |t: f64| track.node(from + (to - from) * t, Some(&before)).ok();
            self.refine(index, track.tool_length, at);
        }
    }

    /// Examines the margins while all joints move straight between two nodes.
    pub(super) fn examine_between(&mut self, index: usize, ends: [&Node; 2], tool_length: f64) {
        let machine = self.setting.machine;
        let differentials = ends.map(|node| Differential::of(machine, &node.rods(machine)));
        if let [Some(first), Some(last)] = &differentials
            && let Some(segment) = JointSegment::new(machine, ends, [first, last])
        {
            self.examine(index, &segment, tool_length);
        }
    }

    /// Examines the margins between the ends of a segment.
    pub(super) fn examine(&mut self, index: usize, segment: &JointSegment<'_>, tool_length: f64) {
        let Some(node) = segment.worst(&self.setting, tool_length) else { return };
        let (_, fraction) = self.meet(index, (&node, tool_length));
        if fraction < PATH_GUARD {
            let machine = self.setting.machine;
            self.refine(index, tool_length, |t| segment.node(machine, t));
        }
    }

    /// Finds the least margin of every constraint that is near its limit, between the places of parameters 0 and 1.
    fn refine(&mut self, index: usize, tool_length: f64, at: impl Fn(f64) -> Option<Node>) {
        let setting = self.setting;
        let fractions =
            |t: f64| at(t).map(|node| fractions(setting.machine, &setting.margins(&node, tool_length)));
        let mut lowest = [(f64::INFINITY, 0); Constraint::COUNT];
        for place in 0..=INTERVALS {
            let Some(found) = fractions(f64::from(place) / f64::from(INTERVALS)) else { continue };
            for (lowest, fraction) in lowest.iter_mut().zip(found) {
                if fraction < lowest.0 {
                    *lowest = (fraction, place);
                }
            }
        }
        for (constraint, (fraction, place)) in lowest.into_iter().enumerate() {
            if fraction.abs() < NEAR {
                let value = |t: f64| fractions(t).map_or(f64::INFINITY, |found| found[constraint]);
                if let Some(node) = at(least(beside(place, INTERVALS), STEPS, value)) {
                    self.meet(index, (&node, tool_length));
                }
            }
        }
    }

    /// Notes the margins of a place, which is given by its joints and the tool's length; those of limits that are
    /// broken are failures. The answer is the worst margin and its fraction of its constraint's range.
    pub(super) fn meet(&mut self, index: usize, (node, tool_length): (&Node, f64)) -> (Margin, f64) {
        self.meet_closed(index, (node, &node.closed_rods(self.setting.machine)), tool_length)
    }

    /// The same with the rods.
    pub(super) fn meet_closed(
        &mut self,
        index: usize,
        (node, rods): (&Node, &ClosedRods),
        tool_length: f64,
    ) -> (Margin, f64) {
        let posture = self.setting.closed(node, rods, tool_length);
        let (margin, fraction) = self.least.meet(self.setting.machine, index, &posture);
        if margin.value < 0.0 {
            let pose = part_pose(self.setting.machine, &node.pose, node.table, tool_length);
            self.report.fail(index, (pose, Some(node)), (margin, fraction));
        }
        (margin, fraction)
    }
}

/// The least margin of every constraint as a fraction of its range.
fn fractions(machine: &Machine, margins: &Margins) -> [f64; Constraint::COUNT] {
    let mut fractions = [f64::INFINITY; Constraint::COUNT];
    margins.worst_of_each(machine, |margin| {
        let least = &mut fractions[margin.constraint as usize];
        *least = least.min(margin.fraction(machine));
    });
    fractions
}
