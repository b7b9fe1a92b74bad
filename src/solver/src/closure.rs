//! The loop closure as two equations in (a, w), regular where its eliminated polynomial is not.
//!
//! Both directions of the kinematics lead to the platform angle a and one length-like unknown w (w1 itself for the
//! inverse problem, λ = w1/u for the forward problem), with one equation linear in w and one quadratic. Eliminating w
//! gives a trigonometric polynomial whose factors are the two *sheets* w₊(a) and w₋(a). If both sheets have a root at
//! (nearly) the same angle (the symmetry plane; S = 2 rho1 - rho2 - rho3 ≈ 0), the polynomial has a (nearly) double
//! root that double precision cannot resolve, but (a, w) has two well separated, simple solutions. Only where one
//! sheet itself touches zero do two solutions merge: a singularity.

mod sheet;
mod touch;
mod window;

use std::f64::consts::{PI, TAU};

use arrayvec::ArrayVec;

use crate::angle::sin_cos;
use crate::circle::{Site, TrigPolynomial, isolate};
pub(crate) use sheet::{determinant, polish};

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
    /// Positive where the sheets exist, zero where they meet, negative where there are none.
    fn discriminant(&self, c: f64, s: f64) -> f64;
    /// Value below which the linear equation is satisfied within its rounding error.
    fn noise(&self, c: f64, s: f64, w: f64) -> f64;
    /// The Newton step at a root whose square, times the closure's curvature there, is negligible in double
    /// precision.
    fn last_step(&self, root: &Root) -> f64;
}

/// A solution of the loop closure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Root {
    /// The angle; within a turn of (-π, π].
    pub(crate) a: f64,
    /// Its cosine.
    pub(crate) c: f64,
    /// Its sine.
    pub(crate) s: f64,
    pub(crate) w: f64,
    /// Two solutions that double precision cannot tell apart.
    pub(crate) merged: bool,
}

impl Root {
    /// A start for Newton's method.
    #[inline]
    pub(crate) fn at(a: f64, [c, s]: [f64; 2], w: f64) -> Self {
        Self { a, c, s, w, merged: false }
    }

    /// The approximate angle between two solutions.
    #[inline]
    fn apart(&self, other: &Self) -> f64 {
        (self.c - other.c).abs() + (self.s - other.s).abs()
    }

    /// Whether it is the same solution, up to rounding.
    #[inline]
    fn is(&self, other: &Self) -> bool {
        self.apart(other) < SAME && (self.w - other.w).abs() <= 1e-6 * (self.w.abs() + other.w.abs())
    }

    /// The angle shifted by whole turns into an arc, if it lies there.
    #[inline]
    fn turned_into(&self, low: f64, high: f64) -> Option<f64> {
        [self.a, self.a + TAU, self.a - TAU].into_iter().find(|a| (low..=high).contains(a))
    }
}

/// All solutions of a loop closure.
pub(crate) type Roots = ArrayVec<Root, 8>;

/// [`Closure::last_step`] of a closure whose curvature is of the order of one.
pub(crate) const LAST_STEP: f64 = 3e-8;
/// Relative error of the polynomial's coefficients, with a wide margin. A touch is decided on the sheets, which is
/// always correct and only slower.
const NOISE: f64 = 1e-10;
/// Steps on the polynomial alone: a few of Newton's, or as many bisections as a double has bits.
const APPROACH: usize = 60;
/// Angle within which two roots of one closure are the same root found twice.
const SAME: f64 = 1e-9;
/// Angle within which Newton's method may end beside a double root.
const BESIDE: f64 = 1e-5;

/// The solution that Newton's method finds from the level platform on the sheet w₊: the working
/// mode's only basin in practice.
#[inline]
pub(crate) fn from_level<const M: usize, C: Closure<M>>(closure: &C) -> Option<Root> {
    let [w, _] = closure.sheets(1.0, 0.0)?;
    polish(closure, Root::at(0.0, [1.0, 0.0], w))
}

/// Finds all solutions with |a| <= range. `known`, if given, is one of them; it is kept as it is, to the last bit.
#[inline]
pub(crate) fn find_roots<const M: usize, C: Closure<M>>(
    closure: &C,
    range: f64,
    known: Option<Root>,
    found: &mut Roots,
) {
    let (poly, magnitude) = closure.polynomial();
    // The known solution until it is met.
    let mut sought = known;
    isolate(&poly, NOISE * magnitude, range, &mut |site| match site {
        Site::Crossing { low, high, start } => {
            let met = sought.take_if(|known| known.turned_into(low, high).is_some());
            add(found, met.unwrap_or_else(|| alone(closure, &poly, [low, high], start)));
        }
        Site::Pair { low, high, at } => {
            let beside = sought.and_then(|known| sheet::beside(closure, [low, high], at, &known));
            if let (Some(other), Some(known)) = (beside, sought) {
                sought = None;
                add(found, known);
                add(found, other);
                return;
            }
            let pair = sheet::either_side(closure, [low, high], at).unwrap_or_else(|| {
                let left = alone(closure, &poly, [low, at], 0.5 * (low + at));
                [left, alone(closure, &poly, [at, high], 0.5 * (at + high))]
            });
            for root in pair {
                add(found, sought.filter(|known| known.is(&root)).unwrap_or(root));
            }
        }
        Site::Touch { low, high, at } => {
            let first = found.len();
            touch::add_roots(closure, [low, high], at, found);
            for root in &mut found[first..] {
                *root = known.filter(|known| known.is(root)).unwrap_or(*root);
            }
        }
    });
    if let Some(known) = sought {
        add_unmet(known, found);
    }
}

/// Adds the known solution, unless a touch produced it. Newton's method converges slowly to two merged solutions; a
/// result next to them is not another solution.
#[cold]
fn add_unmet(known: Root, found: &mut Roots) {
    if !found.iter().any(|root| root.merged && root.apart(&known) < BESIDE) {
        add(found, known);
    }
}

/// The root of a bracket that holds one.
fn alone<const M: usize, C: Closure<M>>(
    closure: &C,
    poly: &TrigPolynomial<M>,
    bracket: [f64; 2],
    start: f64,
) -> Root {
    sheet::root_between(closure, bracket, start).unwrap_or_else(|| {
        let near = approached(poly, bracket, start);
        sheet::root_between(closure, bracket, near).unwrap_or_else(|| at_angle(closure, near))
    })
}

/// The root in a bracket on the polynomial alone, by Newton's method kept inside the shrinking
/// bracket: for a root so near to another that only its own angle tells their w apart.
#[cold]
fn approached<const M: usize>(poly: &TrigPolynomial<M>, [mut low, mut high]: [f64; 2], start: f64) -> f64 {
    let rising = poly.at(low).value < 0.0;
    let mut a = start;
    for _ in 0..APPROACH {
        let jet = poly.at(a);
        if (jet.value < 0.0) == rising {
            low = a;
        } else {
            high = a;
        }
        let newton = a - jet.value / jet.slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let step = (next - a).abs();
        a = next;
        if step <= 1e-15 {
            break;
        }
    }
    a
}

/// A root as the polynomial gives it.
#[cold]
fn at_angle<const M: usize, C: Closure<M>>(closure: &C, a: f64) -> Root {
    let (s, c) = sin_cos(a);
    Root::at(a, [c, s], closure.w_at_root(c, s))
}

fn add(roots: &mut Roots, root: Root) {
    if !roots.iter().any(|other| other.is(&root)) && !roots.is_full() {
        roots.push(root);
    }
}

/// The angle in (-π, π].
#[inline]
pub(crate) fn wrapped(a: f64) -> f64 {
    if a > PI {
        a - TAU
    } else if a <= -PI {
        a + TAU
    } else {
        a
    }
}
