//! Classification of one box from the bounds of all limits.

use super::posture_bounds::PostureBounds;
use super::rectangle::Rectangle;
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
    Limit::set(|limit| match limit {
        Limit::LegOneReach | Limit::RodDistance(RodPairs::Parallelograms) => false,
        Limit::RodDistance(_) => domain.machine.geometry().rod_radius > 0.0,
        Limit::TablePlane => domain.table_bounds_columns(),
        _ => true,
    })
}

/// The region of the legs' reach in which a parallelogram's rods keep their distance. That distance depends on x alone
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
