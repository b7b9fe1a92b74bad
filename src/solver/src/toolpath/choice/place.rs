//! The states at one place: their joints, limits and costs.

use super::cost::Cost;
use super::{Chooser, State};
use crate::margins::Margins;
use crate::toolpath::meridian::Span;
use crate::toolpath::motion::ToolPosition;
use crate::toolpath::node::Node;

/// How far the machine may move for a worst margin of the whole range until the limits are examined again.
const WAY: f64 = 0.125;

/// The limits but the rotary axis'.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reserve {
    /// Whether they hold.
    pub(super) holds: bool,
    /// How far the machine may move until they are examined again, as [`Node::way_from`].
    way: f64,
}

impl Chooser<'_> {
    /// Moves every state to a place.
    pub(super) fn advance(&mut self, tool_length: f64, span: &Span, s: f64, at: &ToolPosition) {
        for i in 0..self.states.len() {
            let state = &self.states[i];
            let target = self.setting.target(span, s, at, state.h);
            let (node, reserve) = match (state.twin, &state.node) {
                (Some(twin), _) => {
                    let twin = &self.states[twin];
                    (twin.node.map(|node| node.wound_to(target.pose.phi2)), twin.reserve)
                }
                (None, before) => {
                    let node = match before {
                        Some(before) => self.setting.node_near(&target, tool_length, before).ok(),
                        None => self.setting.node(&target, tool_length, None).ok(),
                    };
                    (node, self.moved(state, node.as_ref(), tool_length))
                }
            };
            let own = self.place_cost(node.as_ref(), reserve.holds);
            let from = node.as_ref().zip(state.node.as_ref());
            let turning = from.map_or(0.0, |(node, from)| node.turning_from(from, self.weights));
            let cost = state.cost.and(&own, turning);
            let state = &mut self.states[i];
            (state.node, state.reserve, state.cost) = (node, reserve, cost);
        }
    }

    pub(super) fn reserve(&self, node: Option<&Node>, tool_length: f64) -> Reserve {
        let fraction = node.map_or(-1.0, |node| {
            let margins = Margins { rotary: None, ..self.setting.margins(node, tool_length) };
            margins.worst_with_fraction(self.setting.machine).1
        });
        Reserve { holds: fraction >= 0.0, way: WAY * fraction }
    }

    /// The reserve after a state has moved to a place.
    fn moved(&self, state: &State, node: Option<&Node>, tool_length: f64) -> Reserve {
        if let (Some(before), Some(node)) = (&state.node, node)
            && state.reserve.holds
        {
            let way = state.reserve.way - node.way_from(before, self.setting.machine.longest());
            if way > 0.0 {
                return Reserve { holds: true, way };
            }
        }
        self.reserve(node, tool_length)
    }

    /// The cost of one place, where the limits but the rotary axis' hold or not.
    pub(super) fn place_cost(&self, node: Option<&Node>, holds: bool) -> Cost {
        let [low, high] = self.setting.machine.limits().rotary;
        let rotary_margin =
            node.map_or(f64::NEG_INFINITY, |node| (node.table.theta2 - low).min(high - node.table.theta2));
        let failing = if holds && rotary_margin >= 0.0 { 0.0 } else { 1.0 };
        Cost { failing, turning: 0.0, rotary_margin, start: 0.0, is_turned: false }
    }
}
