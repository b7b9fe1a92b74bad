//! What measurements tell about the unknowns: rank, combinations that they do not determine, covariance.

use nalgebra::{DMatrix, DVector};

use super::triangle::Triangle;

/// Singular values below this fraction of the greatest are zero. What cannot be identified has about 1e-15 of it, from
/// rounding alone; what can has 1e-4 and more unless the poses are nearly the same.
const ZERO: f64 = 1e-9;

/// Entries of a combination below this fraction of its greatest are zero.
const NEGLIGIBLE: f64 = 1e-6;

/// The singular value decomposition of the derivatives of the measurements by some of the unknowns.
#[derive(Clone, Debug)]
pub(super) struct Information {
    /// Indices of the unknowns.
    unknowns: Vec<usize>,
    /// Singular values in descending order.
    values: DVector<f64>,
    /// The right singular vectors, as rows.
    vectors: DMatrix<f64>,
    /// The residual along the left singular vectors.
    residual: DVector<f64>,
    rank: usize,
}

/// Entries of the weakest combination below this fraction of its greatest are not told.
const NOTABLE: f64 = 0.1;

/// A combination of unknowns that measurements do not determine: indices with amounts, mm.
pub(super) type Combination = Vec<(usize, f64)>;

impl Information {
    /// The decomposition for some unknowns while the others are constant.
    pub(super) fn of(triangle: &Triangle, unknowns: Vec<usize>) -> Self {
        let count = unknowns.len();
        if count == 0 {
            let (values, vectors) = (DVector::zeros(0), DMatrix::zeros(0, 0));
            return Self { unknowns, residual: values.clone(), values, vectors, rank: 0 };
        }
        let matrix = triangle.matrix().select_columns(&unknowns);
        let svd = matrix.svd(true, true);
        let left = svd.u.unwrap_or_else(|| DMatrix::zeros(triangle.residual().len(), count));
        let vectors = svd.v_t.unwrap_or_else(|| DMatrix::identity(count, count));
        let values = svd.singular_values;
        let least = ZERO * values.iter().copied().fold(0.0, f64::max);
        let rank = values.iter().filter(|value| **value > least).count();
        Self { unknowns, residual: left.tr_mul(&triangle.residual()), values, vectors, rank }
    }

    /// The number of combinations that the measurements determine.
    pub(super) fn rank(&self) -> usize {
        self.rank
    }

    /// The singular values in descending order; those that are zero up to rounding are.
    pub(super) fn singular_values(&self) -> Vec<f64> {
        let zero = |(i, value): (usize, &f64)| if i < self.rank { *value } else { 0.0 };
        self.values.iter().enumerate().map(zero).collect()
    }

    /// The greatest singular value.
    pub(super) fn greatest(&self) -> f64 {
        self.values.iter().copied().fold(0.0, f64::max)
    }

    /// By how much the best step decreases the sum of squares.
    pub(super) fn decrement(&self) -> f64 {
        self.residual.rows(0, self.rank).norm_squared()
    }

    /// The step of Levenberg and Marquardt that minimises the sum of squares and `damping` times that of the step's own
    /// numbers, for `count` unknowns, mm. It changes no combination that the measurements do not determine.
    pub(super) fn step(&self, damping: f64, count: usize) -> Vec<f64> {
        let mut step = vec![0.0; count];
        for i in 0..self.rank {
            let value = self.values[i];
            let along = -value * self.residual[i] / (value * value + damping);
            for (column, unknown) in self.unknowns.iter().enumerate() {
                step[*unknown] += along * self.vectors[(i, column)];
            }
        }
        step
    }

    /// Unit vectors that span the combinations that the measurements do not determine, as columns of `count` rows.
    pub(super) fn null_space(&self, count: usize) -> DMatrix<f64> {
        let mut vectors = DMatrix::zeros(count, self.unknowns.len() - self.rank);
        for (row, unknown) in self.unknowns.iter().enumerate() {
            for column in 0..vectors.ncols() {
                vectors[(*unknown, column)] = self.vectors[(self.rank + column, row)];
            }
        }
        vectors
    }

    /// Whether the measurements determine an unknown.
    pub(super) fn determines(&self, unknown: usize) -> bool {
        let Some(column) = self.unknowns.iter().position(|other| *other == unknown) else { return false };
        let free = self.vectors.column(column);
        free.rows_range(self.rank..).norm() < NEGLIGIBLE
    }

    /// The covariance of `count` unknowns from rows in units of their standard deviations, mm². Rows and columns of
    /// constant unknowns are zero; those of combinations that the measurements do not determine lack their part.
    pub(super) fn covariance(&self, count: usize) -> DMatrix<f64> {
        let mut half = DMatrix::zeros(count, self.rank);
        for (row, unknown) in self.unknowns.iter().enumerate() {
            for i in 0..self.rank {
                half[(*unknown, i)] = self.vectors[(i, row)] / self.values[i];
            }
        }
        &half * half.transpose()
    }

    /// The combinations that the measurements do not determine, with as few unknowns each as elimination finds.
    pub(super) fn undetermined(&self) -> Vec<Combination> {
        let mut rows = self.vectors.rows_range(self.rank..).into_owned();
        let mut done = Vec::new();
        while done.len() < rows.nrows() {
            let open = (0..rows.nrows()).filter(|row| !done.contains(row));
            let entries = open.flat_map(|row| (0..rows.ncols()).map(move |column| (row, column)));
            let largest = entries.max_by(|a, b| rows[*a].abs().total_cmp(&rows[*b].abs()));
            let Some((pivot, column)) = largest else { break };
            let scaled = rows.row(pivot) / rows[(pivot, column)];
            rows.set_row(pivot, &scaled);
            for row in (0..rows.nrows()).filter(|row| *row != pivot) {
                let reduced = rows.row(row) - &scaled * rows[(row, column)];
                rows.set_row(row, &reduced);
            }
            done.push(pivot);
        }
        let mut found: Vec<_> = rows.row_iter().map(|row| self.combination(row.iter().copied())).collect();
        found.sort_by_key(|combination| combination.iter().map(|(unknown, _)| *unknown).min());
        found
    }

    /// The combination that the measurements determine least, of those that they determine.
    pub(super) fn weakest(&self) -> Combination {
        let last = self.rank.checked_sub(1).map(|last| self.vectors.row(last));
        let Some(last) = last else { return Vec::new() };
        let greatest = last.amax();
        let share = |amount: &f64| if amount.abs() > NOTABLE * greatest { *amount } else { 0.0 };
        self.combination(last.iter().map(share))
    }

    fn combination(&self, amounts: impl Iterator<Item = f64> + Clone) -> Combination {
        let greatest = amounts.clone().map(f64::abs).fold(0.0, f64::max);
        let entries = self.unknowns.iter().copied().zip(amounts);
        let mut entries: Vec<_> =
            entries.filter(|(_, amount)| amount.abs() > NEGLIGIBLE * greatest).collect();
        let sign = entries.first().map_or(1.0, |(_, amount)| amount.signum());
        for (_, amount) in &mut entries {
            *amount *= sign / greatest;
        }
        entries
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::{Information, Triangle};

    /// Rows that tell x0 + x1, 2 (x0 + x1) and x3 - x4, and nothing of x2.
    fn example() -> Information {
        let rows = DMatrix::from_row_slice(
            3,
            6,
            &[
                1.0, 1.0, 0.0, 0.0, 0.0, 0.5, //
                2.0, 2.0, 0.0, 0.0, 0.0, 1.0, //
                0.0, 0.0, 0.0, 3.0, -3.0, 0.0,
            ],
        );
        Information::of(&Triangle::of(rows), (0..5).collect())
    }

    #[test]
    fn combinations_that_do_not_matter_are_told_apart() {
        let information = example();
        assert_eq!(information.rank(), 2);
        let names: Vec<Vec<(usize, f64)>> = information
            .undetermined()
            .iter()
            .map(|combination| combination.iter().map(|(at, amount)| (*at, amount.round())).collect())
            .collect();
        assert_eq!(names, [vec![(0, 1.0), (1, -1.0)], vec![(2, 1.0)], vec![(3, 1.0), (4, 1.0)]]);
        assert!((0..5).all(|unknown| !information.determines(unknown)));
    }

    #[test]
    fn a_step_solves_what_can_be_solved_and_leaves_the_rest() {
        let step = example().step(0.0, 5);
        assert!((step[0] + 0.25).abs() < 1e-12 && (step[1] + 0.25).abs() < 1e-12, "{step:?}");
        assert!(step[2..].iter().all(|number| number.abs() < 1e-12), "{step:?}");
    }

    #[test]
    fn without_unknowns_nothing_is_determined() {
        let information = Information::of(&Triangle::of(DMatrix::zeros(3, 2)), Vec::new());
        assert_eq!((information.rank(), information.decrement()), (0, 0.0));
        assert_eq!(information.step(1.0, 1), [0.0]);
        assert_eq!(information.covariance(1)[(0, 0)], 0.0);
        assert!(information.undetermined().is_empty() && !information.determines(0));
        assert_eq!(information.null_space(1).ncols(), 0);
    }

    #[test]
    fn constant_unknowns_have_no_variance() {
        let rows = DMatrix::from_row_slice(2, 3, &[2.0, 0.0, 0.0, 0.0, 4.0, 0.0]);
        let covariance = Information::of(&Triangle::of(rows), vec![1]).covariance(2);
        assert_eq!((covariance[(0, 0)], covariance[(1, 1)]), (0.0, 0.0625));
    }
}
