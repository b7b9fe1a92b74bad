//! Passive joints: the angle between a rod and the axis of its cone.

use std::f64::consts::PI;

use crate::rods::Rods;

/// Half-angle less each direction's angle from its axis, rad. All are unit vectors.
#[inline]
pub(super) fn margins(half_angle: f64, axes: &[[f64; 3]; 4], directions: &[[f64; 3]; 4]) -> [f64; 4] {
    let margin = |i: usize| half_angle - angle(axes[i], directions[i]);
    [margin(0), margin(1), margin(2), margin(3)]
}

/// The rods' directions in the platform frame: turned back by alpha about x.
#[inline]
pub(super) fn in_platform(rods: &Rods) -> [[f64; 3]; 4] {
    let (c, s) = (rods.c, rods.s);
    rods.directions.map(|[x, y, z]| [x, c * y + s * z, c * z - s * y])
}

/// The angle between two unit vectors by their chord: unlike the arc cosine of their product it
/// keeps its digits near home, where the angle is zero.
#[inline]
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let sign = if dot < 0.0 { -1.0 } else { 1.0 };
    let [x, y, z] = [a[0] - sign * b[0], a[1] - sign * b[1], a[2] - sign * b[2]];
    let acute = 2.0 * (0.5 * (x * x + y * y + z * z).sqrt()).asin();
    if dot < 0.0 { PI - acute } else { acute }
}
