//! Distances between rods over a box.
//!
//! The distance of two segments is the least of |e - s a + t b| over s and t in [0, 1]. Its gradient is that of the
//! same expression at the nearest points, with s and t constant. Over a box it is enclosed with all s and t that may
//! be nearest there.

use super::posture_bounds::PostureBounds;
use crate::interval::Interval;
use crate::jet::Jet;
use crate::margins::interference::{pairs_between_legs, square_distance};
use crate::mechanism::Mechanism;
use crate::rods::FAMILY;

type Vector = [Jet; 3];

/// The least distance between legs less a distance, over a box. The bounds are exact where it is zero, and have the
/// right sign elsewhere. Also whether it may be the distance of several pairs where it is zero.
pub(super) fn rod_distance(bounds: &PostureBounds<'_>, distance: f64) -> (Jet, bool) {
    let mechanism = &bounds.domain.machine.mechanism;
    let ends = bounds.rods.platform_ends(mechanism);
    let (mut least, mut count): (Option<Jet>, usize) = (None, 0);
    for &pair in pairs_between_legs(mechanism) {
        let [i, j] = pair;
        let gap = [0, 1, 2].map(|axis| ends[i][axis] - ends[j][axis]);
        let [a, b] = pair.map(|rod| &bounds.rods.vectors[FAMILY[rod]]);
        let found = of_pair(bounds, pair, square_distance(&gap, a, b).sqrt(), distance).plus(-distance);
        count += usize::from(found.value.low <= 0.0);
        least = Some(match least {
            None => found,
            // A pair that is far enough throughout is not the nearest where the least is zero.
            Some(least) if found.value.low > 0.0 => narrow(least, found.value.high),
            Some(least) if least.value.low > 0.0 => narrow(found, least.value.high),
            Some(least) => {
                let (a, b) = (least.value, found.value);
                Jet { value: Interval::new(a.low.min(b.low), a.high.min(b.high)), ..least.hull(found) }
            }
        });
    }
    (least.unwrap_or(Jet::UNKNOWN), count > 1)
}

fn narrow(jet: Jet, most: f64) -> Jet {
    Jet { value: Interval::new(jet.value.low.min(most), jet.value.high.min(most)), ..jet }
}

fn of_pair(bounds: &PostureBounds<'_>, pair: [usize; 2], here: f64, enough: f64) -> Jet {
    let mechanism = &bounds.domain.machine.mechanism;
    let [a, b] = pair.map(|rod| &bounds.vectors[FAMILY[rod]]);
    let (gap, turn) = (gap(mechanism, bounds, pair), difference(bounds, pair));
    // No point of a segment moves faster than one of its ends.
    let rates = [0, 1].map(|axis| fastest([&gap, a, b], axis));
    let quick = Jet { value: Interval::new(0.0, f64::INFINITY), slopes: rates.map(Interval::around) };
    let quick = quick.centred_at(here, bounds.offsets);
    if quick.value.low > enough || quick.value.high < enough {
        return quick;
    }
    let mut found: Option<Jet> = None;
    for (parameters, between) in nearest(&gap, a, b, &turn) {
        let jet = if between {
            of_lines(bounds, pair, [&gap, a, b, &turn], parameters)
        } else {
            at(&gap, a, b, parameters)
        };
        found = Some(found.map_or(jet, |found: Jet| found.hull(jet)));
    }
    let Some(found) = found else { return quick };
    let slopes =
        [0, 1].map(|axis| found.slopes[axis].intersection(quick.slopes[axis]).unwrap_or(quick.slopes[axis]));
    let jet = Jet { value: quick.value.intersection(found.value).unwrap_or(quick.value), slopes };
    jet.centred_at(here, bounds.offsets)
}

/// From rod j's platform end to rod i's.
fn gap(mechanism: &Mechanism, bounds: &PostureBounds<'_>, pair: [usize; 2]) -> Vector {
    let (g, [along, across]) = (&mechanism.geometry, mechanism.pair_offset);
    // The middle's x, the offset from the middle, and the arm.
    let end = |rod: usize| -> (f64, [f64; 2], f64) {
        match rod {
            0 => (g.D1, [0.0; 2], g.R1),
            1 => (g.D1, [0.0; 2], -g.R1),
            2 => (g.D2, [along, across], -g.R2),
            3 => (g.D2, [-along, -across], -g.R2),
            4 => (g.D2, [along, -across], g.R2),
            _ => (g.D2, [-along, across], g.R2),
        }
    };
    let [(x1, offset1, arm1), (x2, offset2, arm2)] = pair.map(end);
    let arm = arm1 - arm2;
    let x = Jet::constant(x1 + offset1[0] - x2 - offset2[0]);
    [x, bounds.c.times(arm).plus(offset1[1] - offset2[1]), bounds.s.times(arm)]
}

/// The difference of two rods' vectors, which is small where they are nearly parallel. It does not contain the
/// platform's x and y.
fn difference(bounds: &PostureBounds<'_>, pair: [usize; 2]) -> Vector {
    let (g, d) = (bounds.domain.machine.geometry(), &bounds.domain.machine.mechanism);
    // The vectors' x - x of the platform, and y less that of the platform as a cos alpha + b.
    let rods = pair.map(|rod| match FAMILY[rod] {
        0 => [d.e1, g.R1, -g.r1],
        1 => [d.e1, -g.R1, g.r1],
        2 => [d.e2, -g.R2, g.r4],
        _ => [d.e2, g.R2, -g.r4],
    });
    let [offset, factor, rest] = [0, 1, 2].map(|i| rods[0][i] - rods[1][i]);
    let x = Jet::constant(offset);
    let [a, b] = pair.map(|rod| FAMILY[rod]);
    let here = bounds.rods.vectors[a][2] - bounds.rods.vectors[b][2];
    let z = (bounds.vectors[a][2] - bounds.vectors[b][2]).centred_at(here, bounds.offsets);
    [x, bounds.c.times(factor).plus(rest), z]
}

/// Greatest speed of a point of one segment against one of the other, per step along an axis.
fn fastest([gap, a, b]: [&Vector; 3], axis: usize) -> f64 {
    let square = |s: f64, t: f64| -> f64 {
        (0..3)
            .map(|i| {
                let speed = gap[i].slopes[axis] - a[i].slopes[axis].times(s) + b[i].slopes[axis].times(t);
                speed.magnitude() * speed.magnitude()
            })
            .sum()
    };
    square(0.0, 0.0).max(square(0.0, 1.0)).max(square(1.0, 0.0)).max(square(1.0, 1.0)).sqrt()
}

/// Distance between the points at s and t, and its derivatives with s and t constant.
fn at(gap: &Vector, a: &Vector, b: &Vector, [s, t]: [Interval; 2]) -> Jet {
    let value = [0, 1, 2].map(|i| gap[i].value - a[i].value * s + b[i].value * t);
    let length = value.iter().fold(Interval::ZERO, |sum, component| sum + component.square()).root();
    let slopes = [0, 1].map(|axis| {
        let along = (0..3).fold(Interval::ZERO, |sum, i| {
            let speed = gap[i].slopes[axis] - a[i].slopes[axis] * s + b[i].slopes[axis] * t;
            sum + value[i] * speed
        });
        if length.low > 0.0 { along * length.reciprocal() } else { Interval::ALL }
    });
    Jet { value: length, slopes }
}

/// The same if the nearest points are those of the lines. The distance is then the gap along the common
/// perpendicular, whose direction does not depend on the distance.
fn of_lines(
    bounds: &PostureBounds<'_>,
    pair: [usize; 2],
    [gap, a, b, turn]: [&Vector; 4],
    [s, t]: [Interval; 2],
) -> Jet {
    let product = |i: usize, j: usize| turn[i].value * b[j].value - turn[j].value * b[i].value;
    let normal = [product(1, 2), product(2, 0), product(0, 1)];
    let length = normal.iter().fold(Interval::ZERO, |sum, component| sum + component.square()).root();
    if length.low <= 0.0 {
        return at(gap, a, b, [s, t]);
    }
    let unit = normal.map(|component| component * length.reciprocal());
    let along = |vector: [Interval; 3]| (0..3).fold(Interval::ZERO, |sum, i| sum + unit[i] * vector[i]);
    let slopes = [0, 1].map(|axis| {
        along([0, 1, 2].map(|i| gap[i].slopes[axis] - a[i].slopes[axis] * s + b[i].slopes[axis] * t))
    });
    let signed = Jet { value: along([0, 1, 2].map(|i| gap[i].value)), slopes };
    let signed = signed.centred_at(signed_distance(bounds, pair), bounds.offsets);
    match signed.value.sign() {
        1 => signed,
        -1 => -signed,
        _ => Jet {
            value: Interval::new(0.0, signed.value.magnitude()),
            slopes: signed.slopes.map(|slope| slope.hull(-slope)),
        },
    }
}

/// The distance of two rods' lines along the product of their directions, at one point.
fn signed_distance(bounds: &PostureBounds<'_>, pair: [usize; 2]) -> f64 {
    let ends = bounds.rods.platform_ends(&bounds.domain.machine.mechanism);
    let [a, b] = pair.map(|rod| bounds.rods.vectors[FAMILY[rod]]);
    let product = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    let normal = [product(1, 2), product(2, 0), product(0, 1)];
    let length = normal.iter().map(|component| component * component).sum::<f64>().sqrt();
    (0..3).map(|i| (ends[pair[0]][i] - ends[pair[1]][i]) * normal[i]).sum::<f64>() / length
}

/// Parameters that may be those of the nearest points, and whether these are the lines' nearest points. They lie
/// between the ends of both segments, or at an end of one.
///
/// With d = a - b the lines' are at s = (d·e b² - b·e b·d) / |d × b|² and t = s + (s b·d - b·e) / b²,
/// which stays exact where the rods are nearly parallel.
fn nearest(gap: &Vector, a: &Vector, b: &Vector, turn: &Vector) -> Vec<([Interval; 2], bool)> {
    let [ag, bg, ab] = [dot(a, gap), dot(b, gap), dot(a, b)];
    let [aa, bb] = [dot(a, a), dot(b, b)];
    if aa.low <= 0.0 || bb.low <= 0.0 {
        return vec![([Interval::UNIT; 2], false)];
    }
    let (over_a, over_b) = (aa.reciprocal(), bb.reciprocal());
    let [dg, bd, dd] = [dot(turn, gap), dot(b, turn), dot(turn, turn)];
    let gram = dd * bb - bd.square();
    let mut found = Vec::with_capacity(5);
    let s = if gram.low > 0.0 { (dg * bb - bg * bd) * gram.reciprocal() } else { Interval::UNIT };
    if let Some(inner) = s.intersection(Interval::UNIT) {
        let t = inner + (inner * bd - bg) * over_b;
        if let Some(inner_t) = t.intersection(Interval::UNIT) {
            found.push(([inner, inner_t], gram.low > 0.0));
            if gram.low > 0.0 && s.low > 0.0 && s.high < 1.0 && t.low > 0.0 && t.high < 1.0 {
                return found;
            }
        }
    }
    let (start, end) = (Interval::ZERO, Interval::of(1.0));
    let t = (-bg * over_b).clamp(0.0, 1.0);
    if (ag + ab * t).low <= 0.0 {
        found.push(([start, t], false));
    }
    let t = ((ab - bg) * over_b).clamp(0.0, 1.0);
    if (ag + ab * t - aa).high >= 0.0 {
        found.push(([end, t], false));
    }
    let s = (ag * over_a).clamp(0.0, 1.0);
    if (bg - ab * s).high >= 0.0 {
        found.push(([s, start], false));
    }
    let s = ((ab + ag) * over_a).clamp(0.0, 1.0);
    if (bg - ab * s + bb).low <= 0.0 {
        found.push(([s, end], false));
    }
    found
}

fn dot(a: &Vector, b: &Vector) -> Interval {
    (0..3).fold(Interval::ZERO, |sum, i| {
        let product = if std::ptr::eq(a, b) { a[i].value.square() } else { a[i].value * b[i].value };
        sum + product
    })
}
