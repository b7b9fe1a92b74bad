//! Intervals of real numbers, and functions of (x, y) over a box: range and range of the gradient.
//!
//! The arithmetic does not round outwards. Code that compares a bound with zero allows for rounding errors.

use std::ops::{Add, Mul, Neg, Sub};

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Interval {
    pub(super) const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    pub(super) const ZERO: Self = Self { low: 0.0, high: 0.0 };
    pub(super) const UNIT: Self = Self { low: 0.0, high: 1.0 };

    pub(super) const fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    pub(super) const fn of(number: f64) -> Self {
        Self { low: number, high: number }
    }

    pub(super) const fn around(radius: f64) -> Self {
        Self { low: -radius, high: radius }
    }

    #[inline]
    pub(super) fn plus(self, number: f64) -> Self {
        Self { low: self.low + number, high: self.high + number }
    }

    #[inline]
    pub(super) fn times(self, factor: f64) -> Self {
        let (a, b) = (self.low * factor, self.high * factor);
        if factor < 0.0 { Self { low: b, high: a } } else { Self { low: a, high: b } }
    }

    #[inline]
    pub(super) fn square(self) -> Self {
        let least = self.low.max(-self.high).max(0.0);
        let most = self.magnitude();
        Self { low: least * least, high: most * most }
    }

    /// Greatest absolute value.
    #[inline]
    pub(super) fn magnitude(self) -> f64 {
        self.high.max(-self.low)
    }

    /// 1/x of numbers that are all positive.
    #[inline]
    pub(super) fn reciprocal(self) -> Self {
        Self { low: 1.0 / self.high, high: 1.0 / self.low }
    }

    /// √x of the numbers that are not negative.
    #[inline]
    pub(super) fn root(self) -> Self {
        Self { low: self.low.max(0.0).sqrt(), high: self.high.max(0.0).sqrt() }
    }

    #[inline]
    pub(super) fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The common part; empty (low > high) where there is none.
    #[inline]
    pub(super) fn common(self, other: Self) -> Self {
        Self { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    #[inline]
    pub(super) fn is_empty(self) -> bool {
        self.low > self.high
    }

    #[inline]
    pub(super) fn clamp(self, low: f64, high: f64) -> Self {
        Self { low: self.low.clamp(low, high), high: self.high.clamp(low, high) }
    }

    /// The sign that all numbers have; 0 where they have both or may be zero.
    #[inline]
    pub(super) fn sign(self) -> i8 {
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

/// A function over a box: its values, and its derivatives along x and y.
#[derive(Clone, Copy, Debug)]
pub(super) struct Jet {
    pub(super) value: Interval,
    pub(super) slopes: [Interval; 2],
}

impl Jet {
    /// The greater of two functions, and whether that may be the one here and the other there.
    pub(super) fn greater(self, other: Self) -> (Self, bool) {
        let (a, b) = (self.value, other.value);
        if a.low >= b.high {
            (self, false)
        } else if b.low >= a.high {
            (other, false)
        } else {
            let value = Interval::new(a.low.max(b.low), a.high.max(b.high));
            let slopes = [0, 1].map(|axis| self.slopes[axis].hull(other.slopes[axis]));
            (Self { value, slopes }, true)
        }
    }

    /// x or y itself.
    pub(super) fn coordinate(value: Interval, axis: usize) -> Self {
        let mut slopes = [Interval::ZERO; 2];
        slopes[axis] = Interval::of(1.0);
        Self { value, slopes }
    }

    #[inline]
    pub(super) fn plus(self, number: f64) -> Self {
        Self { value: self.value.plus(number), ..self }
    }

    #[inline]
    pub(super) fn times(self, factor: f64) -> Self {
        Self { value: self.value.times(factor), slopes: self.slopes.map(|slope| slope.times(factor)) }
    }

    #[inline]
    pub(super) fn square(self) -> Self {
        let slopes = self.slopes.map(|slope| (self.value * slope).times(2.0));
        Self { value: self.value.square(), slopes }
    }

    /// √f, or the root of `least`, a positive number, where f is less.
    #[inline]
    pub(super) fn root(self, least: f64) -> Self {
        let value = Interval::new(self.value.low.max(least), self.value.high.max(least)).root();
        let half = value.reciprocal().times(0.5);
        let slopes = self.slopes.map(|slope| {
            let slope = slope * half;
            if self.value.low < least { slope.hull(Interval::ZERO) } else { slope }
        });
        Self { value, slopes }
    }

    /// f/g of a g that is positive.
    #[inline]
    pub(super) fn over(self, other: Self) -> Self {
        let inverse = other.value.reciprocal();
        let value = self.value * inverse;
        let slopes = [0, 1].map(|axis| (self.slopes[axis] - value * other.slopes[axis]) * inverse);
        Self { value, slopes }
    }

    /// Intersects the values with the mean value form: the value at one point of the box, plus the gradient times
    /// `offsets`, the positions of the others relative to it.
    #[inline]
    pub(super) fn centred_at(self, value: f64, offsets: [Interval; 2]) -> Self {
        let change = self.slopes[0] * offsets[0] + self.slopes[1] * offsets[1];
        let common = self.value.common(change.plus(value));
        // Rounding may separate two enclosures of nearly the same number.
        Self { value: if common.is_empty() { self.value } else { common }, ..self }
    }
}

impl Add for Jet {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let slopes = [0, 1].map(|axis| self.slopes[axis] + other.slopes[axis]);
        Self { value: self.value + other.value, slopes }
    }
}

impl Sub for Jet {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        let slopes = [0, 1].map(|axis| self.slopes[axis] - other.slopes[axis]);
        Self { value: self.value - other.value, slopes }
    }
}

impl Neg for Jet {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { value: -self.value, slopes: self.slopes.map(Neg::neg) }
    }
}

impl Mul for Jet {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let slopes =
            [0, 1].map(|axis| (self.slopes[axis] * other.value).add(self.value * other.slopes[axis]));
        Self { value: self.value * other.value, slopes }
    }
}
