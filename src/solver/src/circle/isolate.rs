//! Certified isolation of all real roots; the method is described in [`crate::circle`].

use std::f64::consts::TAU;

use super::grid::{NODES, STEP, node_angle, on_grid};
use super::polynomial::{Jet, TrigPolynomial};

/// An arc that holds roots, as `[low, high]` with `low < high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Site {
    /// Exactly one root, simple, near `start`.
    Crossing { low: f64, high: f64, start: f64 },
    /// Two simple roots, one at either side of `at`.
    Pair { low: f64, high: f64, at: f64 },
    /// The polynomial comes so close to zero at `at`, its only extremum on the arc, that its own rounding cannot
    /// distinguish two roots from none.
    Touch { low: f64, high: f64, at: f64 },
}

/// Factor of the fourth derivative's bound in the Hermite interpolant's error (of its value,
/// slope and curvature, times h⁴, h³ and h²).
const ERROR: [f64; 3] = [1.0 / 384.0, 0.008_02, 1.0 / 12.0];
/// Arcs are not split below this width.
const NARROWEST: f64 = 1e-7;
/// Steps to an extremum. Most arcs are certain after one or two; a touch takes them all.
const EXTREMUM_STEPS: usize = 40;
/// Angle by which the grid is rotated if a root lies on a node. There are ten distinct grids and at most eight roots,
/// so one grid is free of them.
const TURN: f64 = STEP / 11.0;
/// The point at which an arc is split: the middle, or next to it if a root is exactly there.
const SPLITS: [f64; 4] = [0.5, 0.41, 0.59, 0.33];

/// Reports all sites on the arcs of the grid that meet `|θ| <= range`, by ascending angle. `noise` bounds the
/// polynomial's own error: smaller values count as zero.
#[inline]
pub(crate) fn isolate<const M: usize>(
    poly: &TrigPolynomial<M>,
    noise: f64,
    range: f64,
    show: &mut impl FnMut(Site),
) {
    let values = on_grid(poly);
    if values.iter().all(|value| value.abs() > noise) {
        walk(poly, &values, noise, range, show);
    } else {
        isolate_turned(poly, noise, range, show);
    }
}

/// Like [`isolate`], for a polynomial with a root on a node of the grid.
#[cold]
fn isolate_turned<const M: usize>(
    poly: &TrigPolynomial<M>,
    noise: f64,
    range: f64,
    show: &mut impl FnMut(Site),
) {
    let least =
        |angle: f64| on_grid(&poly.turned(angle)).iter().fold(f64::INFINITY, |m, value| m.min(value.abs()));
    let angles = (1..=10).map(|turn| f64::from(turn) * TURN);
    let turn = angles.max_by(|a, b| least(*a).total_cmp(&least(*b))).unwrap_or(TURN);
    let turned = poly.turned(turn);
    walk(&turned, &on_grid(&turned), noise, range + STEP, &mut |site| {
        show(match site {
            Site::Crossing { low, high, start } => {
                Site::Crossing { low: low + turn, high: high + turn, start: start + turn }
            }
            Site::Pair { low, high, at } => Site::Pair { low: low + turn, high: high + turn, at: at + turn },
            Site::Touch { low, high, at } => {
                Site::Touch { low: low + turn, high: high + turn, at: at + turn }
            }
        });
    });
}

#[inline]
fn walk<const M: usize>(
    poly: &TrigPolynomial<M>,
    values: &[f64; NODES],
    noise: f64,
    range: f64,
    show: &mut impl FnMut(Site),
) {
    let slopes = on_grid(&poly.derivative());
    let search = Search { poly, noise, fourth: poly.bound(4) };
    let slack = search.slack(0, STEP);
    for i in 0..NODES {
        let next = (i + 1) % NODES;
        let arc = Arc {
            low: node_angle(i),
            width: STEP,
            value: [values[i], values[next]],
            slope: [slopes[i], slopes[next]],
        };
        let inside = arc.low <= range && arc.low + STEP >= -range || arc.low + STEP >= TAU - range;
        if inside && one_sign(arc.control_points(), slack).is_none() {
            search.resolve(&arc, show);
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

    fn split(&self, at: f64, jet: Jet) -> (Self, Self) {
        let ([a, b], [da, db]) = (self.value, self.slope);
        let (value, slope) = ([a, jet.value], [da, jet.slope]);
        let left = Self { low: self.low, width: at - self.low, value, slope };
        let (value, slope) = ([jet.value, b], [jet.slope, db]);
        (left, Self { low: at, width: self.high() - at, value, slope })
    }

    /// An arc of one curvature with a point of the other sign than its bend: a root at either side
    /// where the end's sign differs.
    fn show_crossed(&self, at: f64, jet: Jet, show: &mut impl FnMut(Site)) {
        let (left, right) = self.split(at, jet);
        match (left.crossing(), right.crossing()) {
            (Some(_), Some(_)) => show(Site::Pair { low: self.low, high: self.high(), at }),
            (one, other) => {
                push(show, one);
                push(show, other);
            }
        }
    }

    fn crossing(&self) -> Option<Site> {
        let crosses = (self.value[0] < 0.0) != (self.value[1] < 0.0);
        crosses.then(|| Site::Crossing { low: self.low, high: self.high(), start: self.interpolated_root() })
    }
}

/// The common sign of all numbers, if each exceeds `slack`.
#[inline]
fn one_sign<const N: usize>(numbers: [f64; N], slack: f64) -> Option<f64> {
    let least = numbers.iter().fold(f64::INFINITY, |m, &n| m.min(n));
    let most = numbers.iter().fold(f64::NEG_INFINITY, |m, &n| m.max(n));
    if least > slack {
        Some(1.0)
    } else if most < -slack {
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
    fn slack(&self, power: usize, width: f64) -> f64 {
        let square = width * width;
        let scaled = [square * square, square * width, square][power];
        ERROR[power] * self.fourth * scaled
    }

    fn resolve(&self, arc: &Arc, show: &mut impl FnMut(Site)) {
        let [b0, b1, b2, b3] = arc.control_points();
        if one_sign([b0, b1, b2, b3], self.slack(0, arc.width)).is_some() {
            return;
        }
        let slopes = [arc.slope[0], 3.0 * (b2 - b1) / arc.width, arc.slope[1]];
        if one_sign(slopes, self.slack(1, arc.width)).is_some() {
            push(show, arc.crossing());
            return;
        }
        let scale = 6.0 / (arc.width * arc.width);
        let curvatures = [scale * (b2 - 2.0 * b1 + b0), scale * (b3 - 2.0 * b2 + b1)];
        if let Some(bent) = one_sign(curvatures, self.slack(2, arc.width)) {
            if (arc.slope[0] < 0.0) == (arc.slope[1] < 0.0) {
                push(show, arc.crossing());
            } else {
                self.around_extremum(arc, bent, show);
            }
            return;
        }
        self.halves(arc, show);
    }

    /// An arc of one curvature with its extremum inside: the slope's zero is approached until the
    /// arc's roots are certain.
    fn around_extremum(&self, arc: &Arc, bent: f64, show: &mut impl FnMut(Site)) {
        let (mut low, mut high) = ((arc.low, arc.slope[0]), (arc.high(), arc.slope[1]));
        let mut at = arc.low;
        for step in 1..EXTREMUM_STEPS {
            // Secant steps, and a bisection now and then: the first are fast, the second is certain.
            let part = if step % 3 == 0 { 0.5 } else { low.1 / (low.1 - high.1) };
            at = low.0 + (high.0 - low.0) * part;
            let jet = self.poly.at(at);
            if jet.value * bent < -self.noise {
                arc.show_crossed(at, jet, show);
                return;
            }
            // The curve lies on one side of its tangent, which is nearest to zero at a bracket's end.
            let ends = [low.0 - at, high.0 - at].map(|offset| bent * (jet.value + jet.slope * offset));
            if ends[0].min(ends[1]) > self.noise {
                return;
            }
            if (jet.slope < 0.0) == (arc.slope[0] < 0.0) {
                low = (at, jet.slope);
            } else {
                high = (at, jet.slope);
            }
        }
        show(Site::Touch { low: arc.low, high: arc.high(), at });
    }

    fn halves(&self, arc: &Arc, show: &mut impl FnMut(Site)) {
        for part in SPLITS {
            let middle = arc.low + part * arc.width;
            let jet = self.poly.at(middle);
            if arc.width > NARROWEST && jet.value.abs() > self.noise {
                let (left, right) = arc.split(middle, jet);
                self.resolve(&left, show);
                self.resolve(&right, show);
                return;
            }
        }
        show(Site::Touch { low: arc.low, high: arc.high(), at: arc.low + 0.5 * arc.width });
    }
}

fn push(show: &mut impl FnMut(Site), site: Option<Site>) {
    if let Some(site) = site {
        show(site);
    }
}
