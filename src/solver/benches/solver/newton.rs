//! The yardstick: Newton-Raphson on Eqs (3)-(6) in (x, y, z, a), as a machine's controller does it.

use verne_solver::machine::Geometry;
use verne_solver::{Machine, PlatformPose};

/// Its row in the table, to which all ratios refer.
pub(crate) const NAME: &str = "FK, Newton-Raphson, dense 4×4";
/// Steps before it gives up; four are usual.
pub(crate) const STEPS: usize = 20;
/// A last step (mm) below which the next one would be below 1e-12 mm: convergence is quadratic,
/// with a factor of about the inverse of a rod's length.
pub(crate) const SETTLED: f64 = 1e-5;

/// The pose at `rho` from a start near it; one pose, no label, no check.
#[inline]
pub(crate) fn forward(machine: &Machine, rho: [f64; 3], start: PlatformPose) -> Option<PlatformPose> {
    let g = &machine.data().geometry;
    let mut pose = start;
    for _ in 0..STEPS {
        let [dx, dy, dz, da] = solved(system(g, rho, &pose))?;
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

/// Half the derivatives of the four equations against (x, y, z, a), and half their errors.
#[inline]
fn system(g: &Geometry, rho: [f64; 3], pose: &PlatformPose) -> [[f64; 5]; 4] {
    let (s, c) = pose.alpha.sin_cos();
    let (x1, x2) = (pose.x + g.D1 - g.d1, pose.x + g.D2 - g.d2);
    let (u, v) = (g.R1 * c - g.r1, g.R1 * s);
    let (p, q) = (g.R2 * c - g.r4, g.R2 * s);
    // d(y, z of the rod)/da = arm (-sin a, cos a).
    let row = |x: f64, y: f64, z: f64, arm: f64, length: f64| {
        [x, y, z, arm * (c * z - s * y), 0.5 * (x * x + y * y + z * z - length * length)]
    };
    [
        row(x1, pose.y + u, pose.z + v - rho[0], g.R1, g.L1),
        row(x1, pose.y - u, pose.z - v - rho[0], -g.R1, g.L1),
        row(x2, pose.y - p, pose.z - q - rho[1], -g.R2, g.L2),
        row(x2, pose.y + p, pose.z + q - rho[2], g.R2, g.L3),
    ]
}

/// Gaussian elimination with partial pivoting of a 4×4 system and its right-hand side.
#[inline]
fn solved(mut m: [[f64; 5]; 4]) -> Option<[f64; 4]> {
    for column in 0..4 {
        let mut pivot = column;
        for row in column + 1..4 {
            if m[row][column].abs() > m[pivot][column].abs() {
                pivot = row;
            }
        }
        m.swap(column, pivot);
        if m[column][column] == 0.0 {
            return None;
        }
        let (above, below) = m.split_at_mut(column + 1);
        let top = &above[column];
        let inverse = 1.0 / top[column];
        for row in below {
            let factor = row[column] * inverse;
            for (entry, pivot) in row[column + 1..].iter_mut().zip(&top[column + 1..]) {
                *entry -= factor * pivot;
            }
        }
    }
    let mut x = [0.0; 4];
    for row in (0..4).rev() {
        let known: f64 = (row + 1..4).map(|k| m[row][k] * x[k]).sum();
        x[row] = (m[row][4] - known) / m[row][row];
    }
    Some(x)
}
