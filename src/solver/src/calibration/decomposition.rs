//! The singular value decomposition with a bound of its iterations.

use nalgebra::{DMatrix, Dyn, SVD};

/// Most iterations for each column: usually two or three suffice. Without a bound, numbers near the ends of the range
/// of doubles let the decomposition run for ever.
const ITERATIONS: usize = 500;

/// The decomposition of a matrix. `None` if the matrix is empty or has numbers that are not finite, or if the iteration
/// does not converge.
pub(super) fn decomposed(matrix: DMatrix<f64>) -> Option<SVD<f64, Dyn, Dyn>> {
    let is_usable = !matrix.is_empty() && matrix.iter().all(|entry| entry.is_finite());
    let most = ITERATIONS * matrix.ncols();
    is_usable.then(|| SVD::try_new(matrix, true, true, 5.0 * f64::EPSILON, most)).flatten()
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::decomposed;

    #[test]
    fn every_matrix_has_an_end() {
        assert!(decomposed(DMatrix::zeros(3, 0)).is_none());
        assert!(decomposed(DMatrix::from_element(3, 2, f64::NAN)).is_none());
        assert!(decomposed(DMatrix::from_element(3, 2, f64::INFINITY)).is_none());
        // The decomposition of this matrix alone does not end without a bound.
        let tiny = DMatrix::from_fn(6, 4, |_, column| if column == 3 { f64::MIN_POSITIVE } else { 0.0 });
        drop(decomposed(tiny));
        assert!(decomposed(DMatrix::identity(3, 2)).is_some_and(|svd| svd.singular_values[0] == 1.0));
    }
}
