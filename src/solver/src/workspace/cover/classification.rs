//! Classification of one box from the bounds of all limits.

use super::posture_bounds::PostureBounds;
use super::rectangle::Rectangle;
use crate::mechanism::Mechanism;
use crate::workspace::domain::{Domain, Limit, LimitSet, RodPairs};

/// Allowance for rounding in a bound, in units of the limit.
const ROUNDING: f64 = 1e-11;
/// Directions in which all limits may rise together.
const DIRECTIONS: [[f64; 2]; 8] =
    [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];

/// The class of a box.
pub(super) enum Class {
    Outside,
    Inside,
    /// Some limits may vanish: see [`State`](super::State). `smooth` means that none of them has a kink where it
    /// vanishes. `weight` bounds a column's volume over its area.
    Crossed {
        limits: LimitSet,
        simple: bool,
        smooth: bool,
        open: bool,
        weight: f64,
    },
}

/// Classifies a box by the bounds of the limits. `pending` are those that may vanish in it.
pub(super) fn classify(domain: &Domain<'_>, rectangle: Rectangle, pending: LimitSet) -> Class {
    let Some(bounds) = PostureBounds::over(domain, rectangle) else { return Class::Outside };
    let (mut left, mut simple, mut smooth, mut open) = (0, true, true, [true; DIRECTIONS.len()]);
    if !bounds.leg_one_works {
        // Leg I's limits all hold at X1 = y = 0. With the distance from there, the limit of the less steep rod is the
        // first to be violated: where the rods cross, w1 is 0.
        let rod = u8::from(bounds.side < 0.0);
        left |= Limit::set(|limit| limit == Limit::LegOneSerial(rod));
        for (open, [x, y]) in open.iter_mut().zip(DIRECTIONS) {
            let inwards = f64::from(bounds.beside());
            *open = y * bounds.side < 0.0 && (x == 0.0 || x * inwards < 0.0);
        }
    }
    for (number, limit) in Limit::of_set(pending & !Limit::LEG_ONE) {
        let (jet, kinked) = bounds.limit(limit);
        let room = ROUNDING * unit(domain, limit);
        if jet.value.high < -room {
            return Class::Outside;
        }
        if jet.value.low > room {
            continue;
        }
        left |= 1 << number;
        smooth &= !kinked;
        // u falls with |y|, and leg I's rods come nearer to each other.
        simple &= jet.slopes[1].sign() != 0 || limit == Limit::RodDistance(RodPairs::LegOne);
        for (open, [x, y]) in open.iter_mut().zip(DIRECTIONS) {
            *open &= (jet.slopes[0].times(x) + jet.slopes[1].times(y)).low > 0.0;
        }
    }
    if left == 0 {
        return Class::Inside;
    }
    Class::Crossed { limits: left, simple, smooth, open: open.contains(&true), weight: bounds.weight() }
}

/// The size of a limit's values.
fn unit(domain: &Domain<'_>, limit: Limit) -> f64 {
    let scale = domain.machine.mechanism.longest;
    match limit {
        Limit::LegSerial(_) => scale * scale,
        Limit::RodDistance(_) | Limit::Stroke(_) | Limit::TablePlane => scale,
        _ => 1.0,
    }
}

/// All limits that can be violated. Leg I reaches wherever its rods do not cross. Without a rod radius the distances
/// between leg I's rods and between different legs cannot be too small.
pub(super) fn all_limits(domain: &Domain<'_>) -> LimitSet {
    let possible = Limit::set(|limit| match limit {
        Limit::LegOneReach => false,
        Limit::RodDistance(RodPairs::Parallelograms) => domain.machine.mechanism.pair_offset[1] != 0.0,
        Limit::RodDistance(_) => domain.machine.geometry().rod_radius > 0.0,
        Limit::TablePlane => domain.table_bounds_columns(),
        _ => true,
    });
    Limit::of_set(possible)
        .filter(|(number, _)| !domain.is_implied(*number))
        .map(|(number, _)| 1 << number)
        .sum()
}

/// The region of the legs' reach in which the rods of parallelograms along x keep their distance. That distance depends
/// on x alone and falls with |x + e2|. For other parallelograms it is the legs' reach.
pub(super) fn parallelograms_apart(domain: &Domain<'_>) -> Option<Rectangle> {
    let d = &domain.machine.mechanism;
    let [[x0, y0], [x1, y1]] = domain.rectangle();
    let [second, third] = greatest_along_pairs(d)?;
    if d.pair_offset[1] != 0.0 {
        return Some([[x0, y0], [x1, y1]]);
    }
    let most = second.min(third);
    let (x0, x1) = (x0.max(-d.e2 - most), x1.min(most - d.e2));
    (x0 < x1).then_some([[x0, y0], [x1, y1]])
}

/// The greatest extent of legs II and III along the widths of their parallelograms at which these are far enough apart;
/// `None` if they never are.
pub(super) fn greatest_along_pairs(d: &Mechanism) -> Option<[f64; 2]> {
    let g = &d.geometry;
    let (width, least) = (2.0 * g.parallelogram_half_width, 2.0 * g.rod_radius);
    if width < least {
        return None;
    }
    let across = |length: f64| {
        let aligned = (1.0 - (least / width).powi(2)).sqrt();
        let beside = (width * width + length * length - least * least) / (2.0 * width * length);
        length * if aligned * width <= length { aligned } else { beside.min(1.0) }
    };
    Some([across(g.L2), across(g.L3)])
}
