//! The square of leg I's height w1, precise enough for a leg that is nearly level.
//!
//! E + k = L1² - X1² - (R1 - r1)² is w1² + y² at a = 0, and E - k = L1² - X1² - (R1 + r1)² the same at a = π. In
//! double precision each has the rounding error of L1². If the value itself is small, that error would decide whether
//! the leg reaches at all.

use crate::mechanism::Mechanism;

/// E + k at a given x, mm², in double precision.
#[inline(always)]
pub(super) fn rounded_square_at_zero(mechanism: &Mechanism, x: f64) -> f64 {
    let x1 = x + mechanism.e1;
    let length = mechanism.geometry.L1;
    (length - x1) * (length + x1) - mechanism.gap_square
}

/// E - k, mm², in double precision, from E + k.
#[inline(always)]
pub(super) fn rounded_square_at_pi(mechanism: &Mechanism, at_zero: f64) -> f64 {
    at_zero - 2.0 * mechanism.k
}

/// E + k at a given x, mm².
#[inline]
pub(super) fn square_at_zero(mechanism: &Mechanism, x: f64) -> f64 {
    let found = rounded_square_at_zero(mechanism, x);
    if is_nearly_level(mechanism, found) { precise_square(mechanism, x, -1.0) } else { found }
}

/// E - k at a given x, mm², from E + k.
#[inline]
pub(super) fn square_at_pi(mechanism: &Mechanism, x: f64, at_zero: f64) -> f64 {
    let found = rounded_square_at_pi(mechanism, at_zero);
    if is_nearly_level(mechanism, found) { precise_square(mechanism, x, 1.0) } else { found }
}

/// Whether the value is so small that leg I may be level.
#[inline(always)]
pub(super) fn is_nearly_level(mechanism: &Mechanism, square: f64) -> bool {
    square.abs() <= mechanism.nearly_level
}

/// L1² - X1² - (R1 + `sign` r1)² from the machine's own numbers, with about twice the digits of a double: sums and
/// products are computed with their rounding errors.
#[cold]
fn precise_square(mechanism: &Mechanism, x: f64, sign: f64) -> f64 {
    let g = &mechanism.geometry;
    let (e1, e1_rest) = sum(g.D1, -g.d1);
    let (x1, x1_rest) = sum(x, e1);
    let x1_rest = x1_rest + e1_rest;
    let (shorter, shorter_rest) = sum(g.L1, -x1);
    let (longer, longer_rest) = sum(g.L1, x1);
    let (reach, reach_rest) = product([shorter, shorter_rest - x1_rest], [longer, longer_rest + x1_rest]);
    let (arm, arm_rest) = sum(g.R1, sign * g.r1);
    let (square, square_rest) = product([arm, arm_rest], [arm, arm_rest]);
    let (left, left_rest) = sum(reach, -square);
    left + (left_rest + (reach_rest - square_rest))
}

/// √x with the sign of x: a length that changes its sign with x.
pub(super) fn signed_root(x: f64) -> f64 {
    x.abs().sqrt().copysign(x)
}

/// a + b and its rounding error.
fn sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let rounded_b = sum - a;
    (sum, (a - (sum - rounded_b)) + (b - rounded_b))
}

/// The product of two numbers that are each given with a remainder, and its own remainder.
fn product([a, a_rest]: [f64; 2], [b, b_rest]: [f64; 2]) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product) + (a * b_rest + a_rest * b))
}
