//! The loop closure as two equations in (a, w), regular where its eliminated polynomial is not.
//!
//! Both directions of the kinematics come down to the platform angle a and one length-like
//! unknown w (w1 itself for the inverse, λ = w1/u for the forward question) with one equation
//! linear in w and one quadratic. Eliminating w gives a trigonometric polynomial whose factors
//! are the two *sheets* w₊(a) and w₋(a). Where both sheets have a root at (nearly) the same angle
//! (the symmetry plane; S = 2 rho1 - rho2 - rho3 ≈ 0) the polynomial has a (nearly) double root
//! that double precision cannot resolve, but (a, w) are two well separated, simple solutions.
//! Only where one sheet itself touches zero do two solutions really merge: a singularity.

mod sheet;
mod touch;

use std::f64::consts::PI;

use arrayvec::ArrayVec;

use crate::circle::{Site, TrigPolynomial, isolate};

/// Two equations f = 0 in (a, w) and their derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Equations {
    pub(crate) f: [f64; 2],
    pub(crate) da: [f64; 2],
    pub(crate) dw: [f64; 2],
}

/// A loop closure with its eliminated polynomial of degree M - 1.
pub(crate) trait Closure<const M: usize> {
    /// The eliminated polynomial and a bound of its rounding error's scale.
    fn polynomial(&self) -> (TrigPolynomial<M>, f64);
    /// The equations at the angle of cosine `c` and sine `s`.
    fn equations(&self, c: f64, s: f64, w: f64) -> Equations;
    /// w₊ and w₋ at an angle; `None` where the quadratic has no real root.
    fn sheets(&self, c: f64, s: f64) -> Option<[f64; 2]>;
    /// w at a simple root of the polynomial, from the equation linear in w where it determines w.
    fn w_at_root(&self, c: f64, s: f64) -> f64;
    /// The magnitude of w that counts as one.
    fn unit(&self) -> f64;
}

/// A solution of the loop closure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Root {
    pub(crate) c: f64,
    pub(crate) s: f64,
    pub(crate) w: f64,
    /// Two solutions that double precision cannot tell apart.
    pub(crate) merged: bool,
}

/// All solutions of a loop closure.
pub(crate) type Roots = ArrayVec<Root, 8>;

/// Relative error of the polynomial's coefficients, with a wide margin: a touch is decided on the
/// sheets, which is always right and only slower.
const NOISE: f64 = 1e-10;
/// Newton steps on the polynomial; one or two are usual.
const APPROACH: usize = 8;
/// Step, relative to the distance from the bracket's ends, after which w is right to a percent.
const NEAR: f64 = 0.03;
/// Angle within which two roots of one closure count as found twice.
const SAME: f64 = 1e-9;

/// All solutions with |a| <= range and the sheet wanted (`Some(sign of w)`), or of both sheets.
#[inline]
pub(crate) fn roots<const M: usize, C: Closure<M>>(closure: &C, range: f64, wanted: Option<f64>) -> Roots {
    let (poly, magnitude) = closure.polynomial();
    let mut roots = Roots::new();
    for site in isolate(&poly, NOISE * magnitude, range) {
        match site {
            Site::Crossing { low, high, start } => {
                if let Some(root) = crossing(closure, &poly, [low, high], start, wanted) {
                    add(&mut roots, root);
                }
            }
            Site::Touch { low, high, at } => {
                touch::roots(closure, [low, high], at).into_iter().for_each(|root| add(&mut roots, root));
            }
        }
    }
    roots
}

/// The simple root of the polynomial in a bracket, polished on the loop closure.
#[inline]
fn crossing<const M: usize, C: Closure<M>>(
    closure: &C,
    poly: &TrigPolynomial<M>,
    bracket: [f64; 2],
    start: f64,
    wanted: Option<f64>,
) -> Option<Root> {
    let (c, s) = approached(poly, bracket, start);
    let w = closure.w_at_root(c, s);
    if wanted.is_some_and(|sign| w * sign < 0.0) {
        return None;
    }
    let polished = sheet::polish(closure, Root { c, s, w, merged: false });
    if let Some(root) = polished.filter(|root| within(root, bracket)) {
        return Some(root);
    }
    let (s, c) = bisected(poly, bracket).sin_cos();
    let root = Root { c, s, w: closure.w_at_root(c, s), merged: false };
    Some(sheet::polish(closure, root).filter(|root| within(root, bracket)).unwrap_or(root))
}

/// Newton's method on the polynomial until the root is known to a fraction of its distance from
/// the bracket's ends: one of them may be another root's neighbour, and w must be this one's.
#[inline]
fn approached<const M: usize>(poly: &TrigPolynomial<M>, [low, high]: [f64; 2], start: f64) -> (f64, f64) {
    let mut a = start;
    let (mut s, mut c) = a.sin_cos();
    for _ in 0..APPROACH {
        let (value, slope) = poly.value_slope(c, s);
        let next = a - value / slope;
        if !(next > low && next < high) {
            let (s, c) = bisected(poly, [low, high]).sin_cos();
            return (c, s);
        }
        let step = next - a;
        (c, s) = rotated(c, s, step);
        a = next;
        if step.abs() <= NEAR * (a - low).min(high - a) {
            break;
        }
    }
    (c, s)
}

/// The root in a bracket to the last digit, on the polynomial alone: slow and sure.
#[cold]
fn bisected<const M: usize>(poly: &TrigPolynomial<M>, [mut low, mut high]: [f64; 2]) -> f64 {
    let rising = poly.jet(low).value < 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (poly.jet(middle).value < 0.0) == rising { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Whether a root lies in a bracket, give or take a tenth of it and the rounding.
#[inline]
fn within(root: &Root, [low, high]: [f64; 2]) -> bool {
    // The rotation into the bracket's middle needs no arc tangent: compare cosines of half-angles.
    let (middle, reach) = (0.5 * (low + high), 0.55 * (high - low) + 1e-9);
    let (s, c) = middle.sin_cos();
    let chord = (root.c - c).hypot(root.s - s);
    chord <= reach
}

fn add(roots: &mut Roots, root: Root) {
    let found = roots.iter().any(|other| {
        (other.c - root.c).abs() + (other.s - root.s).abs() < SAME
            && other.w * root.w >= 0.0
            && (other.w - root.w).abs() <= 1e-6 * (other.w.abs() + root.w.abs())
    });
    if !found && !roots.is_full() {
        roots.push(root);
    }
}

/// The angle of a direction, in (-π, π].
#[inline]
pub(crate) fn angle_of(c: f64, s: f64) -> f64 {
    let a = s.atan2(c);
    if a <= -PI { PI } else { a }
}

/// The direction (c, s) turned by `angle`, up to the third order of it, kept on the circle.
#[inline]
fn rotated(c: f64, s: f64, angle: f64) -> (f64, f64) {
    // tan(angle/2) ≈ t: the rational rotation is exact in norm, and its angle right to O(angle³).
    let t = 0.5 * angle;
    let scale = 1.0 / (1.0 + t * t);
    let (cd, sd) = ((1.0 - t * t) * scale, 2.0 * t * scale);
    (c * cd - s * sd, s * cd + c * sd)
}
