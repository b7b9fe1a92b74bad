//! What a residual costs, and the spread of residuals.

/// What a residual costs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Loss {
    /// The square of each residual: the best estimate if all errors are normal.
    #[default]
    Squares,
    /// Squares of small residuals, and linear beyond: a gross error has a bounded influence.
    ///
    /// Huber 1964, doi:10.1214/aoms/1177703732. The corner is where the estimate of one number loses 5 % of its
    /// efficiency if all errors are normal.
    Huber,
}

/// Residuals over this many standard deviations are linear: of one number, and of a vector of three numbers, which is
/// as seldom as long.
const CORNERS: [f64; 2] = [1.345, 2.215];

/// The median of the length of one and of three normal numbers of standard deviation one.
const MEDIANS: [f64; 2] = [0.674_489_75, 1.538_172_25];

fn entry(of: [f64; 2], components: usize) -> f64 {
    if components == 1 { of[0] } else { of[1] }
}

/// The weights of measurements.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weighting {
    pub(super) loss: Loss,
    /// The standard deviation of a component, mm, by which residuals are divided.
    pub(super) scale: f64,
    /// The numbers of a measurement.
    pub(super) components: usize,
}

impl Weighting {
    /// The cost of a residual of this length. It is the square of its ratio to the scale if the loss is.
    pub(super) fn cost(&self, length: f64) -> f64 {
        let (ratio, corner) = (length / self.scale, entry(CORNERS, self.components));
        match self.loss {
            Loss::Huber if ratio > corner => corner * (2.0 * ratio - corner),
            _ => ratio * ratio,
        }
    }

    /// The weight that makes the square of the residual have the slope of its cost: one at most.
    pub(super) fn weight(&self, length: f64) -> f64 {
        let (ratio, corner) = (length / self.scale, entry(CORNERS, self.components));
        match self.loss {
            Loss::Huber if ratio > corner => corner / ratio,
            _ => 1.0,
        }
    }
}

/// The standard deviation of a component from the median of the residuals' lengths, which gross errors hardly change.
pub(super) fn robust_scale(lengths: impl Iterator<Item = f64>, components: usize) -> f64 {
    let mut lengths: Vec<f64> = lengths.collect();
    if lengths.is_empty() {
        return 0.0;
    }
    let middle = lengths.len() / 2;
    let (_, median, _) = lengths.select_nth_unstable_by(middle, f64::total_cmp);
    *median / entry(MEDIANS, components)
}

#[cfg(test)]
mod tests {
    use super::{Loss, Weighting, robust_scale};

    #[test]
    fn cost_and_weight_are_continuous_and_agree() {
        for components in [1, 3] {
            let huber = Weighting { loss: Loss::Huber, scale: 0.002, components };
            for i in 1..400 {
                let (length, step) = (f64::from(i) * 2.5e-5, 1e-9);
                let slope = (huber.cost(length + step) - huber.cost(length - step)) / (2.0 * step);
                let of_weight = 2.0 * huber.weight(length) * length / (huber.scale * huber.scale);
                assert!((slope - of_weight).abs() < 1e-5 * slope, "{length}: {slope} and {of_weight}");
            }
            assert!(huber.weight(1.0) < 0.005);
        }
    }

    #[test]
    fn the_median_of_normal_numbers_tells_their_deviation() {
        // The quantiles of a normal distribution at 1/6, 1/2, 5/6, as lengths: 0.967, 0, 0.967.
        assert!((robust_scale([0.2, 0.674_489_75, 9.0].into_iter(), 1) - 1.0).abs() < 1e-12);
        assert_eq!(robust_scale(std::iter::empty(), 3), 0.0);
    }
}
