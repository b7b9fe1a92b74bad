//! Trigonometric polynomials in the Fourier basis.

/// `cos[0] + Σ (cos[n] cos nθ + sin[n] sin nθ)` of degree M - 1; `sin[0]` is zero.
///
/// The Fourier basis keeps products exact in form, is invariant under rotation, and bounds every
/// derivative by its coefficients alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TrigPolynomial<const M: usize> {
    pub(crate) cos: [f64; M],
    pub(crate) sin: [f64; M],
}

/// Value, first and second derivative at one angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Jet {
    pub(crate) value: f64,
    pub(crate) slope: f64,
    pub(crate) curvature: f64,
}

/// `constant + cos · cos θ + sin · sin θ`.
pub(crate) fn linear(constant: f64, cos: f64, sin: f64) -> TrigPolynomial<2> {
    TrigPolynomial { cos: [constant, cos], sin: [0.0, sin] }
}

impl<const M: usize> TrigPolynomial<M> {
    const ZERO: Self = Self { cos: [0.0; M], sin: [0.0; M] };

    /// The product; R must be M + B - 1.
    #[inline]
    pub(crate) fn times<const B: usize, const R: usize>(
        &self,
        other: &TrigPolynomial<B>,
    ) -> TrigPolynomial<R> {
        const { assert!(R + 1 == M + B) };
        let mut product = TrigPolynomial::<R>::ZERO;
        for i in 0..M {
            for j in 0..B {
                let (sum, gap) = (i + j, i.abs_diff(j));
                let cc = 0.5 * self.cos[i] * other.cos[j];
                let ss = 0.5 * self.sin[i] * other.sin[j];
                let sc = 0.5 * self.sin[i] * other.cos[j];
                let cs = 0.5 * self.cos[i] * other.sin[j];
                product.cos[sum] += cc - ss;
                product.cos[gap] += cc + ss;
                product.sin[sum] += sc + cs;
                product.sin[gap] += if i > j { sc - cs } else { cs - sc };
            }
        }
        product.sin[0] = 0.0;
        product
    }

    /// `self + factor · other`.
    #[inline]
    pub(crate) fn plus(mut self, factor: f64, other: &Self) -> Self {
        for n in 0..M {
            self.cos[n] += factor * other.cos[n];
            self.sin[n] += factor * other.sin[n];
        }
        self
    }

    /// The same polynomial seen as one of a higher degree.
    #[inline]
    pub(crate) fn raised<const R: usize>(&self) -> TrigPolynomial<R> {
        let mut raised = TrigPolynomial::<R>::ZERO;
        raised.cos[..M].copy_from_slice(&self.cos);
        raised.sin[..M].copy_from_slice(&self.sin);
        raised
    }

    /// `θ ↦ self(θ + angle)`.
    pub(crate) fn turned(&self, angle: f64) -> Self {
        let (s1, c1) = angle.sin_cos();
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

    /// Value and slope at the angle whose cosine and sine are `c1` and `s1`.
    #[inline]
    pub(crate) fn value_slope(&self, c1: f64, s1: f64) -> (f64, f64) {
        let (mut c, mut s, mut order) = (1.0, 0.0, 0.0);
        let (mut value, mut slope) = (self.cos[0], 0.0);
        for n in 1..M {
            (c, s) = (c * c1 - s * s1, s * c1 + c * s1);
            order += 1.0;
            value += self.cos[n] * c + self.sin[n] * s;
            slope += order * (self.sin[n] * c - self.cos[n] * s);
        }
        (value, slope)
    }

    /// Value, slope and curvature at an angle.
    pub(crate) fn jet(&self, angle: f64) -> Jet {
        let (s1, c1) = angle.sin_cos();
        let (value, slope) = self.value_slope(c1, s1);
        let (_, curvature) = self.derivative().value_slope(c1, s1);
        Jet { value, slope, curvature }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_has_the_product_of_the_values() {
        let a = linear(0.3, -1.2, 2.0).times::<2, 3>(&linear(1.0, 0.5, -0.25));
        let b = a.times::<3, 5>(&a);
        for step in 0..20 {
            let angle = f64::from(step) * 0.31 - 3.0;
            let expected = a.jet(angle).value.powi(2);
            assert!((b.jet(angle).value - expected).abs() < 1e-13);
            assert!((b.turned(0.7).jet(angle - 0.7).value - expected).abs() < 1e-13);
        }
    }

    #[test]
    fn the_derivative_is_the_slope() {
        let a = linear(0.3, -1.2, 2.0).times::<2, 3>(&linear(1.0, 0.5, -0.25));
        let jet = a.jet(0.4);
        let h = 1e-5;
        let slope = (a.jet(0.4 + h).value - a.jet(0.4 - h).value) / (2.0 * h);
        let curvature = (a.jet(0.4 + h).slope - a.jet(0.4 - h).slope) / (2.0 * h);
        assert!((jet.slope - slope).abs() < 1e-8 && (jet.curvature - curvature).abs() < 1e-8);
    }
}
