//! Passive joints: the angle between a rod and the axis of its cone.

use std::f64::consts::FRAC_PI_2;

use crate::fast_math::{asin, lesser};
use crate::rods::Rods;

/// (angle² / chord² - 1 - chord² / 12) / chord⁴ at a right angle, rounded up.
const REMAINDER: f64 = 0.016_759;
/// Upper bound of the rounding error of a squared chord that is computed from a cosine.
const ROUNDING: f64 = 1e-12;

/// Four unit vectors by coordinate, so that the processor computes four angles at once.
pub(crate) type Columns = [[f64; 4]; 3];

/// Vectors by coordinate.
#[inline(always)]
pub(crate) fn columns(vectors: &[[f64; 3]; 4]) -> Columns {
    let column = |axis: usize| [0, 1, 2, 3].map(|i: usize| vectors[i][axis]);
    [column(0), column(1), column(2)]
}

/// Rotates the columns back by alpha about x: from the base frame into the platform frame.
#[inline(always)]
pub(super) fn in_platform(rods: &Rods, [x, y, z]: &Columns) -> Columns {
    let (c, s) = (rods.c, rods.s);
    let (mut turned_y, mut turned_z) = ([0.0; 4], [0.0; 4]);
    for i in 0..4 {
        turned_y[i] = c * y[i] + s * z[i];
        turned_z[i] = c * z[i] - s * y[i];
    }
    [*x, turned_y, turned_z]
}

/// Half-angle less each direction's angle from its axis, rad.
///
/// The angle between two unit vectors follows from their chord. Unlike the arc cosine of their product, this keeps
/// its digits near home, where the angle is zero. For vectors more than a right angle apart the chord to the opposite
/// of one vector is used, and the angle is subtracted from half a turn.
#[inline(always)]
pub(super) fn margins(half_angle: f64, a: &Columns, b: &Columns) -> [f64; 4] {
    let mut margins = [0.0; 4];
    for i in 0..4 {
        let dot = a[0][i] * b[0][i] + a[1][i] * b[1][i] + a[2][i] * b[2][i];
        let sign = 1.0_f64.copysign(dot);
        let chord = [a[0][i] - sign * b[0][i], a[1][i] - sign * b[1][i], a[2][i] - sign * b[2][i]];
        let square = 0.25 * (chord[0] * chord[0] + chord[1] * chord[1] + chord[2] * chord[2]);
        let acute = 2.0 * asin(square.sqrt(), square);
        margins[i] = half_angle - (FRAC_PI_2 * (1.0 - sign) + sign * acute);
    }
    margins
}

/// A rod's direction in the platform frame.
#[inline(always)]
pub(super) fn direction_in_platform(rods: &Rods, rod: usize) -> [f64; 3] {
    let ([x, y, z], c, s) = (rods.directions[rod], rods.c, rods.s);
    [x, c * y + s * z, c * z - s * y]
}

/// A number that is positive only if the angles of all four rods from their axes are clearly below an angle.
#[inline(always)]
pub(super) fn bound(axes: &Columns, direction: impl Fn(usize) -> [f64; 3], angle: f64) -> f64 {
    let dot = |rod: usize| {
        let [x, y, z] = direction(rod);
        axes[0][rod] * x + axes[1][rod] * y + axes[2][rod] * z
    };
    angle_bound(lesser(lesser(dot(0), dot(1)), lesser(dot(2), dot(3))), angle)
}

/// A number that is positive only if an angle, given by its cosine, is clearly below another. For an acute angle it
/// uses an upper bound of its square: the beginning of the power series in the square of the chord, whose terms are
/// all positive, with the remainder that it has at a right angle.
#[inline(always)]
fn angle_bound(cosine: f64, angle: f64) -> f64 {
    let square = 2.0 - 2.0 * cosine + ROUNDING;
    let most = square * (1.0 + square * (1.0 / 12.0 + REMAINDER * square));
    lesser(lesser(cosine, angle), angle * angle - most)
}
