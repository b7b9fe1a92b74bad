//! The fastest Newton-Raphson: the same method with its linear system eliminated by hand.
//!
//! Difference and mean of Eqs (3) and (4) and difference of Eqs (5) and (6) leave x in two rows
//! only; a 3×3 system in (y, z, a) remains, solved by cross products.

use verne_solver::machine::Geometry;
use verne_solver::{Machine, PlatformPose};

use crate::newton::{SETTLED, STEPS};

/// The pose at `rho` from a start near it; one pose, no label, no check.
#[inline]
pub(crate) fn forward(machine: &Machine, rho: [f64; 3], start: PlatformPose) -> Option<PlatformPose> {
    let g = &machine.data().geometry;
    let mut pose = start;
    for _ in 0..STEPS {
        let [dx, dy, dz, da] = step(g, rho, &pose);
        pose.x -= dx;
        pose.y -= dy;
        pose.z -= dz;
        pose.alpha -= da;
        if dx.abs().max(dy.abs()).max(dz.abs()).max(g.R1 * da.abs()) <= SETTLED {
            return Some(pose);
        }
    }
    None
}

#[inline]
fn step(g: &Geometry, rho: [f64; 3], pose: &PlatformPose) -> [f64; 4] {
    let (s, c) = pose.alpha.sin_cos();
    let (x1, x2, y) = (pose.x + g.D1 - g.d1, pose.x + g.D2 - g.d2, pose.y);
    let (u, v) = (g.R1 * c - g.r1, g.R1 * s);
    let (p, q) = (g.R2 * c - g.r4, g.R2 * s);
    let (w1, w2, w3) = (pose.z - rho[0], pose.z - q - rho[1], pose.z + q - rho[2]);
    // Columns y, z, a and the error, of: y u + w1 v = 0; the mean; Eq (5); Eq (6).
    let cross = [u, v, g.R1 * (c * w1 - s * y), y * u + w1 * v];
    let mean_error = 0.5 * (x1 * x1 + y * y + u * u + v * v + w1 * w1 - g.L1 * g.L1);
    let mean = [y, w1, g.R1 * g.r1 * s, mean_error];
    let leg = |y: f64, z: f64, arm: f64, length: f64| {
        [y, z, arm * (c * z - s * y), 0.5 * (x2 * x2 + y * y + z * z - length * length)]
    };
    let second = leg(y - p, w2, -g.R2, g.L2);
    let third = leg(y + p, w3, g.R2, g.L3);
    let gap: [f64; 4] = std::array::from_fn(|i| third[i] - second[i]);
    let free: [f64; 4] = std::array::from_fn(|i| x1 * second[i] - x2 * mean[i]);
    let normal = [
        gap[1] * free[2] - gap[2] * free[1],
        gap[2] * free[0] - gap[0] * free[2],
        gap[0] * free[1] - gap[1] * free[0],
    ];
    let inverse = 1.0 / (cross[0] * normal[0] + cross[1] * normal[1] + cross[2] * normal[2]);
    // (cross, gap, free) d = (e0, e1, e2) by its adjugate, with n = gap × free:
    // d = (e0 n + cross × (e2 gap - e1 free)) / (cross · n), sign by sign.
    let (e0, e1, e2) = (cross[3], gap[3], free[3]);
    let mix: [f64; 3] = std::array::from_fn(|i| e2 * gap[i] - e1 * free[i]);
    let dy = (e0 * normal[0] + cross[1] * mix[2] - cross[2] * mix[1]) * inverse;
    let dz = (e0 * normal[1] + cross[2] * mix[0] - cross[0] * mix[2]) * inverse;
    let da = (e0 * normal[2] + cross[0] * mix[1] - cross[1] * mix[0]) * inverse;
    let (row, x) = if x1.abs() > x2.abs() { (mean, x1) } else { (second, x2) };
    [(row[3] - row[0] * dy - row[1] * dz - row[2] * da) / x, dy, dz, da]
}
