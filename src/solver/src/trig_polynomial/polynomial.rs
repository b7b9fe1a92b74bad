//! Trigonometric polynomials in the Fourier basis.

use std::ops::{Add, Mul, Sub};

use crate::fast_math::sin_cos;

/// A coefficient: a number, or an interval that contains it.
pub(crate) trait Coefficient:
    Copy + From<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
}

impl<T> Coefficient for T where
    T: Copy + From<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
}

/// `cos[0] + Σ (cos[n] cos nθ + sin[n] sin nθ)` of degree M - 1; `sin[0]` is zero.
///
/// The Fourier basis keeps products exact in form, is invariant under rotation, and bounds every
/// derivative by its coefficients alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TrigPolynomial<const M: usize, T = f64> {
    pub(crate) cos: [T; M],
    pub(crate) sin: [T; M],
}

/// Value and slope at one angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ValueAndSlope {
    pub(crate) value: f64,
    pub(crate) slope: f64,
}

/// `constant + cos · cos θ + sin · sin θ`.
#[inline(always)]
pub(crate) fn linear<T: Coefficient>(constant: T, cos: T, sin: T) -> TrigPolynomial<2, T> {
    TrigPolynomial { cos: [constant, cos], sin: [T::from(0.0), sin] }
}

impl<T: Coefficient> TrigPolynomial<2, T> {
    /// The product of two polynomials of the first degree.
    #[inline]
    pub(crate) fn times(&self, other: &Self) -> TrigPolynomial<3, T> {
        let ([a0, a1], [_, b1]) = (self.cos, self.sin);
        let ([c0, c1], [_, d1]) = (other.cos, other.sin);
        let half = T::from(0.5);
        let (cc, ss) = (half * a1 * c1, half * b1 * d1);
        TrigPolynomial {
            cos: [a0 * c0 + cc + ss, a0 * c1 + a1 * c0, cc - ss],
            sin: [T::from(0.0), a0 * d1 + b1 * c0, half * (a1 * d1 + b1 * c1)],
        }
    }
}

impl<T: Coefficient> TrigPolynomial<3, T> {
    /// The product with `constant + cos · cos θ`.
    #[inline]
    pub(crate) fn times_even(&self, constant: T, cos: T) -> TrigPolynomial<4, T> {
        let ([a0, a1, a2], [_, b1, b2]) = (self.cos, self.sin);
        let half = T::from(0.5) * cos;
        TrigPolynomial {
            cos: [
                constant * a0 + half * a1,
                constant * a1 + cos * a0 + half * a2,
                constant * a2 + half * a1,
                half * a2,
            ],
            sin: [T::from(0.0), constant * b1 + half * b2, constant * b2 + half * b1, half * b2],
        }
    }

    /// The square.
    #[inline]
    pub(crate) fn squared(&self) -> TrigPolynomial<5, T> {
        let ([a0, a1, a2], [_, b1, b2]) = (self.cos, self.sin);
        let [half, two] = [0.5, 2.0].map(T::from);
        let (even1, even2) = (half * (a1 * a1 + b1 * b1), half * (a2 * a2 + b2 * b2));
        TrigPolynomial {
            cos: [
                a0 * a0 + even1 + even2,
                two * a0 * a1 + a1 * a2 + b1 * b2,
                two * a0 * a2 + half * (a1 * a1 - b1 * b1),
                a1 * a2 - b1 * b2,
                half * (a2 * a2 - b2 * b2),
            ],
            sin: [
                T::from(0.0),
                two * a0 * b1 + a1 * b2 - a2 * b1,
                two * a0 * b2 + a1 * b1,
                a1 * b2 + a2 * b1,
                a2 * b2,
            ],
        }
    }
}

impl<const M: usize, T: Coefficient> TrigPolynomial<M, T> {
    /// `self + factor · other`.
    #[inline]
    pub(crate) fn plus(mut self, factor: T, other: &Self) -> Self {
        for n in 0..M {
            self.cos[n] = self.cos[n] + factor * other.cos[n];
            self.sin[n] = self.sin[n] + factor * other.sin[n];
        }
        self
    }

    /// The same polynomial seen as one of a higher degree.
    #[inline]
    pub(crate) fn raised<const R: usize>(&self) -> TrigPolynomial<R, T> {
        let zero = T::from(0.0);
        let mut raised = TrigPolynomial { cos: [zero; R], sin: [zero; R] };
        raised.cos[..M].copy_from_slice(&self.cos);
        raised.sin[..M].copy_from_slice(&self.sin);
        raised
    }
}

impl<const M: usize> TrigPolynomial<M> {
    const ZERO: Self = Self { cos: [0.0; M], sin: [0.0; M] };

    /// `θ ↦ self(θ + angle)`.
    pub(crate) fn turned(&self, angle: f64) -> Self {
        let (s1, c1) = sin_cos(angle);
        let (mut c, mut s) = (1.0, 0.0);
        let mut turned = *self;
        for n in 1..M {
            (c, s) = (c * c1 - s * s1, s * c1 + c * s1);
            turned.cos[n] = self.cos[n] * c + self.sin[n] * s;
            turned.sin[n] = self.sin[n] * c - self.cos[n] * s;
        }
        turned
    }

    /// The derivative.
    #[inline]
    pub(crate) fn derivative(&self) -> Self {
        let mut slope = Self::ZERO;
        let mut order = 0.0;
        for n in 1..M {
            order += 1.0;
            slope.cos[n] = order * self.sin[n];
            slope.sin[n] = -order * self.cos[n];
        }
        slope
    }

    /// Bound of the `power`-th derivative's magnitude; of the value itself for `power` 0.
    #[inline]
    pub(crate) fn bound(&self, power: i32) -> f64 {
        let mut bound = if power == 0 { self.cos[0].abs() } else { 0.0 };
        let mut order = 0.0_f64;
        for n in 1..M {
            order += 1.0;
            bound += order.powi(power) * (self.cos[n].abs() + self.sin[n].abs());
        }
        bound
    }

    /// Value and slope at an angle.
    #[inline]
    pub(crate) fn at(&self, angle: f64) -> ValueAndSlope {
        let (s1, c1) = sin_cos(angle);
        let (mut c, mut s, mut order) = (1.0, 0.0, 0.0);
        let mut point = ValueAndSlope { value: self.cos[0], slope: 0.0 };
        for n in 1..M {
            (c, s) = (c * c1 - s * s1, s * c1 + c * s1);
            order += 1.0;
            point.value += self.cos[n] * c + self.sin[n] * s;
            point.slope += order * (self.sin[n] * c - self.cos[n] * s);
        }
        point
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_has_the_product_of_the_values() {
        let (f, g) = (linear(0.3, -1.2, 2.0), linear(1.0, 0.5, -0.25));
        let product = f.times(&g);
        for step in 0..20 {
            let angle = f64::from(step) * 0.31 - 3.0;
            let expected = f.at(angle).value * g.at(angle).value;
            let close = |value: f64, expected: f64| assert!((value - expected).abs() < 1e-13);
            close(product.at(angle).value, expected);
            close(product.times_even(0.7, -0.4).at(angle).value, expected * (0.7 - 0.4 * angle.cos()));
            close(product.squared().at(angle).value, expected * expected);
            close(product.squared().turned(0.7).at(angle - 0.7).value, expected * expected);
        }
    }

    #[test]
    fn the_derivative_equals_the_slope() {
        let a = linear(0.3, -1.2, 2.0).times(&linear(1.0, 0.5, -0.25)).squared();
        let point = a.at(0.4);
        let h = 1e-5;
        let slope = (a.at(0.4 + h).value - a.at(0.4 - h).value) / (2.0 * h);
        assert!((point.slope - slope).abs() < 1e-7);
        assert!((a.derivative().at(0.4).value - point.slope).abs() < 1e-13);
    }
}
