//! The check of every solution by Eqs (3)-(6) before the solver returns it.

use std::f64::consts::PI;

use nalgebra::{Matrix4, Vector4};

use crate::fast_math::{greater, sin_cos_of_turn, wrapped};
use crate::mechanism::Mechanism;
use crate::parallel_matrix::matrix;
use crate::pose::PlatformPose;
use crate::rods::{Rods, vectors_of};

/// Largest rod-length error of a solution, relative to the magnitude of its numbers. The rounding of the equations is a
/// few 1e-16 of that magnitude. An error of some hundred times as much means that it is no solution.
pub(crate) const RESIDUAL_TOLERANCE: f64 = 1e-13;
/// Relative error above which the elimination has lost digits that the equations still have. The solution is then
/// corrected by Eqs (3)-(6) themselves.
pub(crate) const CORRECTION_THRESHOLD: f64 = 1e-15;
/// Relative error above which a solution is not corrected.
const MAX_CORRECTED: f64 = 1e-9;
/// Newton steps of a correction.
const STEPS: usize = 4;
/// Newton steps from a start that is no solution.
const CLOSING_STEPS: usize = 30;
/// Step, relative to the machine, after which a correction does the rest.
const CLOSED_STEP: f64 = 1e-7;

/// A pose and its error in Eqs (3)-(6).
#[derive(Clone, Copy, Debug)]
pub(crate) struct CheckedPose {
    pub(crate) pose: PlatformPose,
    /// The largest error of a rod's length, (|B - A|² - L²) / 2L, mm.
    pub(crate) residual: f64,
}

/// Computes the error of a pose in Eqs (3)-(6) with the sliders at `rho`. If the elimination left an error, it
/// corrects the pose.
#[inline]
pub(crate) fn checked(mechanism: &Mechanism, pose: PlatformPose, rho: [f64; 3]) -> CheckedPose {
    let (found, is_rounded) = checked_once(mechanism, pose, rho);
    if is_rounded { corrected(mechanism, pose, rho) } else { found }
}

/// The pose with its error, and whether [`checked`] corrects it.
#[inline(always)]
pub(crate) fn checked_once(mechanism: &Mechanism, pose: PlatformPose, rho: [f64; 3]) -> (CheckedPose, bool) {
    let residual = largest(&errors(mechanism, &pose, rho));
    let magnitude = magnitude(mechanism, pose.z);
    // A larger error is not rounding: a correction would find another solution.
    let is_rounded = (residual > CORRECTION_THRESHOLD * magnitude) & (residual < MAX_CORRECTED * magnitude);
    (CheckedPose { pose, residual }, is_rounded)
}

/// Newton's method on (3)-(6) from any start. `None` if it does not converge.
pub(crate) fn closed(mechanism: &Mechanism, start: PlatformPose, rho: [f64; 3]) -> Option<CheckedPose> {
    let mut pose = start;
    for _ in 0..CLOSING_STEPS {
        let (next, length) = moved(mechanism, &pose, rho, &errors(mechanism, &pose, rho))?;
        pose = next;
        if length < CLOSED_STEP * mechanism.longest {
            return Some(corrected(mechanism, pose, rho));
        }
    }
    None
}

/// A pose after a Newton step, and the step's length, mm. `None` at a singularity, or if the step is out of proportion.
fn moved(
    mechanism: &Mechanism,
    pose: &PlatformPose,
    rho: [f64; 3],
    error: &[f64; 4],
) -> Option<(PlatformPose, f64)> {
    let rows = matrix(&mechanism.geometry, &Rods::of(mechanism, pose, rho));
    let jacobian = Matrix4::from_fn(|row, column| rows[row][column]);
    let step = jacobian.lu().solve(&Vector4::from(*error))?;
    let turn = step[3] / mechanism.geometry.R1;
    let (x, y, z) = (pose.x - step[0], pose.y - step[1], pose.z - step[2]);
    let moved = PlatformPose { x, y, z, alpha: wrapped(pose.alpha - turn) };
    let length = step.amax().max(turn.abs() * mechanism.longest);
    (turn.abs() <= PI && length.is_finite()).then_some((moved, length))
}

/// Newton's method on (3)-(6) in (x, y, z, a), as long as the error decreases.
#[cold]
fn corrected(mechanism: &Mechanism, pose: PlatformPose, rho: [f64; 3]) -> CheckedPose {
    let mut error = errors(mechanism, &pose, rho);
    let mut best = CheckedPose { pose, residual: largest(&error) };
    for _ in 0..STEPS {
        let Some((pose, _)) = moved(mechanism, &best.pose, rho, &error) else { break };
        error = errors(mechanism, &pose, rho);
        let residual = largest(&error);
        if residual < best.residual {
            best = CheckedPose { pose, residual };
        } else {
            break;
        }
    }
    best
}

/// The rods' length errors in Eqs (3)-(6), mm.
#[inline(always)]
pub(crate) fn errors(mechanism: &Mechanism, pose: &PlatformPose, rho: [f64; 3]) -> [f64; 4] {
    let g = &mechanism.geometry;
    let (s, c) = sin_cos_of_turn(pose.alpha);
    let vectors = vectors_of(mechanism, pose, rho, [c, s]);
    let error = |i: usize, length: f64| {
        let [x, y, z] = vectors[i];
        (x * x + y * y + (z - length) * (z + length)) * (0.5 * mechanism.inverse_lengths[i])
    };
    [error(0, g.L1), error(1, g.L1), error(2, g.L2), error(3, g.L3)]
}

#[inline(always)]
pub(crate) fn largest(errors: &[f64; 4]) -> f64 {
    let [a, b, c, d] = errors.map(f64::abs);
    greater(greater(a, b), greater(c, d))
}

/// The magnitude of a pose's numbers, which scales all rounding. A pose far along z is rounded with its z.
#[inline(always)]
pub(crate) fn magnitude(mechanism: &Mechanism, z: f64) -> f64 {
    mechanism.longest + z.abs()
}
