//! Certified isolation of all real roots; the method is described in [`crate::circle`].

use arrayvec::ArrayVec;

use super::grid::{NODES, STEP, node_angle, on_grid};
use super::polynomial::TrigPolynomial;

/// An arc that holds roots, as `[low, high]` with `low < high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Site {
    /// Exactly one root, simple, near `start`.
    Crossing { low: f64, high: f64, start: f64 },
    /// The polynomial comes so close to zero at `at`, its only extremum on the arc, that its own
    /// rounding cannot tell two roots from none.
    Touch { low: f64, high: f64, at: f64 },
}

/// The sites of one polynomial: eight roots at most, and room for touches that are none.
pub(crate) type Sites = ArrayVec<Site, 16>;

/// Factor of the fourth derivative's bound in the Hermite interpolant's error (of its value,
/// slope and curvature, times h⁴, h³ and h²).
const ERROR: [f64; 3] = [1.0 / 384.0, 0.008_02, 1.0 / 12.0];
/// Arcs are not split below this width.
const NARROWEST: f64 = 1e-7;
/// How far the grid is turned when a root lies on a node: ten distinct grids, while a polynomial
/// has eight roots, so that one of them is free.
const TURN: f64 = STEP / 11.0;
/// Where an arc is split: in the middle, or beside it if a root is just there.
const SPLITS: [f64; 4] = [0.5, 0.41, 0.59, 0.33];

/// All sites on the arcs of the grid that meet `|θ| <= range`. `noise` bounds the polynomial's own
/// error: what is smaller is not told from zero.
#[inline]
pub(crate) fn isolate<const M: usize>(poly: &TrigPolynomial<M>, noise: f64, range: f64) -> Sites {
    let values = on_grid(poly);
    if values.iter().all(|value| value.abs() > noise) {
        return walk(poly, &values, noise, range);
    }
    isolate_turned(poly, noise, range)
}

/// As [`isolate`], for a polynomial with a root on a node of the grid.
#[cold]
fn isolate_turned<const M: usize>(poly: &TrigPolynomial<M>, noise: f64, range: f64) -> Sites {
    let mut best = (0.0, f64::NEG_INFINITY);
    for turn in 1..=10 {
        let angle = f64::from(turn) * TURN;
        let least = on_grid(&poly.turned(angle)).iter().fold(f64::INFINITY, |m, value| m.min(value.abs()));
        if least > best.1 {
            best = (angle, least);
        }
    }
    let turned = poly.turned(best.0);
    let mut sites = walk(&turned, &on_grid(&turned), noise, range + STEP);
    for site in &mut sites {
        match site {
            Site::Crossing { low, high, start: at } | Site::Touch { low, high, at } => {
                *low += best.0;
                *high += best.0;
                *at += best.0;
            }
        }
    }
    sites
}

fn walk<const M: usize>(poly: &TrigPolynomial<M>, values: &[f64; NODES], noise: f64, range: f64) -> Sites {
    let slopes = on_grid(&poly.derivative());
    let search = Search { poly, noise, fourth: poly.bound(4) };
    let slack = search.slack(0, STEP);
    let mut sites = Sites::new();
    for i in 0..NODES {
        let next = (i + 1) % NODES;
        let arc = Arc {
            low: node_angle(i),
            width: STEP,
            value: [values[i], values[next]],
            slope: [slopes[i], slopes[next]],
        };
        let inside =
            arc.low <= range && arc.low + STEP >= -range || arc.low + STEP >= std::f64::consts::TAU - range;
        if inside && one_sign(arc.control_points(), slack).is_none() {
            search.resolve(&arc, &mut sites);
        }
    }
    sites
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

    /// Where the interpolant of a monotone arc crosses zero, to about a thousandth of the arc.
    fn interpolated_root(&self) -> f64 {
        let [b0, b1, b2, b3] = self.control_points();
        let (c1, c2, c3) = (3.0 * (b1 - b0), 3.0 * (b2 - 2.0 * b1 + b0), b3 - b0 + 3.0 * (b1 - b2));
        let mut t = b0 / (b0 - b3);
        for _ in 0..3 {
            let value = b0 + t * (c1 + t * (c2 + t * c3));
            let slope = c1 + t * (2.0 * c2 + 3.0 * t * c3);
            t = (t - value / slope).clamp(0.0, 1.0);
        }
        // A flat interpolant divides by zero: the middle will do.
        if t.is_finite() { self.low + t * self.width } else { self.low + 0.5 * self.width }
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

    fn resolve(&self, arc: &Arc, sites: &mut Sites) {
        let [b0, b1, b2, b3] = arc.control_points();
        if one_sign([b0, b1, b2, b3], self.slack(0, arc.width)).is_some() {
            return;
        }
        let slopes = [arc.slope[0], 3.0 * (b2 - b1) / arc.width, arc.slope[1]];
        if one_sign(slopes, self.slack(1, arc.width)).is_some() {
            push(sites, arc.crossing());
            return;
        }
        let scale = 6.0 / (arc.width * arc.width);
        let curvatures = [scale * (b2 - 2.0 * b1 + b0), scale * (b3 - 2.0 * b2 + b1)];
        if let Some(bent) = one_sign(curvatures, self.slack(2, arc.width)) {
            if (arc.slope[0] < 0.0) == (arc.slope[1] < 0.0) {
                push(sites, arc.crossing());
            } else {
                self.around_extremum(arc, bent, sites);
            }
            return;
        }
        self.halves(arc, sites);
    }

    /// An arc of one curvature with its extremum inside.
    fn around_extremum(&self, arc: &Arc, bent: f64, sites: &mut Sites) {
        let (at, value) = self.extremum(arc);
        if value.abs() <= self.noise {
            push(sites, Some(Site::Touch { low: arc.low, high: arc.high(), at }));
        } else if value * bent < 0.0 {
            let left =
                Arc { width: at - arc.low, value: [arc.value[0], value], slope: [arc.slope[0], 0.0], ..*arc };
            let right = Arc {
                low: at,
                width: arc.high() - at,
                value: [value, arc.value[1]],
                slope: [0.0, arc.slope[1]],
            };
            push(sites, left.crossing());
            push(sites, right.crossing());
        }
    }

    /// Where the slope vanishes, by Newton's method kept inside the shrinking bracket, and the
    /// value there.
    fn extremum(&self, arc: &Arc) -> (f64, f64) {
        let (mut low, mut high) = (arc.low, arc.high());
        let rising = arc.slope[1] > arc.slope[0];
        let mut at = arc.low + arc.width * (arc.slope[0] / (arc.slope[0] - arc.slope[1]));
        let mut jet = self.poly.jet(at);
        for _ in 0..60 {
            if (jet.slope > 0.0) == rising {
                high = at;
            } else {
                low = at;
            }
            let newton = at - jet.slope / jet.curvature;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            let step = (next - at).abs();
            at = next;
            jet = self.poly.jet(at);
            if step <= 1e-12 {
                break;
            }
        }
        (at, jet.value)
    }

    fn halves(&self, arc: &Arc, sites: &mut Sites) {
        for part in SPLITS {
            let middle = arc.low + part * arc.width;
            let jet = self.poly.jet(middle);
            if arc.width > NARROWEST && jet.value.abs() > self.noise {
                let left = Arc {
                    width: middle - arc.low,
                    value: [arc.value[0], jet.value],
                    slope: [arc.slope[0], jet.slope],
                    ..*arc
                };
                let right = Arc {
                    low: middle,
                    width: arc.high() - middle,
                    value: [jet.value, arc.value[1]],
                    slope: [jet.slope, arc.slope[1]],
                };
                self.resolve(&left, sites);
                self.resolve(&right, sites);
                return;
            }
        }
        push(sites, Some(Site::Touch { low: arc.low, high: arc.high(), at: arc.low + 0.5 * arc.width }));
    }
}

/// Sites beyond the room of [`Sites`] would be more roots than the degree allows: rounding only.
fn push(sites: &mut Sites, site: Option<Site>) {
    if let Some(site) = site
        && !sites.is_full()
    {
        sites.push(site);
    }
}
