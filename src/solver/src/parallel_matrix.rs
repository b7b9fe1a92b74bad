//! The parallel matrix of the rods, and its determinant `det_P`.

use std::ops::{Add, Mul, Sub};

use crate::mechanism::Geometry;
use crate::rods::Rods;

/// The dimensionless 4×4 matrix of rods 11, 12, leg II, leg III (rows, divided by the rod length)
/// against x, y, z, R1 alpha (columns).
pub type ParallelMatrix = [[f64; 4]; 4];

/// The dimensionless parallel matrix.
#[inline(always)]
pub(crate) fn matrix(g: &Geometry, rods: &Rods) -> ParallelMatrix {
    let ratio = g.R2 / g.R1;
    let arms = [1.0, -1.0, -ratio, ratio];
    let row = |i: usize| {
        let [x, y, z] = rods.directions[i];
        [x, y, z, arms[i] * (rods.c * z - rods.s * y)]
    };
    [row(0), row(1), row(2), row(3)]
}

/// Determinant by complementary 2×2 minors, of numbers or of their ranges.
#[inline(always)]
pub(crate) fn determinant<T>(m: &[[T; 4]; 4]) -> T
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>,
{
    let upper = |i: usize, j: usize| m[0][i] * m[1][j] - m[0][j] * m[1][i];
    let lower = |i: usize, j: usize| m[2][i] * m[3][j] - m[2][j] * m[3][i];
    upper(0, 1) * lower(2, 3) - upper(0, 2) * lower(1, 3)
        + upper(0, 3) * lower(1, 2)
        + upper(1, 2) * lower(0, 3)
        - upper(1, 3) * lower(0, 2)
        + upper(2, 3) * lower(0, 1)
}

/// The determinant and the inverse, from the minors of the upper and the lower two rows. `None` if a number of the
/// inverse is not finite.
#[inline]
pub(crate) fn inverse(m: &ParallelMatrix) -> Option<(f64, ParallelMatrix)> {
    let minors = |a: &[f64; 4], b: &[f64; 4]| {
        let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
        [minor(0, 1), minor(0, 2), minor(0, 3), minor(1, 2), minor(1, 3), minor(2, 3)]
    };
    let (s, c) = (minors(&m[0], &m[1]), minors(&m[2], &m[3]));
    let det = s[0] * c[5] - s[1] * c[4] + s[2] * c[3] + s[3] * c[2] - s[4] * c[1] + s[5] * c[0];
    let scale = 1.0 / det;
    // The adjugate's rows, each from one row of the matrix and the minors of the other two.
    let first = |row: &[f64; 4], c: &[f64; 6]| {
        [
            row[1] * c[5] - row[2] * c[4] + row[3] * c[3],
            -row[0] * c[5] + row[2] * c[2] - row[3] * c[1],
            row[0] * c[4] - row[1] * c[2] + row[3] * c[0],
            -row[0] * c[3] + row[1] * c[1] - row[2] * c[0],
        ]
    };
    let columns = [first(&m[1], &c), first(&m[0], &c), first(&m[3], &s), first(&m[2], &s)];
    let signs = [scale, -scale, scale, -scale];
    let found = std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i] * signs[j]));
    scale.is_finite().then_some((det, found))
}
