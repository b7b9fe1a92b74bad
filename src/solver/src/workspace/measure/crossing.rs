//! The intervals of a line x = const, from the boxes that it crosses.

use super::super::cover::{Cover, State};
use super::super::domain::Domain;
use super::super::path::{End, Path};
use super::super::root;

/// Resolution of an interval's end, as a fraction of the box that contains it.
const RESOLUTION: f64 = 1e-12;
/// Segments of a box in which limits may turn.
const PIECES: u32 = 2;
/// Leg I's limits. Beyond the one that ends the domain the others may be violated too.
const FIRST: u32 = 0b1111;

/// Finds the feasible intervals. A box whose limits each rise or fall along y has at most one, and it is found. The
/// other boxes are small; there the limits are sampled.
pub(super) fn intervals(domain: &Domain<'_>, cover: &Cover, x: f64) -> Vec<[End; 2]> {
    let mut found: Vec<[End; 2]> = Vec::new();
    cover.line(x, &mut |leaf| {
        let range = [leaf.place[0][1], leaf.place[1][1]];
        match leaf.state {
            State::Outside => {}
            State::Inside => join(&mut found, range.map(|y| end(domain, x, y))),
            State::Crossed { limits, simple: true, .. } => {
                let limits = if limits & FIRST == 0 { limits } else { limits | FIRST };
                if let Some(interval) = clipped(domain, x, range, limits) {
                    join(&mut found, interval);
                }
            }
            State::Crossed { simple: false, .. } => {
                let path = Path { domain, at: |y: f64| [x, y] };
                for interval in path.intervals(range, PIECES) {
                    join(&mut found, interval);
                }
            }
        }
    });
    found
}

fn end(domain: &Domain<'_>, x: f64, y: f64) -> End {
    End { t: y, column: domain.column([x, y]), limit: None }
}

/// Adds an interval. If the last one ends where this one begins, without a limit, the two become one.
fn join(found: &mut Vec<[End; 2]>, interval: [End; 2]) {
    match found.last_mut() {
        Some(last)
            if last[1].t == interval[0].t && last[1].limit.is_none() && interval[0].limit.is_none() =>
        {
            last[1] = interval[1];
        }
        _ => found.push(interval),
    }
}

/// Finds the part of a range on which the limits are kept. Each of them rises or falls there.
fn clipped(domain: &Domain<'_>, x: f64, [from, to]: [f64; 2], limits: u32) -> Option<[End; 2]> {
    let (mut low, mut high) = (end(domain, x, from), end(domain, x, to));
    let mut left = limits;
    while left != 0 {
        let limit = left.trailing_zeros() as usize;
        left &= left - 1;
        let [a, b] = [&low, &high].map(|end| domain.value(limit, &end.column));
        if a < 0.0 && b < 0.0 {
            return None;
        }
        if (a < 0.0) != (b < 0.0) {
            let (start, size) = (low.t, high.t - low.t);
            let part = root::zero(a, b, RESOLUTION, |part| {
                domain.value(limit, &domain.column([x, start + part * size]))
            });
            let cut = End { limit: Some(limit), ..end(domain, x, start + part * size) };
            if a < 0.0 {
                low = cut;
            } else {
                high = cut;
            }
        }
    }
    Some([low, high])
}
