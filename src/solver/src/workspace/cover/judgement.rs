//! The decision about one box from the bounds of all limits.

use super::super::domain::{Domain, INTERFERENCE, LIMITS, TABLE, TILT};
use super::ranges::Ranges;
use super::rectangle::Rectangle;

/// Allowance for rounding in a bound, in units of the limit.
const ROUNDING: f64 = 1e-11;
/// Directions in which all limits may rise together.
const DIRECTIONS: [[f64; 2]; 8] =
    [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
/// First of the limits that are not leg I's.
pub(super) const OTHERS: usize = 4;

/// The decision about a box.
pub(super) enum Judgement {
    Outside,
    Inside,
    /// Some limits may vanish: see [`State`](super::State). `smooth` means that none of them has a kink where it
    /// vanishes. `weight` bounds a column's volume over its area.
    Crossed {
        limits: u32,
        simple: bool,
        smooth: bool,
        open: bool,
        weight: f64,
    },
}

/// Decides about a box from the bounds of the limits.
pub(super) fn judged(domain: &Domain<'_>, place: Rectangle, pending: u32) -> Judgement {
    let Some(ranges) = Ranges::over(domain, place) else { return Judgement::Outside };
    let (mut left, mut simple, mut smooth, mut open) = (0, true, true, [true; DIRECTIONS.len()]);
    if !ranges.first {
        // Leg I's limits all hold at X1 = y = 0. With the distance from there, the limit of the less steep rod is the
        // first to be violated: where the rods cross, w1 is 0.
        let side = if ranges.side > 0.0 { 2 } else { 3 };
        left |= 1 << side;
        for (open, [x, y]) in open.iter_mut().zip(DIRECTIONS) {
            let inwards = f64::from(ranges.beside());
            *open = y * ranges.side < 0.0 && (x == 0.0 || x * inwards < 0.0);
        }
    }
    for limit in (OTHERS..LIMITS).filter(|limit| pending & (1 << limit) != 0) {
        let (jet, kinked) = ranges.limit(limit);
        let room = ROUNDING * unit(domain, limit);
        if jet.value.high < -room {
            return Judgement::Outside;
        }
        if jet.value.low > room {
            continue;
        }
        left |= 1 << limit;
        smooth &= !kinked;
        // u falls with |y|, and leg I's rods come nearer to each other.
        simple &= jet.slopes[1].sign() != 0 || limit == INTERFERENCE;
        for (open, [x, y]) in open.iter_mut().zip(DIRECTIONS) {
            *open &= (jet.slopes[0].times(x) + jet.slopes[1].times(y)).low > 0.0;
        }
    }
    if left == 0 {
        return Judgement::Inside;
    }
    Judgement::Crossed { limits: left, simple, smooth, open: open.contains(&true), weight: ranges.weight() }
}

/// The size of a limit's values.
fn unit(domain: &Domain<'_>, limit: usize) -> f64 {
    let scale = domain.machine.mechanism.longest;
    match limit {
        4 | 5 => scale * scale,
        INTERFERENCE..TILT | TABLE => scale,
        _ => 1.0,
    }
}

/// All limits that can be violated. Without a rod radius the distances between leg I's rods and between different
/// legs cannot be.
pub(super) fn all_limits(domain: &Domain<'_>) -> u32 {
    let all = (1 << LIMITS) - 1;
    let parallelogram = 1 << (INTERFERENCE + 1);
    let rods = if domain.machine.geometry().rod_radius > 0.0 { 0 } else { 0b111 << INTERFERENCE };
    let table = if domain.floored() { 0 } else { 1 << TABLE };
    all & !(1 | parallelogram | rods | table)
}

/// The part of the legs' reach in which a parallelogram's rods keep their distance. That distance depends on x alone
/// and falls with |x + e2|.
pub(super) fn parallelograms_apart(domain: &Domain<'_>) -> Option<Rectangle> {
    let (g, d) = (domain.machine.geometry(), &domain.machine.mechanism);
    let (width, least) = (2.0 * g.parallelogram_half_width, 2.0 * g.rod_radius);
    if width < least {
        return None;
    }
    let across = |length: f64| {
        let aligned = (1.0 - (least / width).powi(2)).sqrt();
        let beside = (width * width + length * length - least * least) / (2.0 * width * length);
        length * if aligned * width <= length { aligned } else { beside.min(1.0) }
    };
    let most = across(g.L2).min(across(g.L3));
    let [[x0, y0], [x1, y1]] = domain.rectangle();
    let (x0, x1) = (x0.max(-d.e2 - most), x1.min(most - d.e2));
    (x0 < x1).then_some([[x0, y0], [x1, y1]])
}
