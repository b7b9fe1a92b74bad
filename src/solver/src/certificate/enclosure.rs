//! Intervals that contain every real number that they stand for: each operation rounds outwards.

use std::ops::{Add, Mul, Neg, Sub};

use crate::fast_math::{greater, lesser};

/// Bounds nearer to zero are moved to this distance: arithmetic with subnormal numbers is slow.
const LEAST: f64 = 1e-280;
/// Least divisor. All other numbers are below 1e60, so no quotient and no product of quotients overflows.
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
    if rounded.abs() < LEAST { -LEAST } else { rounded.next_down() }
}

/// A number that is not below it.
#[inline(always)]
fn above(rounded: f64) -> f64 {
    if rounded.abs() < LEAST { LEAST } else { rounded.next_up() }
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
