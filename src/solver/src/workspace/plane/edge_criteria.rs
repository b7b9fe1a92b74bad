//! The criteria by which edges are halved.
//!
//! The decision depends on the edge alone. So both triangles at it agree, and squares can be refined in any order.

use super::curve_refinement::chords;
use super::sample::{CREASES, CURVES, Sample, TABLE_CREASES, value};
use crate::pose::Point;
use crate::workspace::cover::Cover;
use crate::workspace::domain::{ColumnEnd, Domain, LIMITS};
use crate::workspace::feasible_intervals::{Shape, control, shape};
use crate::workspace::root;
use crate::workspace::vector::{self, cross, dot};

/// Fraction of the tolerance by which an edge's midpoint may be off. Inside a triangle whose edges are all off by as
/// much, a paraboloid is off by 4/3 of it.
const FLAT: f64 = 0.7;
/// Shortest edge that is halved because a limit may vanish twice on it, and because a sheet is curved, in units of
/// the tolerance.
const SHORTEST: [f64; 2] = [1.0, 0.02];

/// Fraction of the tolerance by which a curve may cross an edge and come back, and by which slider 1 may bind between
/// the others.
const SHALLOW: f64 = 0.25;
/// Longest edge near which nothing is hidden, over the size of the boxes that it crosses.
const LONGEST: f64 = 2.0;
/// Step perpendicular to an edge for the gradient of a limit, in units of the edge.
const STEP: f64 = 1e-4;

/// Precision of the point where the binding changes between sliders 2 and 3, as a fraction of the edge.
const CHANGE: f64 = 1e-6;

/// Greatest number of chords that the wall over an edge may need if a limit crosses the edge. The time to cut a
/// triangle is quadratic in its number of points.
const CHORDS: f64 = 256.0;

/// The decision about an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum EdgeDecision {
    Keep,
    Halve,
}

impl EdgeDecision {
    fn halve_if(halve: bool) -> Self {
        if halve { Self::Halve } else { Self::Keep }
    }
}

/// What the decisions about edges depend on.
pub(super) struct EdgeCriteria<'a> {
    pub(super) domain: &'a Domain<'a>,
    pub(super) cover: &'a Cover,
    pub(super) tolerance: f64,
}

impl EdgeCriteria<'_> {
    /// Decides about an edge. The decision depends on the edge alone, in either direction.
    pub(super) fn decide(&self, a: &Sample, middle: &Sample, b: &Sample) -> EdgeDecision {
        let (a, b) = if b.precedes(a) { (b, a) } else { (a, b) };
        let (mut doubtful, mut changes) = (0_u64, false);
        for curve in (0..LIMITS).chain(TABLE_CREASES..CURVES) {
            match shape(a.values[curve], middle.values[curve], b.values[curve]) {
                Shape::Outside if curve < LIMITS => {
                    return EdgeDecision::halve_if(self.hides_component([a, b], true));
                }
                Shape::Outside => {}
                Shape::Simple => {
                    changes |= curve < LIMITS && (a.values[curve] < 0.0) != (b.values[curve] < 0.0);
                }
                Shape::Doubtful => doubtful |= 1 << curve,
            }
        }
        let length = length(a, b) / self.tolerance;
        let crossed =
            |curve: usize| doubtful & (1 << curve) != 0 && self.is_crossed_twice(curve, [a, middle, b]);
        let halved = length > SHORTEST[0]
            && ((0..CURVES).any(crossed) || self.hides_component([a, b], false))
            || length > SHORTEST[1]
                && !self.domain.flat()
                && (self.is_curved([a, middle, b])
                    || self.hides_crease([a, b])
                    || changes && self.is_twisted([a, middle, b]));
        EdgeDecision::halve_if(halved)
    }

    /// Whether a component of the domain, or a hole, may be hidden near an edge: the edge is so long that its ends and
    /// its middle do not show it.
    fn hides_component(&self, [a, b]: [&Sample; 2], outside: bool) -> bool {
        let length = length(a, b);
        length > SHORTEST[0] * self.tolerance
            && length > LONGEST * self.cover.hidden_size([a.at(), b.at()], outside)
    }

    /// Whether a limit's curve may cross an edge twice, or close on itself near it, by more than is negligible. Its
    /// depth beyond the edge is the parabola's depth over the limit's gradient.
    fn is_crossed_twice(&self, curve: usize, [a, middle, b]: [&Sample; 3]) -> bool {
        let values = [a, middle, b].map(|sample| sample.values[curve]);
        let depth = 0.5 * control(values).abs();
        let (length, [ax, ay], [bx, by], [x, y]) = (length(a, b), a.at(), b.at(), middle.at());
        let beside = [x - STEP * (by - ay), y + STEP * (bx - ax)];
        let across = (value(self.domain, curve, &self.domain.column(beside)) - values[1]) / STEP;
        let gradient = across.hypot(values[2] - values[0]) / length;
        depth > SHALLOW * self.tolerance * gradient
    }

    /// Whether slider 1 binds a sheet between an end where slider 2 does and an end where slider 3 does. Its crease
    /// then crosses the edge twice even if the sheets are straight, and the signs at the ends do not show it. Slider
    /// 1 binds by most where the binding changes between the other two.
    fn hides_crease(&self, [a, b]: [&Sample; 2]) -> bool {
        [CREASES, CREASES + 2].into_iter().any(|first| {
            let [start, end] = [a, b].map(|sample| sample.values[first + 1]);
            let others = a.values[first] < 0.0 && b.values[first] < 0.0;
            others && (start < 0.0 && end > 0.0 || start > 0.0 && end < 0.0) && {
                let ([ax, ay], [bx, by]) = (a.at(), b.at());
                let column = |fraction: f64| {
                    self.domain.column([ax + fraction * (bx - ax), ay + fraction * (by - ay)])
                };
                let change = |fraction: f64| value(self.domain, first + 1, &column(fraction));
                let fraction = root::zero(start, end, CHANGE, change);
                value(self.domain, first, &column(fraction)) > SHALLOW * self.tolerance
            }
        })
    }

    /// Whether the wall over the edge would need too many chords. Columns that turn along it form a ruled surface,
    /// which two triangles approximate only if the turn is small.
    fn is_twisted(&self, [a, middle, b]: [&Sample; 3]) -> bool {
        let turn = (b.column.s * a.column.c - b.column.c * a.column.s).abs();
        let height = [a, middle, b].iter().fold(0.0, |height: f64, sample| {
            let [low, high] = self.domain.ends(&sample.column);
            height.max(high - low)
        });
        self.domain.image.turns_columns() && chords(turn, height, self.tolerance) > CHORDS
    }

    /// Whether a sheet deviates from the edge by more than is allowed. Every slider that binds the sheet on the edge
    /// is examined, because the edge will be cut at a crease. Where the table binds the sheet, it is plane.
    fn is_curved(&self, samples: [&Sample; 3]) -> bool {
        let columns = samples.map(|sample| &sample.column);
        let rates = columns[1].angle_rates(self.domain.machine);
        let slopes = columns[1].drop_rates(self.domain.machine, rates);
        [true, false].into_iter().any(|upper| {
            let sheets = columns.map(|column| self.domain.sheet(column, upper));
            let binding = sheets.map(|heights| ColumnEnd::binding(heights, upper));
            (0..3).filter(|&slider| binding.contains(&ColumnEnd::ALL[slider])).any(|slider| {
                let z = sheets.map(|heights| heights[slider]);
                let image = |i: usize| self.domain.image.point(columns[i], z[i]);
                let (a, m, b) = (image(0), image(1), image(2));
                let off = [0, 1, 2].map(|i| m[i] - 0.5 * (a[i] + b[i]));
                let tangent =
                    |step: Point, turn: f64| self.domain.image.differential(columns[1], z[1], step, turn);
                let [dx, dy] = slopes[slider];
                let normal = cross(tangent([1.0, 0.0, dx], rates[0]), tangent([0.0, 1.0, dy], rates[1]));
                dot(off, normal).abs() > FLAT * self.tolerance * vector::length(normal)
            })
        })
    }
}

/// The length of an edge, mm.
pub(super) fn length(a: &Sample, b: &Sample) -> f64 {
    (a.column.x - b.column.x).hypot(a.column.y - b.column.y)
}
