//! The states at the end of a rapid, and the limits on the way to them.

use std::cmp::Ordering;

use super::along::may_break_between;
use super::cost::Cost;
use super::state::State;
use super::{Chooser, Rapid};
use crate::toolpath::differential::Differential;
use crate::toolpath::joint_segment::JointSegment;
use crate::toolpath::node::Node;

impl Chooser<'_> {
    /// A state at the end of a rapid, or of an arrival from anywhere, after the best of the states before.
    pub(super) fn entered(&self, before: &[State], rapid: Option<Rapid<'_>>, to: &State) -> State {
        let own = to.reserve.place_cost(&self.setting, to.node.as_ref());
        if before.is_empty() {
            let start = to.node.map_or(f64::INFINITY, |node| node.table.theta2.abs());
            let cost = Cost { start, is_turned: to.h[1].rem_euclid(2) == 1, ..own };
            return State { cost, ..*to };
        }
        let cost = |from: &State| {
            let turning =
                to.node.zip(from.node).map_or(0.0, |(node, from)| node.turning_from(&from, self.weights));
            from.cost.and(&own, turning)
        };
        let mut all: Vec<(Cost, usize)> = before.iter().map(cost).zip(0..).collect();
        all.sort_by(|a, b| a.0.compare(&b.0));
        let mut best: Option<(Cost, usize)> = None;
        for (cost, parent) in all {
            // The rest are no better, whatever their ways are.
            if best.is_some_and(|(least, _)| least.compare(&cost) != Ordering::Greater) {
                break;
            }
            let breaks = rapid.is_some_and(|rapid| self.breaks_limit(rapid, &before[parent], to));
            let cost = Cost { failing: cost.failing + if breaks { 1.0 } else { 0.0 }, ..cost };
            if best.is_none_or(|(least, _)| cost.compare(&least) == Ordering::Less) {
                best = Some((cost, parent));
            }
        }
        let (cost, parent) = best.unwrap_or((own, 0));
        State { cost, parent, ..*to }
    }

    /// Whether a limit that holds at both ends of a rapid is broken between them: on its line, if the joints can follow
    /// it to the state at the end, or else while they move straight.
    fn breaks_limit(&self, rapid: Rapid<'_>, from: &State, to: &State) -> bool {
        let (Some(start), Some(end)) = (from.node, to.node) else { return false };
        if from.reserve.fraction() < 0.0 || to.reserve.fraction() < 0.0 {
            return false;
        }
        if from.h[1] == to.h[0]
            && !self.joint_rapids
            && let Some(breaks) = self.breaks_on_line(rapid, from, &end)
        {
            return breaks;
        }
        may_break_between(from, to, self.setting.machine.longest())
            && self.breaks_straight([&start, &end], rapid.tool_length)
    }

    /// `None` if the joints cannot follow the line to this end.
    fn breaks_on_line(&self, rapid: Rapid<'_>, from: &State, end: &Node) -> Option<bool> {
        let mut states = vec![State { twin: None, cost: Cost::START, ..*from }];
        let (mut is_reached, mut last) = (true, 0.0);
        for span in rapid.spans {
            self.along(rapid.path, span, rapid.tool_length).advance(&mut states, |states, _| {
                is_reached &= states.iter().all(|state| state.node.is_some());
                last = states.iter().map(|state| state.cost.failing).sum();
            });
        }
        let node = states.first()?.node?;
        let is_end = (node.pose.alpha - end.pose.alpha).abs() < 1e-6;
        (is_reached && is_end).then_some(last > 0.0)
    }

    fn breaks_straight(&self, ends: [&Node; 2], tool_length: f64) -> bool {
        let machine = self.setting.machine;
        let differentials = ends.map(|node| Differential::of(machine, &node.rods(machine)));
        let [Some(first), Some(last)] = &differentials else { return false };
        let Some(segment) = JointSegment::new(machine, ends, [first, last]) else { return false };
        let worst = segment.worst(&self.setting, tool_length);
        worst
            .is_some_and(|node| self.setting.margins(&node, tool_length).worst_with_fraction(machine).1 < 0.0)
    }
}
