//! The parallel matrix of the rods, and its determinant `det_P`.

use std::ops::{Add, Mul, Sub};

use crate::mechanism::Geometry;
use crate::rods::Rods;

/// The dimensionless 4×4 matrix of rods 11, 12, leg II, leg III (rows, divided by the rod length)
/// against x, y, z, R1 alpha (columns).
pub type ParallelMatrix = [[f64; 4]; 4];

/// The dimensionless parallel matrix.
#[inline]
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
#[inline]
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
