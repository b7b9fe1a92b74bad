//! The check that every solution passes before it leaves the solver: back into Eqs (3)-(6).

use nalgebra::{Matrix4, Vector4};

use crate::closure::wrapped;
use crate::jacobian::matrix;
use crate::machine::Machine;
use crate::pose::PlatformPose;
use crate::rods::Rods;

/// Largest rod-length error of a solution, relative to the size of its numbers. Evaluating the
/// equations rounds by a few 1e-16 of that size; some hundred times as much is no solution.
pub const RESIDUAL_TOLERANCE: f64 = 1e-13;
/// Relative error above which the elimination has lost digits that the equations still have: the
/// solution is then corrected on Eqs (3)-(6) themselves.
pub(crate) const FINE: f64 = 1e-15;
/// Relative error above which nothing is corrected.
const ROUGH: f64 = 1e-9;
/// Newton steps of a correction.
const STEPS: usize = 4;

/// A pose and how well it satisfies Eqs (3)-(6).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Checked {
    pub(crate) pose: PlatformPose,
    /// The largest error of a rod's length, (|B - A|² - L²) / 2L, mm.
    pub(crate) residual: f64,
}

/// Puts a pose back into Eqs (3)-(6) with the sliders at `rho`, and corrects it there if the
/// elimination left an error.
#[inline]
pub(crate) fn checked(machine: &Machine, pose: PlatformPose, rho: [f64; 3]) -> Checked {
    let residual = worst(&errors(machine, &pose, rho).0);
    let size = size(machine, pose.z);
    // What is further off is no rounded solution: correcting it would find another one.
    let rounded = residual > FINE * size && residual < ROUGH * size;
    if rounded { corrected(machine, pose, rho) } else { Checked { pose, residual } }
}

/// Newton's method on (3)-(6) in (x, y, z, a), as long as it gains.
#[cold]
fn corrected(machine: &Machine, pose: PlatformPose, rho: [f64; 3]) -> Checked {
    let radius = machine.geometry().R1;
    let (mut errors_now, mut rods) = errors(machine, &pose, rho);
    let mut best = Checked { pose, residual: worst(&errors_now) };
    for _ in 0..STEPS {
        let rows = matrix(machine.geometry(), &rods);
        let jacobian = Matrix4::from_fn(|row, column| rows[row][column]);
        let Some(step) = jacobian.lu().solve(&Vector4::from(errors_now)) else { break };
        let p = best.pose;
        let alpha = wrapped(p.alpha - step[3] / radius);
        let pose = PlatformPose { x: p.x - step[0], y: p.y - step[1], z: p.z - step[2], alpha };
        (errors_now, rods) = errors(machine, &pose, rho);
        let residual = worst(&errors_now);
        if residual < best.residual {
            best = Checked { pose, residual };
        } else {
            break;
        }
    }
    best
}

/// The rods' length errors in Eqs (3)-(6), mm, and the rods.
#[inline]
fn errors(machine: &Machine, pose: &PlatformPose, rho: [f64; 3]) -> ([f64; 4], Rods) {
    let g = machine.geometry();
    let rods = Rods::of(machine, pose, rho);
    let error =
        |[x, y, z]: [f64; 3], length: f64| (x * x + y * y + (z - length) * (z + length)) * (0.5 / length);
    let [b11, b12, b2, b3] = rods.vectors;
    ([error(b11, g.L1), error(b12, g.L1), error(b2, g.L2), error(b3, g.L3)], rods)
}

#[inline]
fn worst(errors: &[f64; 4]) -> f64 {
    errors[0].abs().max(errors[1].abs()).max(errors[2].abs().max(errors[3].abs()))
}

/// The size of a pose's numbers, which scales all rounding: a pose far along z is rounded with
/// its z.
#[inline]
pub(crate) fn size(machine: &Machine, z: f64) -> f64 {
    machine.derived.scale + z.abs()
}
