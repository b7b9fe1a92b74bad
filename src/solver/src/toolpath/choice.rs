//! The choice of preimage, winding and working solution for a whole program, by dynamic programming.
//!
//! A state at a place is h (half turns of phi2 in addition to the continued meridian) with a working solution. A feed
//! motion keeps h; a bounded stretch around the pole and a rapid may change it, and so may the tool leaving the part if
//! that is allowed. The best sequence of states has the fewest failing places, then leaves the part least often, then
//! has the least turning, then the greatest least margin of the rotary axis, then the least
//! |theta2| at the start, then phi1 >= 0 there.

mod along;
mod cost;
mod feed;
mod rapid;
mod rewind;
mod stages;
mod state;

use std::cmp::Ordering;

use self::along::Along;
use self::cost::Cost;
use self::stages::Stages;
pub(super) use self::stages::{Choice, Chosen, Rewind};
use self::state::{Reserve, State, has_same_posture, is_wound, keep_best_windings, useful_range};
use super::meridian::{Meridian, Span};
use super::motion::{Motion, MotionKind, Motions, ToolPosition};
use super::node::{Node, Setting, half_turns};
use super::path::Path;
use super::start::Start;
use super::stretches::Place;

/// Greatest number of motions of a program all of whose ends are examined.
const ALL_EXAMINED: usize = 10_000;
/// Greatest number of states at a place.
const MOST_STATES: usize = 64;

/// The joints at a place in each working solution, or none, with the limits there.
type Solutions = Vec<(Option<Node>, Reserve)>;

/// Chooses the states of a program.
pub(super) struct Chooser<'a> {
    setting: Setting<'a>,
    weights: [f64; 2],
    states: Vec<State>,
    stages: Stages,
    may_retract: bool,
    joint_rapids: bool,
    is_long: bool,
    /// Length of the tool in the last motion.
    tool_length: Option<f64>,
    /// The end of the last motion, if it has not been examined.
    skipped: Option<Skipped>,
}

/// A place that has not been examined, with the length and the angles of the path to it.
#[derive(Clone, Copy)]
struct Skipped {
    motion: usize,
    tool_length: f64,
    span: Span,
    at: ToolPosition,
    length: f64,
    angle: f64,
}

/// A rapid that begins at a known place.
#[derive(Clone, Copy)]
struct Rapid<'a> {
    path: &'a Path,
    spans: &'a [Span],
    tool_length: f64,
}

impl<'a> Chooser<'a> {
    /// `weights` are those of turning of theta1 and theta2; `start` is where the machine stands before the program.
    pub(super) fn new(
        setting: Setting<'a>,
        weights: [f64; 2],
        start: Option<Start>,
        may_retract: bool,
        joint_rapids: bool,
    ) -> Self {
        let (states, stages) = (start.map(State::of_start).into_iter().collect(), Stages::default());
        let (is_long, tool_length, skipped) = (false, None, None);
        Self { setting, weights, states, stages, may_retract, joint_rapids, is_long, tool_length, skipped }
    }

    /// Examines the program; `go_on` is asked from time to time and ends the examination by `false`.
    pub(super) fn choose(
        mut self,
        motions: &dyn Motions,
        mut meridian: Meridian<'_>,
        mut go_on: impl FnMut(usize) -> bool,
    ) -> Option<Choice> {
        self.is_long = motions.count() > ALL_EXAMINED;
        for index in 0..motions.count() {
            if !go_on(index) {
                return None;
            }
            let motion = motions.motion(index);
            meridian.advance(&motion);
            let is_same_tool = !self.take_tool(motion.tool_length);
            let (spans, tool_length) = (&*meridian.spans, motion.tool_length);
            match &meridian.path {
                Some(path) if motion.kind == MotionKind::Feed => self.feed(index, &motion, path, spans),
                Some(path) if motion.kind == MotionKind::Rapid && is_same_tool => {
                    self.jump(&motion, spans, Some(Rapid { path, spans, tool_length }));
                }
                _ => self.jump(&motion, spans, None),
            }
        }
        Some(self.traced())
    }

    /// Examines the limits of the states anew if the tool is another one; the answer is whether it is.
    fn take_tool(&mut self, tool_length: f64) -> bool {
        let before = self.tool_length.replace(tool_length);
        let is_other = before.is_some_and(|before| before.to_bits() != tool_length.to_bits());
        if is_other {
            self.examine_skipped();
            for state in &mut self.states {
                state.reserve = Reserve::of(&self.setting, state.node.as_ref(), tool_length);
            }
        }
        is_other
    }

    /// The states at the end of a motion whose joints are free.
    fn jump(&mut self, motion: &Motion, spans: &[Span], rapid: Option<Rapid<'_>>) {
        let Some(span) = spans.last() else { return };
        self.examine_skipped();
        let before = std::mem::take(&mut self.states);
        let (phi2, _) = span.meridian(self.setting.stretches, 1.0, motion.end.axis, [0, 0]);
        // The nodes of both preimages; whole turns change theta2 alone.
        let mut known: [Option<Solutions>; 2] = [None, None];
        for h in half_turns(phi2, span.is_odd(), useful_range(&before, &self.setting)) {
            let target = self.setting.target(span, 1.0, &motion.end, [h, h]);
            let nodes = known[usize::from(h.rem_euclid(2) == 1)].get_or_insert_with(|| {
                let nodes = self.setting.nodes(&target, motion.tool_length).unwrap_or_default();
                let none = nodes.is_empty().then_some(None);
                let nodes = nodes.into_iter().map(Some).chain(none);
                nodes
                    .map(|node| (node, Reserve::of(&self.setting, node.as_ref(), motion.tool_length)))
                    .collect()
            });
            for (node, reserve) in nodes {
                let node = node.map(|node| node.wound_to(target.pose.phi2));
                let to =
                    State { h: [h, h], node, reserve: *reserve, cost: Cost::START, parent: 0, twin: None };
                let state = self.entered(&before, rapid, &to);
                self.states.push(state);
            }
            if self.states.len() >= MOST_STATES {
                break;
            }
        }
        self.keep_useful();
        self.stage(None);
    }

    fn along<'p>(&self, path: &'p Path, span: &'p Span, tool_length: f64) -> Along<'p>
    where
        'a: 'p,
    {
        Along { setting: self.setting, weights: self.weights, path, span, tool_length }
    }

    fn keep_useful(&mut self) {
        if self.setting.machine.limits().rotary.is_none() {
            keep_best_windings(&mut self.states);
        }
    }

    /// Gives every state at the beginning of a stretch all its ends.
    fn spread(&mut self, phi2: f64) {
        self.examine_skipped();
        let ends: Vec<i32> = half_turns(phi2, None, useful_range(&self.states, &self.setting)).collect();
        let before = std::mem::take(&mut self.states);
        for (parent, state) in before.iter().enumerate() {
            for h in ends.iter().copied().chain([state.h[1]]) {
                let h = [state.h[1], h];
                if self.states.iter().all(|other| other.h != h || other.parent != parent) {
                    self.states.push(State { h, parent, ..*state });
                }
            }
        }
        self.stage(None);
    }

    /// Keeps the best of the states with the same end of a stretch.
    fn gather(&mut self) {
        self.examine_skipped();
        let before = std::mem::take(&mut self.states);
        for (parent, state) in before.iter().enumerate() {
            let state = State { h: [state.h[1]; 2], parent, ..*state };
            let same = |other: &State| other.h == state.h && has_same_posture(other, &state);
            match self.states.iter_mut().find(|other| same(other)) {
                Some(other) if state.cost.compare(&other.cost) == Ordering::Less => *other = state,
                Some(_) => {}
                None => self.states.push(state),
            }
        }
        self.keep_useful();
        self.stage(None);
    }

    /// Notes the states, so that the chosen ones can be traced back.
    fn stage(&mut self, place: Option<Place>) {
        for i in 0..self.states.len() {
            let twin = (0..i).find(|&j| is_wound(&self.states[j], &self.states[i]));
            self.states[i].twin = twin.map(|j| self.states[j].twin.unwrap_or(j));
        }
        let states = self.states.iter().map(|state| {
            let alpha = state.node.map(|node| compared(node.pose.alpha));
            (Chosen { h: state.h, alpha }, state.parent)
        });
        self.stages.push(place, states);
    }

    fn traced(mut self) -> Choice {
        self.examine_skipped();
        let best = self.states.iter().enumerate().min_by(|(_, a), (_, b)| a.cost.compare(&b.cost));
        let last = best.map_or(0, |(index, _)| index);
        self.stages.traced(last)
    }
}

#[allow(clippy::cast_possible_truncation, reason = "it serves a comparison")]
fn compared(alpha: f64) -> f32 {
    alpha as f32
}
