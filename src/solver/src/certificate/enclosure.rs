//! Intervals that contain every real number that they stand for: each operation rounds outwards.

use std::ops::{Add, Mul, Neg, Sub};

use crate::fast_math::{greater, lesser};

/// A bound moves by this distance at least: arithmetic with subnormal numbers is slow.
const LEAST: f64 = 1e-280;
/// u (1 + 2u) with u = 2^-53. A number less this part of its magnitude and a positive number is not above the double
/// before it (S. M. Rump, P. Zimmermann, S. Boldo, G. Melquiond, 2009, [doi:10.1007/s10543-009-0218-z][rump]).
/// `f64::next_down` does the same in twice the time.
///
/// [rump]: https://doi.org/10.1007/s10543-009-0218-z
const STEP: f64 = 0.5 * f64::EPSILON * (1.0 + f64::EPSILON);
/// Least divisor. All other numbers are below 1e60, so no quotient and no product of quotients overflows: no bound is
/// ever infinite or not a number.
const LEAST_DIVISOR: f64 = 1e-60;

/// All real numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Enclosure {
    pub(super) low: f64,
    pub(super) high: f64,
}

/// A number that is not above the real number of which `rounded` is the nearest double.
#[inline(always)]
fn below(rounded: f64) -> f64 {
    rounded - (rounded.abs() * STEP + LEAST)
}

/// A number that is not below it.
#[inline(always)]
fn above(rounded: f64) -> f64 {
    rounded + (rounded.abs() * STEP + LEAST)
}

/// Whether the numbers of a matrix can be multiplied with enclosures.
pub(super) fn are_moderate<const N: usize>(matrix: &[[f64; N]; N]) -> bool {
    matrix.as_flattened().iter().all(|number| number.abs() < 1.0 / LEAST_DIVISOR)
}

impl Enclosure {
    pub(super) const ZERO: Self = Self { low: 0.0, high: 0.0 };
    pub(super) const ONE: Self = Self { low: 1.0, high: 1.0 };
    /// π: the nearest double lies below it.
    pub(super) const PI: Self = Self { low: std::f64::consts::PI, high: std::f64::consts::PI.next_up() };

    #[inline(always)]
    pub(super) const fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    #[inline(always)]
    pub(super) const fn of(number: f64) -> Self {
        Self { low: number, high: number }
    }

    /// All numbers within a distance of zero.
    #[inline(always)]
    pub(super) const fn around(radius: f64) -> Self {
        Self { low: -radius, high: radius }
    }

    #[inline(always)]
    fn rounded(low: f64, high: f64) -> Self {
        Self { low: below(low), high: above(high) }
    }

    #[inline(always)]
    pub(super) fn times(self, factor: f64) -> Self {
        let (a, b) = (self.low * factor, self.high * factor);
        if factor < 0.0 { Self::rounded(b, a) } else { Self::rounded(a, b) }
    }

    #[inline(always)]
    pub(super) fn square(self) -> Self {
        let (least, most) = (self.low.max(-self.high).max(0.0), self.magnitude());
        Self { low: below(least * least).max(0.0), high: above(most * most) }
    }

    /// √x of the numbers that are not negative. `None` if all are negative.
    #[inline]
    pub(super) fn root(self) -> Option<Self> {
        let low = below(self.low.max(0.0).sqrt()).max(0.0);
        (self.high >= 0.0).then(|| Self { low, high: above(self.high.sqrt()) })
    }

    /// 1/x of numbers of one sign. `None` if zero, or nearly so, is among them.
    #[inline]
    pub(super) fn reciprocal(self) -> Option<Self> {
        let least = self.low.max(-self.high);
        (least > LEAST_DIVISOR).then(|| Self::rounded(1.0 / self.high, 1.0 / self.low))
    }

    /// All numbers within a distance of these.
    #[inline(always)]
    pub(super) fn widened(self, distance: f64) -> Self {
        Self::rounded(self.low - distance, self.high + distance)
    }

    /// Greatest absolute value.
    #[inline(always)]
    pub(super) fn magnitude(self) -> f64 {
        self.high.max(-self.low)
    }

    #[inline(always)]
    pub(super) fn middle(self) -> f64 {
        0.5 * (self.low + self.high)
    }

    #[inline(always)]
    pub(super) fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Whether all numbers have one sign and none is zero.
    #[inline(always)]
    pub(super) fn excludes_zero(self) -> bool {
        self.low > 0.0 || self.high < 0.0
    }

    /// Whether both have a number in common.
    #[inline(always)]
    pub(super) fn meets(self, other: Self) -> bool {
        self.low <= other.high && other.low <= self.high
    }

    /// Whether all numbers of the other one are inside, none on the bounds.
    #[inline(always)]
    pub(super) fn strictly_contains(self, other: Self) -> bool {
        self.low < other.low && other.high < self.high
    }

    #[inline(always)]
    pub(super) fn contains(self, other: Self) -> bool {
        self.low <= other.low && other.high <= self.high
    }
}

impl From<f64> for Enclosure {
    #[inline(always)]
    fn from(number: f64) -> Self {
        Self::of(number)
    }
}

impl Add for Enclosure {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::rounded(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Enclosure {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::rounded(self.low - other.high, self.high - other.low)
    }
}

impl Neg for Enclosure {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Mul for Enclosure {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let [a, b] = [self.low * other.low, self.low * other.high];
        let [c, d] = [self.high * other.low, self.high * other.high];
        Self::rounded(lesser(lesser(a, b), lesser(c, d)), greater(greater(a, b), greater(c, d)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of all magnitudes and signs.
    fn numbers() -> impl Iterator<Item = f64> {
        (0..20_000_u32).map(|i| {
            let fraction = (f64::from(i) * 0.618_033_988_749_895).fract() - 0.5;
            fraction * 10.0_f64.powi((i % 61).cast_signed() - 30)
        })
    }

    #[test]
    fn a_bound_moves_to_the_next_double_or_further() {
        for number in numbers().chain([0.0, -0.0, 1.0, -1.0, f64::MIN_POSITIVE, 5e-324, 2.0_f64.powi(40)]) {
            assert!(below(number) <= number.next_down() && above(number) >= number.next_up(), "{number}");
            assert!(below(number) >= number - 3.0 * (number - number.next_down()) - LEAST, "{number}");
        }
    }

    #[test]
    fn results_contain_those_of_numbers_inside() {
        let samples = |x: Enclosure| [x.low, x.middle(), x.high];
        let intervals = |shift: usize| {
            numbers()
                .skip(shift)
                .zip(numbers().skip(shift + 7))
                .map(|(a, b)| Enclosure::new(a.min(b), a.max(b)))
        };
        for (x, y) in intervals(0).zip(intervals(3)).take(5_000) {
            for a in samples(x) {
                for b in samples(y) {
                    let inside = |range: Enclosure, number: f64| range.low < number && number < range.high;
                    assert!(
                        inside(x + y, a + b) && inside(x - y, a - b) && inside(x * y, a * b),
                        "{x:?} {y:?}"
                    );
                    assert!(
                        inside(x.times(b), a * b) && x.square().contains(Enclosure::of(a * a)),
                        "{x:?} {b}"
                    );
                }
                assert!(
                    x.reciprocal().is_none_or(|inverse| inverse.contains(Enclosure::of(1.0 / a))),
                    "{x:?}"
                );
                assert!(
                    a < 0.0 || x.root().is_some_and(|root| root.contains(Enclosure::of(a.sqrt()))),
                    "{x:?}"
                );
            }
            assert_eq!(x.reciprocal().is_some(), x.excludes_zero(), "{x:?}");
            assert_eq!(x.root().is_some(), x.high >= 0.0, "{x:?}");
        }
    }
}
