//! The search for all roots of a loop closure.

use super::branch::{both_of_pair, other_of_pair, root_between};
use super::double_root;
use super::equations::{LoopClosure, Root, Roots, add};
use crate::fast_math::sin_cos;
use crate::trig_polynomial::{ArcRoots, RootArc, TrigPolynomial, isolate_roots};

/// Relative error of the polynomial's coefficients, with a wide margin. A near double root is decided on the
/// branches, which is always correct and only slower.
const RELATIVE_NOISE: f64 = 1e-10;
/// Steps on the polynomial alone: a few of Newton's, or as many bisections as a double has bits.
const POLYNOMIAL_STEPS: usize = 60;
/// Angle within which Newton's method may end beside a double root.
const NEAR_MERGED: f64 = 1e-5;

/// Finds all solutions with |a| <= range. `known`, if given, is one of them; the answer contains it unchanged, to the
/// last bit.
#[inline]
pub(crate) fn find_roots<const M: usize, C: LoopClosure<M>>(
    closure: &C,
    range: f64,
    known: Option<Root>,
    found: &mut Roots,
) {
    let (poly, magnitude) = closure.polynomial();
    // The known solution until its arc is reached.
    let mut pending = known;
    isolate_roots(&poly, RELATIVE_NOISE * magnitude, range, &mut |RootArc { low, high, at, roots }| {
        match roots {
            ArcRoots::One => {
                let reached = pending.take_if(|known| known.angle_within(low, high).is_some());
                add(found, reached.unwrap_or_else(|| single_root(closure, &poly, [low, high], at)));
            }
            ArcRoots::Two => {
                let other = pending.and_then(|known| other_of_pair(closure, [low, high], at, &known));
                if let (Some(other), Some(known)) = (other, pending) {
                    pending = None;
                    add(found, known);
                    add(found, other);
                    return;
                }
                let pair = both_of_pair(closure, [low, high], at).unwrap_or_else(|| {
                    let left = single_root(closure, &poly, [low, at], 0.5 * (low + at));
                    [left, single_root(closure, &poly, [at, high], 0.5 * (at + high))]
                });
                for root in pair {
                    add(found, pending.filter(|known| known.coincides(&root)).unwrap_or(root));
                }
            }
            ArcRoots::NearDouble => {
                let first = found.len();
                double_root::add_roots(closure, [low, high], at, found);
                for root in &mut found[first..] {
                    *root = known.filter(|known| known.coincides(root)).unwrap_or(*root);
                }
            }
        }
    });
    if let Some(known) = pending {
        add_pending(known, found);
    }
}

/// Adds the known solution, unless a near double root produced it. Newton's method converges slowly to two merged
/// solutions; a result next to them is not another solution.
#[cold]
fn add_pending(known: Root, found: &mut Roots) {
    if !found.iter().any(|root| root.merged && root.angle_to(&known) < NEAR_MERGED) {
        add(found, known);
    }
}

/// The root of a bracket that holds one.
fn single_root<const M: usize, C: LoopClosure<M>>(
    closure: &C,
    poly: &TrigPolynomial<M>,
    bracket: [f64; 2],
    start: f64,
) -> Root {
    root_between(closure, bracket, start).unwrap_or_else(|| {
        let near = polynomial_root(poly, bracket, start);
        root_between(closure, bracket, near).unwrap_or_else(|| {
            let (s, c) = sin_cos(near);
            Root::at(near, [c, s], closure.w_at_root(c, s))
        })
    })
}

/// The root in a bracket on the polynomial alone, by Newton's method inside the shrinking
/// bracket: for a root so near to another that only its own angle tells their w apart.
#[cold]
fn polynomial_root<const M: usize>(
    poly: &TrigPolynomial<M>,
    [mut low, mut high]: [f64; 2],
    start: f64,
) -> f64 {
    let rising = poly.at(low).value < 0.0;
    let mut a = start;
    for _ in 0..POLYNOMIAL_STEPS {
        let point = poly.at(a);
        if (point.value < 0.0) == rising {
            low = a;
        } else {
            high = a;
        }
        let newton = a - point.value / point.slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let step = (next - a).abs();
        a = next;
        if step <= 1e-15 {
            break;
        }
    }
    a
}
