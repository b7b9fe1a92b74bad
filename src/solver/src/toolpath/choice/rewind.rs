//! Whole turns of the rotary axis within a cut, while the tool is off the part.

use std::cmp::Ordering;
use std::f64::consts::TAU;

use super::cost::Cost;
use super::state::State;
use crate::toolpath::node::Setting;

/// Least gain of the least rotary margin that moves a rewind to another place, rad.
const LEAST_GAIN: f64 = 0.05;
/// Greatest number of whole turns to each side.
const MOST_TURNS: f64 = 8.0;

/// Adds to the states of a place those that whole turns of theta2 lead to, each with the index of its parent. `None`
/// if none of them is better than the state with the same turns.
pub(super) fn rewound(states: &[State], setting: &Setting<'_>, weights: [f64; 2]) -> Option<Vec<State>> {
    let range = setting.machine.limits().rotary?;
    if states.iter().any(|state| state.h[0] != state.h[1]) {
        return None;
    }
    let mut found: Vec<State> =
        states.iter().enumerate().map(|(parent, state)| State { parent, ..*state }).collect();
    let mut is_changed = false;
    for (root, state) in states.iter().enumerate().filter(|(_, state)| state.twin.is_none()) {
        let same = |&(index, other): &(usize, &State)| index == root || other.twin == Some(root);
        let group = states.iter().enumerate().filter(same);
        let Some((parent, from)) = group.min_by(|(_, a), (_, b)| a.cost.compare(&b.cost)) else { continue };
        for h in windings(state, range) {
            let Some(to) = turned(from, h, setting, weights) else { continue };
            let to = State { parent, ..to };
            let existing = states.iter().enumerate().filter(same).find(|(_, other)| other.h == to.h);
            match existing.map(|(index, _)| index) {
                Some(index) if index != parent && is_better(&to.cost, &states[index].cost) => {
                    found[index] = to;
                    is_changed = true;
                }
                Some(_) => {}
                None => {
                    found.push(to);
                    is_changed = true;
                }
            }
        }
    }
    let least = found.iter().map(|state| state.cost.failing).fold(f64::INFINITY, f64::min);
    let [low, high] = range;
    // A state outside the range is of no use if another one serves the cut.
    found.retain(|state| {
        let is_inside = state.node.is_none_or(|node| (low..=high).contains(&node.table.theta2));
        is_inside || state.cost.failing <= least
    });
    is_changed.then_some(found)
}

/// h of the windings of a state within the rotary range.
fn windings(state: &State, [low, high]: [f64; 2]) -> impl Iterator<Item = i32> {
    let range = state.node.map(|node| {
        let turns = |theta2: f64| ((theta2 - node.table.theta2) / TAU).clamp(-MOST_TURNS, MOST_TURNS);
        [turns(low).ceil(), turns(high).floor()]
    });
    let [first, last] = range.map_or([1, 0], |ends| ends.map(whole));
    let h = state.h[0];
    // phi2 = -theta2.
    (first..=last).map(move |turns| h - 2 * turns)
}

/// The state after whole turns.
fn turned(from: &State, h: i32, setting: &Setting<'_>, weights: [f64; 2]) -> Option<State> {
    let before = from.node?;
    let node = before.wound_by(from.h[0] - h);
    let own = from.reserve.place_cost(setting, Some(&node));
    let cost = from.cost.and(&own, node.turning_from(&before, weights));
    let cost = Cost { retracts: from.cost.retracts + 1, ..cost };
    Some(State { h: [h; 2], node: Some(node), cost, twin: None, ..*from })
}

fn is_better(cost: &Cost, than: &Cost) -> bool {
    let gains = Cost { rotary_margin: than.rotary_margin + LEAST_GAIN, ..*than };
    cost.compare(than) == Ordering::Less
        && (cost.failing < than.failing
            || cost.retracts < than.retracts
            || cost.compare(&gains) == Ordering::Less)
}

#[allow(clippy::cast_possible_truncation, reason = "clamped")]
fn whole(number: f64) -> i32 {
    number as i32
}
