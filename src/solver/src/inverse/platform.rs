//! The parallel module: P given in the base frame.

use super::infeasibility;
use super::leg_one_closure::LegOneClosure;
use super::leg_one_cubic::{LegOneAngle, LegOneCubic};
use super::leg_one_pose::LegOnePose;
use super::platform_locus::PlatformLocus;
use super::solutions::{add_mirrored_postures, working_posture};
use crate::error::KinematicsError;
use crate::fast_math::angle_of;
use crate::loop_closure::{Root, polish};
use crate::machine::Machine;
use crate::mechanism::Mechanism;
use crate::pose::Point;
use crate::posture::{Posture, Postures, postures_or_error};
use crate::request_range::check_numbers;
use crate::residual::magnitude;

/// Polishing moves an angle by less than this.
const LARGEST_CORRECTION: f64 = 1e-4;

/// Finds all postures (up to 16) with the platform's reference point P at `p` in the base frame.
///
/// # Units
///
/// `p` and the sliders `rho` of the postures are millimetres; z points down. alpha is in radians.
///
/// # Errors
///
/// - [`KinematicsError::OutOfDomain`], [`KinematicsError::OutOfProportion`]: a number is out of range.
/// - [`KinematicsError::Unreachable`]: no posture exists; the margin names the constraint that prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), the cubic (15) in cos
/// alpha, section III.C, Fig. 5.
///
/// # Examples
///
/// ```
/// use verne_solver::{KinematicsError, Machine, platform};
///
/// let all = platform(&Machine::verne(), [-240.0, -86.0, 1000.0])?;
/// assert_eq!(all.len(), 16);
/// assert_eq!(all.iter().filter(|posture| posture.working).count(), 1);
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn platform(machine: &Machine, p: Point) -> Result<Postures, KinematicsError> {
    let mechanism = &machine.mechanism;
    check_numbers(mechanism, &p, &[])?;
    let angles = LegOneCubic::new(mechanism, p[0], p[1]).both();
    postures_or_error(
        |found| {
            for angle in &angles {
                add_mirrored_postures(mechanism, &pose(mechanism, p, angle), found);
            }
        },
        || infeasibility::of_every_mode(machine, &PlatformLocus::fixed(p)),
    )
}

/// Finds the posture in the working mode with the platform's reference point P at `p` in the base frame.
///
/// A position has at most one. The answer equals the working posture among those of [`platform`] to the last bit.
///
/// # Units
///
/// `p` and the sliders `rho` are millimetres; z points down. alpha is in radians.
///
/// # Errors
///
/// - [`KinematicsError::OutOfDomain`], [`KinematicsError::OutOfProportion`]: a number is out of range.
/// - [`KinematicsError::Unreachable`]: the working mode does not reach `p`; the margin names the constraint that
///   prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), (15), section III.C.
///
/// # Examples
///
/// ```
/// use verne_solver::{KinematicsError, Machine, forward_working, platform_working};
///
/// let machine = Machine::verne();
/// let posture = platform_working(&machine, [-240.0, -86.0, 1000.0])?;
/// let back = forward_working(&machine, posture.rho)?;
/// assert!((back.pose.y - -86.0).abs() < 1e-9);
/// # Ok::<(), KinematicsError>(())
/// ```
#[inline]
pub fn platform_working(machine: &Machine, p: Point) -> Result<Posture, KinematicsError> {
    let mechanism = &machine.mechanism;
    check_numbers(mechanism, &p, &[])?;
    let cubic = LegOneCubic::new(mechanism, p[0], p[1]);
    if let Some(angle) = cubic.nearest() {
        let answer = working_posture(machine, &pose(mechanism, p, &angle));
        if answer.is_ok() {
            return answer;
        }
    }
    working_at_either_root(machine, p, &cubic)
}

/// The posture in the working mode at either root of the cubic. Both roots can have uncrossed rods; at most one is in
/// the working mode.
#[cold]
fn working_at_either_root(
    machine: &Machine,
    p: Point,
    cubic: &LegOneCubic<'_>,
) -> Result<Posture, KinematicsError> {
    let mut first_error = None;
    for angle in cubic.both() {
        match working_posture(machine, &pose(&machine.mechanism, p, &angle)) {
            Ok(posture) => return Ok(posture),
            Err(error) => first_error = first_error.or(Some(error)),
        }
    }
    let margin = || infeasibility::of_leg_one(machine, &PlatformLocus::fixed(p));
    Err(first_error.unwrap_or_else(|| KinematicsError::Unreachable(margin())))
}

#[inline]
fn pose(mechanism: &Mechanism, p: Point, angle: &LegOneAngle) -> LegOnePose {
    let pose = pose_at(mechanism, p, angle);
    if angle.merged || pose.is_precise() {
        pose
    } else {
        polished(mechanism, p, &root(angle)).unwrap_or(pose)
    }
}

/// The pose at an angle from the cubic alone.
#[inline(always)]
pub(super) fn pose_at(mechanism: &Mechanism, p: Point, angle: &LegOneAngle) -> LegOnePose {
    LegOnePose::new(mechanism, p, &root(angle), magnitude(mechanism, p[2]))
}

#[inline(always)]
fn root(&LegOneAngle { c, s, w1, merged }: &LegOneAngle) -> Root {
    // No negative zero.
    Root { a: angle_of(c, s) + 0.0, c, s, w: w1, merged }
}

/// Newton's method on (A) itself, if the cubic has lost digits because w1 and y are both near zero.
#[cold]
fn polished(mechanism: &Mechanism, p: Point, start: &Root) -> Option<LegOnePose> {
    let locus = PlatformLocus::fixed(p);
    let root = polish(&LegOneClosure::new(mechanism, &locus), *start)?;
    // The slider above stays above; its mirror image is the other one.
    let above = Root { w: root.w.max(0.0), ..root };
    ((root.a - start.a).abs() < LARGEST_CORRECTION).then(|| locus.pose(mechanism, &above))
}
