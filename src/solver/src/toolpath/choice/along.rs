//! The states along a part of a path.

use super::state::{State, advance};
use crate::toolpath::meridian::Span;
use crate::toolpath::node::Setting;
use crate::toolpath::path::{Path, places, way};

/// Part of the way between two places that are always examined below which no place between them is.
const LEAST_WAY: f64 = 1.0 / 32.0;
/// Greatest number of times that the way between two of those places is halved.
const MOST_HALVINGS: u32 = 6;
/// A limit may be broken between two places if the fraction of a margin's range that is left there is below this
/// multiple of the square of the way between them, as [`Node::way_from`](crate::toolpath::node::Node::way_from).
const CURVATURE: f64 = 2.0;

/// A part of a path.
pub(super) struct Along<'a> {
    pub(super) setting: Setting<'a>,
    pub(super) weights: [f64; 2],
    pub(super) path: &'a Path,
    pub(super) span: &'a Span,
    pub(super) tool_length: f64,
}

impl Along<'_> {
    /// Moves every state to the end; `reached` is called with the states at each place that is examined.
    pub(super) fn advance(&self, states: &mut Vec<State>, mut reached: impl FnMut(&mut Vec<State>, f64)) {
        let Span { from, to, .. } = *self.span;
        let count = places(self.setting.machine.longest(), self.path, to - from);
        let mut last = from;
        for place in 1..=count {
            let part = f64::from(place) / f64::from(count);
            let s = if place == count { to } else { from + (to - from) * part };
            self.advance_part(states, [last, s], MOST_HALVINGS, &mut reached);
            last = s;
        }
    }

    /// Examines halves of a part, too, if a limit may be broken between its ends.
    fn advance_part(
        &self,
        states: &mut Vec<State>,
        [from, to]: [f64; 2],
        halvings: u32,
        reached: &mut impl FnMut(&mut Vec<State>, f64),
    ) {
        let longest = self.setting.machine.longest();
        let is_divided = halvings > 0 && way(longest, self.path, to - from) > LEAST_WAY;
        let before = is_divided.then(|| states.clone());
        let at = self.path.at(to);
        advance(states, &self.setting, self.weights, self.tool_length, |h| {
            self.setting.target(self.span, to, &at, h)
        });
        if let Some(before) = before
            && before.iter().zip(&*states).any(|(from, to)| may_break_between(from, to, longest))
        {
            *states = before;
            let middle = 0.5 * (from + to);
            for part in [[from, middle], [middle, to]] {
                self.advance_part(states, part, halvings - 1, reached);
            }
        } else {
            reached(states, to);
        }
    }
}

/// Whether a limit that holds for a state at both ends of a way may be broken between them.
pub(super) fn may_break_between(before: &State, state: &State, longest: f64) -> bool {
    let (None, Some(from), Some(to)) = (state.twin, before.node, state.node) else { return false };
    let way = to.way_from(&from, longest);
    let left = before.reserve.fraction().min(state.reserve.fraction());
    left >= 0.0 && left < CURVATURE * way * way
}
