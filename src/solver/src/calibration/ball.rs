//! The centre of a ball.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::frame::mean;

/// Points whose extent in one direction is below this fraction of the others are in one plane.
const FLAT: f64 = 1e-3;

/// The point that has these distances from some points, by linear least squares; without distances, the one that has
/// the same distance from all.
///
/// |u|² - 2 u · c + g = l², with g = |c|² as a further unknown, or g = |c|² - l². Points in one plane leave the height
/// of c over it open: the two mirror images fit equally, and the lower one is taken, on the side of the table.
pub(super) fn centre(tips: &[Vector3<f64>], lengths: Option<&[f64]>) -> Vector3<f64> {
    let middle = mean(tips);
    let spread: Matrix3<f64> = tips.iter().map(|tip| (tip - middle) * (tip - middle).transpose()).sum();
    let size = spread.trace().sqrt().max(f64::MIN_POSITIVE);
    let square = |i: usize| lengths.map_or(0.0, |lengths| lengths[i] * lengths[i]);
    let rows = DMatrix::from_fn(tips.len(), 4, |row, column| match column {
        3 => size,
        axis => -2.0 * (tips[row] - middle)[axis],
    });
    let right = DVector::from_fn(tips.len(), |row, _| square(row) - (tips[row] - middle).norm_squared());
    let solved = rows.svd(true, true).solve(&right, FLAT * size).unwrap_or_else(|_| DVector::zeros(4));
    let level = middle + Vector3::new(solved[0], solved[1], solved[2]);
    let frame = spread.symmetric_eigen();
    let (thin, extent) = frame.eigenvalues.argmin();
    let Some(lengths) = lengths.filter(|_| extent.max(0.0).sqrt() < FLAT * size) else { return level };
    let normal = frame.eigenvectors.column(thin).into_owned();
    let heights =
        tips.iter().zip(lengths).map(|(tip, length)| length * length - (tip - level).norm_squared());
    let height = heights.sum::<f64>() / count(tips);
    level + normal * height.max(0.0).sqrt() * if normal.z < 0.0 { -1.0 } else { 1.0 }
}

#[allow(clippy::cast_precision_loss, reason = "a number of points")]
fn count(tips: &[Vector3<f64>]) -> f64 {
    tips.len().max(1) as f64
}
