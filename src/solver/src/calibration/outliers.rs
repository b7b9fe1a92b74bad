//! Measurements that their errors do not explain.

use nalgebra::{DMatrix, Vector3};

/// Chance that one of all measurements is taken for an outlier although all errors are normal.
const CHANCE: f64 = 0.01;

/// Variance of a residual, relative to that of its measurement, below which it follows the measurement: nothing checks
/// such a measurement.
const UNCHECKED: f64 = 1e-6;

/// A measurement that its error does not explain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlier {
    /// The measurement, from 0.
    pub measurement: usize,
    /// The length of its residual, mm.
    pub residual: f64,
    /// The greatest ratio of a component of the residual to its standard deviation.
    pub ratio: f64,
}

/// The greatest ratio of a residual's components to their standard deviations, in units of that of a measurement's
/// component. `rows` are the measurement's derivatives, and `covariance` is in the same unit.
///
/// The residual of a measurement of weight w has the variance 1 + (1 - 2 w) h: h = a C aᵀ is that of the model's value.
/// For w = 1 this is 1 - h, by which Baarda's test divides (Baarda 1968, A testing procedure for use in geodetic
/// networks). `None` if nothing checks the measurement.
pub(super) fn ratio(
    residual: &Vector3<f64>,
    rows: &DMatrix<f64>,
    covariance: &DMatrix<f64>,
    weight: f64,
) -> Option<f64> {
    let of_model = rows * covariance;
    let ratio = |i: usize| {
        let h = of_model.row(i).dot(&rows.row(i));
        let variance = 1.0 + (1.0 - 2.0 * weight) * h;
        (variance > UNCHECKED).then(|| residual[i].abs() / variance.sqrt())
    };
    (0..rows.nrows()).filter_map(ratio).reduce(f64::max)
}

/// The ratio that the greatest of `count` normal numbers exceeds with a chance of 1 % at most.
///
/// A normal number exceeds t in size with a chance of at most sqrt(2/π) exp(-t²/2) / t.
#[allow(clippy::cast_precision_loss, reason = "a number of measurements")]
pub(super) fn threshold(count: usize) -> f64 {
    let chance = |t: f64| std::f64::consts::FRAC_2_PI.sqrt() * (-0.5 * t * t).exp() / t;
    let allowed = CHANCE / count.max(1) as f64;
    let (mut low, mut high) = (1.0, 30.0);
    while high - low > 1e-6 {
        let middle = 0.5 * (low + high);
        if chance(middle) > allowed { low = middle } else { high = middle }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::threshold;

    #[test]
    fn more_numbers_need_a_greater_threshold() {
        // The quantiles of the normal distribution at 1 - 0.01/2 and 1 - 1e-6/2 are 2.576 and 4.892.
        assert!((2.576..2.65).contains(&threshold(1)), "{}", threshold(1));
        assert!((4.892..4.9).contains(&threshold(10_000)), "{}", threshold(10_000));
    }
}
