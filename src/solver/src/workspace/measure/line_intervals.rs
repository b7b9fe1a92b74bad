//! The intervals of a line x = const, from the boxes that it crosses.

use crate::workspace::cover::{Cover, State};
use crate::workspace::domain::{Domain, Limit, LimitSet};
use crate::workspace::feasible_intervals::{Curve, IntervalEnd};
use crate::workspace::root;

/// Resolution of an interval's end, as a fraction of the box that contains it.
const RESOLUTION: f64 = 1e-12;
/// Segments of a box in which limits may turn.
const SEGMENTS: u32 = 2;

/// Finds the feasible intervals. A box whose limits each rise or fall along y has at most one, and it is found. The
/// other boxes are small; there the limits are sampled.
pub(super) fn intervals(domain: &Domain<'_>, cover: &Cover, x: f64) -> Vec<[IntervalEnd; 2]> {
    let mut found: Vec<[IntervalEnd; 2]> = Vec::new();
    cover.line(x, &mut |crossed| {
        let [low, high] = crossed.rectangle;
        let range = [low[1], high[1]];
        match crossed.state {
            State::Outside => {}
            State::Inside => join(&mut found, range.map(|y| end(domain, x, y))),
            State::Crossed { limits, simple: true, .. } => {
                let limits = if limits & Limit::LEG_ONE == 0 { limits } else { limits | Limit::LEG_ONE };
                if let Some(interval) = clipped(domain, x, range, limits) {
                    join(&mut found, interval);
                }
            }
            State::Crossed { simple: false, .. } => {
                let line = Curve { domain, at: |y: f64| [x, y] };
                for interval in line.intervals(range, SEGMENTS) {
                    join(&mut found, interval);
                }
            }
        }
    });
    found
}

fn end(domain: &Domain<'_>, x: f64, y: f64) -> IntervalEnd {
    IntervalEnd { t: y, column: domain.column([x, y]), limit: None }
}

/// Adds an interval. If the last one ends where this one begins, without a limit, the two become one.
fn join(found: &mut Vec<[IntervalEnd; 2]>, interval: [IntervalEnd; 2]) {
    match found.last_mut() {
        Some(last)
            if last[1].t == interval[0].t && last[1].limit.is_none() && interval[0].limit.is_none() =>
        {
            last[1] = interval[1];
        }
        _ => found.push(interval),
    }
}

/// Finds the portion of a range on which the limits are kept. Each of them rises or falls there.
fn clipped(domain: &Domain<'_>, x: f64, [from, to]: [f64; 2], limits: LimitSet) -> Option<[IntervalEnd; 2]> {
    let (mut low, mut high) = (end(domain, x, from), end(domain, x, to));
    for (limit, _) in Limit::of_set(limits) {
        let [a, b] = [&low, &high].map(|end| domain.value(limit, &end.column));
        if a < 0.0 && b < 0.0 {
            return None;
        }
        if (a < 0.0) != (b < 0.0) {
            let (start, size) = (low.t, high.t - low.t);
            let value = |fraction| domain.value(limit, &domain.column([x, start + fraction * size]));
            let fraction = root::zero(a, b, RESOLUTION, value);
            let cut = IntervalEnd { limit: Some(limit), ..end(domain, x, start + fraction * size) };
            if a < 0.0 {
                low = cut;
            } else {
                high = cut;
            }
        }
    }
    Some([low, high])
}
