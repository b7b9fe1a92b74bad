//! Intervals of real numbers.
//!
//! The arithmetic does not round outwards. Code that compares a bound with zero allows for rounding errors.

use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::{Add, Mul, Neg, Sub};

use crate::fast_math::sin_cos;

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

impl Interval {
    pub(crate) const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    pub(crate) const ZERO: Self = Self { low: 0.0, high: 0.0 };
    pub(crate) const UNIT: Self = Self { low: 0.0, high: 1.0 };

    pub(crate) const fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    pub(crate) const fn of(number: f64) -> Self {
        Self { low: number, high: number }
    }

    pub(crate) const fn around(radius: f64) -> Self {
        Self { low: -radius, high: radius }
    }

    #[inline]
    pub(crate) fn plus(self, number: f64) -> Self {
        Self { low: self.low + number, high: self.high + number }
    }

    #[inline]
    pub(crate) fn times(self, factor: f64) -> Self {
        let (a, b) = (self.low * factor, self.high * factor);
        if factor < 0.0 { Self { low: b, high: a } } else { Self { low: a, high: b } }
    }

    #[inline]
    pub(crate) fn square(self) -> Self {
        let least = self.low.max(-self.high).max(0.0);
        let most = self.magnitude();
        Self { low: least * least, high: most * most }
    }

    /// Greatest absolute value.
    #[inline]
    pub(crate) fn magnitude(self) -> f64 {
        self.high.max(-self.low)
    }

    /// 1/x of numbers that are all positive.
    #[inline]
    pub(crate) fn reciprocal(self) -> Self {
        Self { low: 1.0 / self.high, high: 1.0 / self.low }
    }

    /// √x of the numbers that are not negative.
    #[inline]
    pub(crate) fn root(self) -> Self {
        Self { low: self.low.max(0.0).sqrt(), high: self.high.max(0.0).sqrt() }
    }

    #[inline]
    pub(crate) fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The numbers that are in both, if there are any.
    #[inline]
    pub(crate) fn intersection(self, other: Self) -> Option<Self> {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        if low > high { None } else { Some(Self { low, high }) }
    }

    #[inline]
    pub(crate) fn clamp(self, low: f64, high: f64) -> Self {
        Self { low: self.low.clamp(low, high), high: self.high.clamp(low, high) }
    }

    #[inline]
    pub(crate) fn middle(self) -> f64 {
        0.5 * (self.low + self.high)
    }

    /// cos x.
    #[inline]
    pub(crate) fn cosine(self) -> Self {
        let (first, last) = ((self.low / PI).ceil(), (self.high / PI).floor());
        let (a, b) = (sin_cos(self.low).1, sin_cos(self.high).1);
        let (mut low, mut high) = (a.min(b), a.max(b));
        if first <= last {
            let is_even = first.rem_euclid(2.0) == 0.0;
            if is_even || first < last {
                high = 1.0;
            }
            if !is_even || first < last {
                low = -1.0;
            }
        }
        Self { low, high }
    }

    /// sin x.
    #[inline]
    pub(crate) fn sine(self) -> Self {
        self.plus(-FRAC_PI_2).cosine()
    }

    /// The sign that all numbers have; 0 where they have both or may be zero.
    #[inline]
    pub(crate) fn sign(self) -> i8 {
        if self.low > 0.0 {
            1
        } else if self.high < 0.0 {
            -1
        } else {
            0
        }
    }
}

impl Add for Interval {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { low: self.low + other.low, high: self.high + other.high }
    }
}

impl Sub for Interval {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { low: self.low - other.high, high: self.high - other.low }
    }
}

impl Neg for Interval {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Mul for Interval {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let [a, b] = [self.low * other.low, self.low * other.high];
        let [c, d] = [self.high * other.low, self.high * other.high];
        Self { low: a.min(b).min(c.min(d)), high: a.max(b).max(c.max(d)) }
    }
}
