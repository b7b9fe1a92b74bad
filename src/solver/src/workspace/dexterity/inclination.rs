//! Intervals of inclinations phi1.

use std::f64::consts::TAU;

use crate::workspace::domain::Binding;

/// Intervals that are less than this apart are one, rad.
const APART: f64 = 1e-9;

/// An interval of inclinations that reach a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InclinationInterval {
    /// `[from, to]` of phi1, rad.
    pub ends: [f64; 2],
    /// The constraint that ends it at either end. `None` if the requested range ends it.
    pub bindings: [Option<Binding>; 2],
}

/// Sorts the intervals and unites those that meet.
pub(super) fn joined(mut found: Vec<InclinationInterval>) -> Vec<InclinationInterval> {
    found.sort_by(|a, b| a.ends[0].total_cmp(&b.ends[0]).then(a.ends[1].total_cmp(&b.ends[1])));
    let mut joined: Vec<InclinationInterval> = Vec::with_capacity(found.len());
    for interval in found {
        match joined.last_mut() {
            Some(last) if interval.ends[0] <= last.ends[1] + APART => {
                if interval.ends[1] > last.ends[1] {
                    last.ends[1] = interval.ends[1];
                    last.bindings[1] = interval.bindings[1];
                }
            }
            _ => joined.push(interval),
        }
    }
    joined
}

/// Whole turns between two angles.
pub(super) fn turns(from: f64, to: f64) -> impl Iterator<Item = f64> {
    let first = (from / TAU).ceil() * TAU;
    std::iter::successors(Some(first), |turn| Some(turn + TAU)).take_while(move |turn| *turn <= to)
}
