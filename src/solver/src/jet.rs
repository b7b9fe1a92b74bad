//! Functions of two coordinates over a box: range and range of the gradient.

use std::ops::{Add, Mul, Neg, Sub};

use crate::interval::Interval;

/// A function over a box: its values, and its derivatives along both coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Jet {
    pub(crate) value: Interval,
    pub(crate) slopes: [Interval; 2],
}

impl Jet {
    /// A function of which nothing is known.
    pub(crate) const UNKNOWN: Self = Self { value: Interval::ALL, slopes: [Interval::ALL; 2] };

    /// The same number all over the box.
    pub(crate) const fn constant(number: f64) -> Self {
        Self { value: Interval::of(number), slopes: [Interval::ZERO; 2] }
    }

    /// The range of values and gradients that contains those of both.
    pub(crate) fn hull(self, other: Self) -> Self {
        let slopes = [0, 1].map(|axis| self.slopes[axis].hull(other.slopes[axis]));
        Self { value: self.value.hull(other.value), slopes }
    }

    /// The greater of two functions, and whether that may be the one here and the other there.
    pub(crate) fn greater(self, other: Self) -> (Self, bool) {
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

    /// A coordinate itself.
    pub(crate) fn coordinate(value: Interval, axis: usize) -> Self {
        let mut slopes = [Interval::ZERO; 2];
        slopes[axis] = Interval::of(1.0);
        Self { value, slopes }
    }

    #[inline]
    pub(crate) fn plus(self, number: f64) -> Self {
        Self { value: self.value.plus(number), ..self }
    }

    #[inline]
    pub(crate) fn times(self, factor: f64) -> Self {
        Self { value: self.value.times(factor), slopes: self.slopes.map(|slope| slope.times(factor)) }
    }

    #[inline]
    pub(crate) fn square(self) -> Self {
        let slopes = self.slopes.map(|slope| (self.value * slope).times(2.0));
        Self { value: self.value.square(), slopes }
    }

    /// √f, or the root of `least`, a positive number, where f is less.
    #[inline]
    pub(crate) fn root(self, least: f64) -> Self {
        let value = Interval::new(self.value.low.max(least), self.value.high.max(least)).root();
        let half = value.reciprocal().times(0.5);
        let slopes = self.slopes.map(|slope| {
            let slope = slope * half;
            if self.value.low < least { slope.hull(Interval::ZERO) } else { slope }
        });
        Self { value, slopes }
    }

    /// cos f and sin f.
    #[inline]
    pub(crate) fn cosine_and_sine(self) -> [Self; 2] {
        let (c, s) = (self.value.cosine(), self.value.sine());
        let cosine = Self { value: c, slopes: self.slopes.map(|slope| -(slope * s)) };
        [cosine, Self { value: s, slopes: self.slopes.map(|slope| slope * c) }]
    }

    /// f/g of a g that is positive.
    #[inline]
    pub(crate) fn over(self, other: Self) -> Self {
        let inverse = other.value.reciprocal();
        let value = self.value * inverse;
        let slopes = [0, 1].map(|axis| (self.slopes[axis] - value * other.slopes[axis]) * inverse);
        Self { value, slopes }
    }

    /// Intersects the values with the mean value form: the value at one point of the box, plus the gradient times
    /// `offsets`, the positions of the others relative to it.
    #[inline]
    pub(crate) fn centred_at(self, value: f64, offsets: [Interval; 2]) -> Self {
        let change = self.slopes[0] * offsets[0] + self.slopes[1] * offsets[1];
        // Rounding may separate two enclosures of nearly the same number.
        Self { value: self.value.intersection(change.plus(value)).unwrap_or(self.value), ..self }
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
