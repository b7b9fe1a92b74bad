//! Numbers that a formula can take: plain ones, those with derivatives, and ranges over a box.

use std::ops::{Add, Mul, Neg, Sub};

use crate::jet::Jet;

/// Number of coordinates of a configuration.
pub(super) const COORDINATES: usize = 5;

/// What the formulas of this module need.
pub(super) trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// The same number everywhere.
    fn constant(number: f64) -> Self;
    /// The product with a number.
    fn times(self, factor: f64) -> Self;
    /// The sum with a number.
    fn plus(self, number: f64) -> Self;
    /// The square.
    fn square(self) -> Self;
}

/// A number with its derivatives along the coordinates of a configuration.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dual {
    pub(super) value: f64,
    pub(super) slopes: [f64; COORDINATES],
}

impl Dual {
    /// A function of one coordinate, from its value and its derivative.
    pub(super) fn of(value: f64, slope: f64, axis: usize) -> Self {
        let mut slopes = [0.0; COORDINATES];
        slopes[axis] = slope;
        Self { value, slopes }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let slopes = std::array::from_fn(|i| self.slopes[i] + other.slopes[i]);
        Self { value: self.value + other.value, slopes }
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        let slopes = std::array::from_fn(|i| self.slopes[i] - other.slopes[i]);
        Self { value: self.value - other.value, slopes }
    }
}

impl Mul for Dual {
    type Output = Self;
    #[allow(clippy::suspicious_arithmetic_impl, reason = "the derivative of a product is a sum")]
    fn mul(self, other: Self) -> Self {
        let slopes = std::array::from_fn(|i| self.slopes[i] * other.value + self.value * other.slopes[i]);
        Self { value: self.value * other.value, slopes }
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        self.times(-1.0)
    }
}

impl Scalar for Dual {
    fn constant(number: f64) -> Self {
        Self { value: number, slopes: [0.0; COORDINATES] }
    }

    fn times(self, factor: f64) -> Self {
        Self { value: self.value * factor, slopes: self.slopes.map(|slope| slope * factor) }
    }

    fn plus(self, number: f64) -> Self {
        Self { value: self.value + number, ..self }
    }

    fn square(self) -> Self {
        self * self
    }
}

impl Scalar for f64 {
    fn constant(number: f64) -> Self {
        number
    }

    fn times(self, factor: f64) -> Self {
        self * factor
    }

    fn plus(self, number: f64) -> Self {
        self + number
    }

    fn square(self) -> Self {
        self * self
    }
}

impl Scalar for Jet {
    fn constant(number: f64) -> Self {
        Self::constant(number)
    }

    fn times(self, factor: f64) -> Self {
        self.times(factor)
    }

    fn plus(self, number: f64) -> Self {
        self.plus(number)
    }

    fn square(self) -> Self {
        self.square()
    }
}
