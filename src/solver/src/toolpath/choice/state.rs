//! The states at one place: their joints, limits and costs.

use std::cmp::Ordering;
use std::f64::consts::PI;

use super::cost::Cost;
use crate::limit::Constraint;
use crate::margins::lesser_margins::{ClosedPosture, Reference, worst_and_lesser};
use crate::toolpath::node::{Node, Setting, Target};
use crate::toolpath::start::Start;

/// How far the machine may move for a worst margin of the whole range until the limits are examined again.
const WAY: f64 = 1.0 / 32.0;

/// A state: h now and, inside a stretch, at its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct State {
    pub(super) h: [i32; 2],
    pub(super) node: Option<Node>,
    pub(super) reserve: Reserve,
    pub(super) cost: Cost,
    pub(super) parent: usize,
    /// An earlier state that differs by whole turns of theta2 alone.
    pub(super) twin: Option<usize>,
}

impl State {
    /// The state before the program. Its limits are examined at the next place.
    pub(super) fn of_start(start: Start) -> Self {
        let reserve = Reserve { holds: false, way: 0.0, reference: None };
        Self { h: [0; 2], node: Some(start.node()), reserve, cost: Cost::START, parent: 0, twin: None }
    }
}

/// The limits but the rotary axis'.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reserve {
    /// Whether they hold.
    holds: bool,
    /// How far the machine may move until they are examined again, as [`Node::way_from`].
    way: f64,
    reference: Option<Reference>,
}

impl Reserve {
    pub(super) fn of(setting: &Setting<'_>, node: Option<&Node>, tool_length: f64) -> Self {
        Self::near(setting, node, tool_length, None)
    }

    /// The same near the place of a reference.
    fn near(
        setting: &Setting<'_>,
        node: Option<&Node>,
        tool_length: f64,
        mut reference: Option<Reference>,
    ) -> Self {
        let fraction = node.map_or(-1.0, |node| {
            let rods = node.closed_rods(setting.machine);
            let posture = ClosedPosture { theta2: None, ..setting.closed(node, &rods, tool_length) };
            let mut known = [f64::NEG_INFINITY; Constraint::COUNT];
            worst_and_lesser(setting.machine, &posture, (&mut known, &mut reference), |_| {}).1
        });
        Self { holds: fraction >= 0.0, way: WAY * fraction, reference }
    }

    /// The reserve after the machine has moved.
    fn moved(self, setting: &Setting<'_>, [before, node]: [Option<&Node>; 2], tool_length: f64) -> Self {
        if let (Some(before), Some(node)) = (before, node)
            && self.holds
        {
            let way = self.way - node.way_from(before, setting.machine.longest());
            if way > 0.0 {
                return Self { holds: true, way, ..self };
            }
        }
        Self::near(setting, node, tool_length, self.reference)
    }

    /// What is left of the worst margin, as a fraction of its range, or less; negative where a limit is broken.
    pub(super) fn fraction(self) -> f64 {
        if self.holds { self.way / WAY } else { -1.0 }
    }

    /// The cost of a place with these limits.
    pub(super) fn place_cost(self, setting: &Setting<'_>, node: Option<&Node>) -> Cost {
        let [low, high] = setting.machine.limits().rotary.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let rotary_margin =
            node.map_or(f64::NEG_INFINITY, |node| (node.table.theta2 - low).min(high - node.table.theta2));
        let failing = if self.holds && rotary_margin >= 0.0 { 0.0 } else { 1.0 };
        Cost { failing, retracts: 0, turning: 0.0, rotary_margin, start: 0.0, is_turned: false }
    }
}

/// Moves every state to a place; `target` is the pose there.
pub(super) fn advance(
    states: &mut [State],
    setting: &Setting<'_>,
    weights: [f64; 2],
    tool_length: f64,
    target: impl Fn([i32; 2]) -> Target,
) {
    for i in 0..states.len() {
        let state = &states[i];
        let target = target(state.h);
        let (node, reserve) = if let Some(twin) = state.twin {
            let twin = &states[twin];
            (twin.node.map(|node| node.wound_to(target.pose.phi2)), twin.reserve)
        } else {
            let node = match &state.node {
                Some(before) => setting.node_near(&target, tool_length, before).ok(),
                None => setting.node(&target, tool_length, None).ok(),
            };
            let ends = [state.node.as_ref(), node.as_ref()];
            (node, state.reserve.moved(setting, ends, tool_length))
        };
        let own = reserve.place_cost(setting, node.as_ref());
        let from = node.as_ref().zip(state.node.as_ref());
        let turning = from.map_or(0.0, |(node, from)| node.turning_from(from, weights));
        let cost = state.cost.and(&own, turning);
        let state = &mut states[i];
        (state.node, state.reserve, state.cost) = (node, reserve, cost);
    }
}

/// The range of theta2 in which windings of the next place are of use: that of the machine, or without one, half a turn
/// to both sides of the states.
pub(super) fn useful_range(states: &[State], setting: &Setting<'_>) -> [f64; 2] {
    setting.machine.limits().rotary.unwrap_or_else(|| {
        let theta2 = states.iter().filter_map(|state| Some(state.node?.table.theta2));
        let ends = theta2.fold(None, |ends: Option<[f64; 2]>, theta2| {
            let [low, high] = ends.unwrap_or([theta2; 2]);
            Some([low.min(theta2), high.max(theta2)])
        });
        let [low, high] = ends.unwrap_or_default();
        [low - PI, high + PI]
    })
}

/// Keeps the best of the states that differ by whole turns only: without a limit of the rotary axis they have the same
/// future.
pub(super) fn keep_best_windings(states: &mut Vec<State>) {
    for index in (0..states.len()).rev() {
        let state = &states[index];
        let is_better = |(number, other): (usize, &State)| match other.cost.compare(&state.cost) {
            Ordering::Less => true,
            Ordering::Equal => number < index,
            Ordering::Greater => false,
        };
        let same = |&(_, other): &(usize, &State)| {
            (other.h[1] - state.h[1]) % 2 == 0 && has_same_posture(other, state)
        };
        if states.iter().enumerate().filter(same).any(is_better) {
            states.remove(index);
        }
    }
}

/// Whether the platform is at the same place in two states, or nowhere.
pub(super) fn has_same_posture(a: &State, b: &State) -> bool {
    match (a.node, b.node) {
        (Some(a), Some(b)) => (a.pose.alpha - b.pose.alpha).abs() < 1e-6,
        (None, None) => true,
        _ => false,
    }
}

/// Whether two states differ by whole turns of theta2 only.
pub(super) fn is_wound(a: &State, b: &State) -> bool {
    let turns = [0, 1].map(|end| a.h[end] - b.h[end]);
    let alpha = |state: &State| state.node.map(|node| node.pose.alpha.to_bits());
    turns[0] == turns[1] && turns[0] % 2 == 0 && alpha(a) == alpha(b)
}
