//! Certified isolation of all real roots; the method is described in [`crate::trig_polynomial`].

use std::f64::consts::TAU;

use super::grid::{NODES, STEP, node_angle, on_grid};
use super::polynomial::{TrigPolynomial, ValueAndSlope};

/// An arc `[low, high]` that holds roots, with `low < high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RootArc {
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// The angle that [`Self::roots`] refers to.
    pub(crate) at: f64,
    pub(crate) roots: ArcRoots,
}

/// The roots of an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ArcRoots {
    /// Exactly one root, simple, near `at`.
    One,
    /// Two simple roots, one at either side of `at`.
    Two,
    /// The polynomial comes so close to zero at `at`, its only extremum on the arc, that its own rounding cannot
    /// distinguish two roots from none.
    NearDouble,
}

/// Factor of the fourth derivative's bound in the Hermite interpolant's error (of its value,
/// slope and curvature, times h⁴, h³ and h²).
const ERROR: [f64; 3] = [1.0 / 384.0, 0.008_02, 1.0 / 12.0];
/// Arcs are not split below this width.
const NARROWEST: f64 = 1e-7;
/// Steps to an extremum. Most arcs are certain after one or two; a near double root takes them all.
const EXTREMUM_STEPS: usize = 40;
/// Angle by which the grid is rotated if a root lies on a node. There are ten distinct grids and at most eight roots,
/// so one grid is free of them.
const TURN: f64 = STEP / 11.0;
/// The point at which an arc is split: the middle, or next to it if a root is exactly there.
const SPLITS: [f64; 4] = [0.5, 0.41, 0.59, 0.33];

/// Reports the arcs with roots among those of the grid that meet `|θ| <= range`, by ascending angle. `noise` bounds the
/// polynomial's own error: smaller values count as zero.
#[inline]
pub(crate) fn isolate_roots<const M: usize>(
    poly: &TrigPolynomial<M>,
    noise: f64,
    range: f64,
    report: &mut impl FnMut(RootArc),
) {
    let values = on_grid(poly);
    if values.iter().all(|value| value.abs() > noise) {
        isolate_on_grid(poly, &values, noise, range, report);
    } else {
        isolate_on_turned_grid(poly, noise, range, report);
    }
}

/// Like [`isolate_roots`], for a polynomial with a root on a node of the grid.
#[cold]
fn isolate_on_turned_grid<const M: usize>(
    poly: &TrigPolynomial<M>,
    noise: f64,
    range: f64,
    report: &mut impl FnMut(RootArc),
) {
    let least =
        |angle: f64| on_grid(&poly.turned(angle)).iter().fold(f64::INFINITY, |m, value| m.min(value.abs()));
    let angles = (1..=10).map(|turn| f64::from(turn) * TURN);
    let turn = angles.max_by(|a, b| least(*a).total_cmp(&least(*b))).unwrap_or(TURN);
    let turned = poly.turned(turn);
    isolate_on_grid(&turned, &on_grid(&turned), noise, range + STEP, &mut |found| {
        report(RootArc { low: found.low + turn, high: found.high + turn, at: found.at + turn, ..found });
    });
}

#[inline]
fn isolate_on_grid<const M: usize>(
    poly: &TrigPolynomial<M>,
    values: &[f64; NODES],
    noise: f64,
    range: f64,
    report: &mut impl FnMut(RootArc),
) {
    let slopes = on_grid(&poly.derivative());
    let search = Search { poly, noise, fourth: poly.bound(4) };
    let error = search.interpolation_error(0, STEP);
    for i in 0..NODES {
        let next = (i + 1) % NODES;
        let arc = Arc {
            low: node_angle(i),
            width: STEP,
            value: [values[i], values[next]],
            slope: [slopes[i], slopes[next]],
        };
        let inside = arc.low <= range && arc.low + STEP >= -range || arc.low + STEP >= TAU - range;
        if inside && one_sign(arc.control_points(), error).is_none() {
            search.resolve(&arc, report);
        }
    }
}

/// One arc with the polynomial's value and slope at its ends.
#[derive(Clone, Copy, Debug)]
struct Arc {
    low: f64,
    width: f64,
    value: [f64; 2],
    slope: [f64; 2],
}

impl Arc {
    /// Bernstein control points of the cubic Hermite interpolant.
    #[inline]
    fn control_points(&self) -> [f64; 4] {
        let third = self.width / 3.0;
        let [a, b] = self.value;
        [a, a + third * self.slope[0], b - third * self.slope[1], b]
    }

    fn high(&self) -> f64 {
        self.low + self.width
    }

    /// The crossing of zero of a monotone arc's interpolant, to a few hundredths of the arc: the secant, improved by
    /// one Newton step.
    fn interpolated_root(&self) -> f64 {
        let [b0, b1, b2, b3] = self.control_points();
        let (c1, c2, c3) = (3.0 * (b1 - b0), 3.0 * (b2 - 2.0 * b1 + b0), b3 - b0 + 3.0 * (b1 - b2));
        let t = b0 / (b0 - b3);
        let value = b0 + t * (c1 + t * (c2 + t * c3));
        let slope = c1 + t * (2.0 * c2 + 3.0 * t * c3);
        let improved = t - value / slope;
        // A flat interpolant would divide by zero. The secant suffices.
        self.low + self.width * if improved > 0.0 && improved < 1.0 { improved } else { t }
    }

    fn split(&self, at: f64, point: ValueAndSlope) -> (Self, Self) {
        let ([a, b], [da, db]) = (self.value, self.slope);
        let (value, slope) = ([a, point.value], [da, point.slope]);
        let left = Self { low: self.low, width: at - self.low, value, slope };
        let (value, slope) = ([point.value, b], [point.slope, db]);
        (left, Self { low: at, width: self.high() - at, value, slope })
    }

    /// Reports the roots of an arc of one curvature with a point of the other sign than its bend: one at each side
    /// where the end's sign differs.
    fn report_crossings(&self, at: f64, point: ValueAndSlope, report: &mut impl FnMut(RootArc)) {
        let (left, right) = self.split(at, point);
        match (left.crossing(), right.crossing()) {
            (Some(_), Some(_)) => report(self.holding(ArcRoots::Two, at)),
            (one, other) => one.into_iter().chain(other).for_each(report),
        }
    }

    fn holding(&self, roots: ArcRoots, at: f64) -> RootArc {
        RootArc { low: self.low, high: self.high(), at, roots }
    }

    fn crossing(&self) -> Option<RootArc> {
        let crosses = (self.value[0] < 0.0) != (self.value[1] < 0.0);
        crosses.then(|| self.holding(ArcRoots::One, self.interpolated_root()))
    }
}

/// The common sign of all numbers, if each exceeds `error`.
#[inline]
fn one_sign<const N: usize>(numbers: [f64; N], error: f64) -> Option<f64> {
    let least = numbers.iter().fold(f64::INFINITY, |m, &n| m.min(n));
    let most = numbers.iter().fold(f64::NEG_INFINITY, |m, &n| m.max(n));
    if least > error {
        Some(1.0)
    } else if most < -error {
        Some(-1.0)
    } else {
        None
    }
}

struct Search<'a, const M: usize> {
    poly: &'a TrigPolynomial<M>,
    noise: f64,
    fourth: f64,
}

impl<const M: usize> Search<'_, M> {
    /// Error of the interpolant's `power`-th derivative on an arc.
    #[inline]
    fn interpolation_error(&self, power: usize, width: f64) -> f64 {
        let square = width * width;
        let scaled = [square * square, square * width, square][power];
        ERROR[power] * self.fourth * scaled
    }

    fn resolve(&self, arc: &Arc, report: &mut impl FnMut(RootArc)) {
        let [b0, b1, b2, b3] = arc.control_points();
        if one_sign([b0, b1, b2, b3], self.interpolation_error(0, arc.width)).is_some() {
            return;
        }
        let slopes = [arc.slope[0], 3.0 * (b2 - b1) / arc.width, arc.slope[1]];
        if one_sign(slopes, self.interpolation_error(1, arc.width)).is_some() {
            arc.crossing().into_iter().for_each(report);
            return;
        }
        let scale = 6.0 / (arc.width * arc.width);
        let curvatures = [scale * (b2 - 2.0 * b1 + b0), scale * (b3 - 2.0 * b2 + b1)];
        if let Some(bent) = one_sign(curvatures, self.interpolation_error(2, arc.width)) {
            if (arc.slope[0] < 0.0) == (arc.slope[1] < 0.0) {
                arc.crossing().into_iter().for_each(report);
            } else {
                self.around_extremum(arc, bent, report);
            }
            return;
        }
        self.halve(arc, report);
    }

    /// An arc of one curvature with its extremum inside: the slope's zero is approached until the
    /// arc's roots are certain.
    fn around_extremum(&self, arc: &Arc, bent: f64, report: &mut impl FnMut(RootArc)) {
        let (mut low, mut high) = ((arc.low, arc.slope[0]), (arc.high(), arc.slope[1]));
        let mut at = arc.low;
        for step in 1..EXTREMUM_STEPS {
            // Secant steps, and a bisection now and then: the first are fast, the second is certain.
            let part = if step % 3 == 0 { 0.5 } else { low.1 / (low.1 - high.1) };
            at = low.0 + (high.0 - low.0) * part;
            let point = self.poly.at(at);
            if point.value * bent < -self.noise {
                arc.report_crossings(at, point, report);
                return;
            }
            // The curve lies on one side of its tangent, which is nearest to zero at a bracket's end.
            let ends = [low.0 - at, high.0 - at].map(|offset| bent * (point.value + point.slope * offset));
            if ends[0].min(ends[1]) > self.noise {
                return;
            }
            if (point.slope < 0.0) == (arc.slope[0] < 0.0) {
                low = (at, point.slope);
            } else {
                high = (at, point.slope);
            }
        }
        report(arc.holding(ArcRoots::NearDouble, at));
    }

    fn halve(&self, arc: &Arc, report: &mut impl FnMut(RootArc)) {
        for part in SPLITS {
            let middle = arc.low + part * arc.width;
            let point = self.poly.at(middle);
            if arc.width > NARROWEST && point.value.abs() > self.noise {
                let (left, right) = arc.split(middle, point);
                self.resolve(&left, report);
                self.resolve(&right, report);
                return;
            }
        }
        report(arc.holding(ArcRoots::NearDouble, arc.low + 0.5 * arc.width));
    }
}
