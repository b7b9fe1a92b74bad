//! Linear least squares with many rows: the triangular factor of the rows so far.

use nalgebra::{DMatrix, DVectorView, Dyn, MatrixView, U1};

/// The triangular factor of rows [J | r], from which J and r can be replaced in every least-squares problem: for any x,
/// |J x + r|² is that of the factor.
///
/// Householder's QR decomposition of some rows, and of factors one upon the other. Unlike the normal equations it does
/// not square the condition number, so that singular values as small as rounding are seen.
#[derive(Clone, Debug)]
pub(super) struct Triangle {
    /// (n + 1) rows and columns; the last column is r.
    factor: DMatrix<f64>,
}

impl Triangle {
    /// The factor of some rows, each with the residual as its last number.
    pub(super) fn of(rows: DMatrix<f64>) -> Self {
        let columns = rows.ncols();
        let triangle = rows.qr().r();
        // Of fewer rows than columns the factor is a trapezium.
        Self { factor: triangle.resize_vertically(columns, 0.0) }
    }

    /// The factor of the rows of both.
    pub(super) fn and(self, other: &Self) -> Self {
        let (columns, upper) = (self.factor.ncols(), self.factor.nrows());
        let mut rows = self.factor.resize_vertically(upper + other.factor.nrows(), 0.0);
        rows.view_mut((upper, 0), (other.factor.nrows(), columns)).copy_from(&other.factor);
        Self::of(rows)
    }

    /// The number of unknowns.
    pub(super) fn unknowns(&self) -> usize {
        self.factor.ncols() - 1
    }

    /// The factor of J, with a row of zeros below.
    pub(super) fn matrix(&self) -> MatrixView<'_, f64, Dyn, Dyn, U1, Dyn> {
        self.factor.columns(0, self.unknowns())
    }

    /// The residual in the rows of [`Self::matrix`].
    pub(super) fn residual(&self) -> DVectorView<'_, f64, U1, Dyn> {
        self.factor.column(self.unknowns())
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::Triangle;

    /// Numbers without a pattern.
    fn rows(count: usize) -> DMatrix<f64> {
        let numbers = [-4.0, -3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        DMatrix::from_fn(count, 4, |i, j| numbers[(i * 7 + j * 13 + i * i * j) % 11])
    }

    #[test]
    fn the_factor_keeps_every_sum_of_squares() {
        let all = rows(9);
        let first = Triangle::of(all.rows(0, 2).into_owned());
        let both = first.and(&Triangle::of(all.rows(2, 7).into_owned()));
        for x in [[1.0, 2.0, 3.0], [-0.5, 0.0, 4.0], [0.0; 3]] {
            let x = nalgebra::DVector::from_row_slice(&x);
            let direct = (all.columns(0, 3) * &x + all.column(3)).norm_squared();
            let factor = (both.matrix() * &x + both.residual()).norm_squared();
            assert!((direct - factor).abs() < 1e-12 * direct.max(1.0), "{direct} and {factor}");
        }
    }
}
