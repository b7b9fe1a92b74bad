//! The whole machine: the tool's pose is given in the part frame.

use super::locus_solver::{every, every_working, working, working_near};
use super::platform_locus::PlatformLocus;
use crate::error::KinematicsError;
use crate::fast_math::sin_cos;
use crate::machine::Machine;
use crate::pose::PartPose;
use crate::posture::{Posture, Postures};
use crate::request_range::{check_numbers, check_proportion};

/// Finds all postures (up to 24) with the tool at `target` in the part frame.
///
/// [`table_angles`](crate::table_angles) of a posture's alpha and the target's phi1 and phi2 gives the table's angles.
/// `tool_length` is measured from P.
///
/// # Units
///
/// `target`'s position, `tool_length` and the sliders `rho` are millimetres; Z of the part frame points up from the
/// table. `target`'s phi1 and phi2 and the postures' alpha are radians.
///
/// # Errors
///
/// - [`KinematicsError::OutOfDomain`], [`KinematicsError::OutOfProportion`]: a number is out of range.
/// - [`KinematicsError::Unreachable`]: no posture exists; the margin names the constraint that prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (9), (14), (26), with (15) as
/// an equation of degree three on the circle; section III.C. The paper states sixteen solutions at most; the sextic in
/// tan(alpha/2) gives up to twenty-four.
///
/// # Examples
///
/// ```
/// use verne_solver::{KinematicsError, Machine, PartPose, part};
///
/// let target = PartPose { x: 100.0, y: 50.0, z: 300.0, phi1: 0.35, phi2: 0.5 };
/// let all = part(&Machine::verne(), &target, 150.0)?;
/// assert_eq!(all.len(), 16);
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn part(machine: &Machine, target: &PartPose, tool_length: f64) -> Result<Postures, KinematicsError> {
    every(machine, &locus(machine, target, tool_length)?)
}

/// Finds a posture in the working mode with the tool at `target` in the part frame.
///
/// Nearly always there is one at most; see [`part_every_working`].
///
/// # Units
///
/// `target`'s position, `tool_length` and the sliders `rho` are millimetres; Z of the part frame points up from the
/// table. `target`'s phi1 and phi2 and the postures' alpha are radians.
///
/// # Errors
///
/// - [`KinematicsError::OutOfDomain`], [`KinematicsError::OutOfProportion`]: a number is out of range.
/// - [`KinematicsError::Unreachable`]: the working mode does not reach `target`; the margin names the constraint that
///   prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (9), (14), (26), with (15) as
/// an equation of degree three on the circle; section III.C.
///
/// # Examples
///
/// ```
/// use verne_solver::{KinematicsError, Machine, PartPose, part_pose, part_working, table_angles};
///
/// let machine = Machine::verne();
/// let target = PartPose { x: 100.0, y: 50.0, z: 300.0, phi1: 0.35, phi2: 0.5 };
/// let posture = part_working(&machine, &target, 150.0)?;
/// let table = table_angles(&machine, posture.pose.alpha, target.phi1, target.phi2);
/// let back = part_pose(&machine, &posture.pose, table, 150.0);
/// assert!((back.x - target.x).hypot(back.y - target.y).hypot(back.z - target.z) < 1e-9);
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn part_working(
    machine: &Machine,
    target: &PartPose,
    tool_length: f64,
) -> Result<Posture, KinematicsError> {
    working(machine, &locus(machine, target, tool_length)?)
}

/// Finds all postures in the working mode with the tool at `target` in the part frame. The posture of [`part_working`]
/// is the first.
///
/// Nearly always there is one. A tool far from the tilting axis, or a long one, can have several.
///
/// # Units
///
/// `target`'s position, `tool_length` and the sliders `rho` are millimetres; Z of the part frame points up from the
/// table. `target`'s phi1 and phi2 and the postures' alpha are radians.
///
/// # Errors
///
/// - [`KinematicsError::OutOfDomain`], [`KinematicsError::OutOfProportion`]: a number is out of range.
/// - [`KinematicsError::Unreachable`]: the working mode does not reach `target`; the margin names the constraint that
///   prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (9), (14), (26), with (15) as
/// an equation of degree three on the circle; section III.C.
///
/// # Examples
///
/// ```
/// use verne_solver::{KinematicsError, Machine, PartPose, part_every_working};
///
/// let target = PartPose { x: 100.0, y: 50.0, z: 300.0, phi1: 0.35, phi2: 0.5 };
/// let all = part_every_working(&Machine::verne(), &target, 150.0)?;
/// assert!(all.iter().all(|posture| posture.working));
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn part_every_working(
    machine: &Machine,
    target: &PartPose,
    tool_length: f64,
) -> Result<Postures, KinematicsError> {
    every_working(machine, &locus(machine, target, tool_length)?)
}

/// The posture of [`part_every_working`] near another one by Newton's method, with sine and cosine of its alpha.
/// `before` is alpha of the other one, its sine and cosine, and the height of leg I, and `turns` are sine and cosine of
/// the target's phi1 and phi2. `None` if the method does not converge to a posture in the working mode.
pub(crate) fn part_working_near(
    machine: &Machine,
    target: &PartPose,
    turns: [[f64; 2]; 2],
    tool_length: f64,
    before: (f64, [f64; 2], f64),
) -> Option<(Posture, [f64; 2])> {
    let locus = turned_locus(machine, target, turns, tool_length).ok()?;
    working_near(machine, &locus, before)
}

fn locus(machine: &Machine, target: &PartPose, tool_length: f64) -> Result<PlatformLocus, KinematicsError> {
    let turns = [target.phi1, target.phi2].map(|angle| {
        let (sine, cosine) = sin_cos(angle);
        [sine, cosine]
    });
    turned_locus(machine, target, turns, tool_length)
}

fn turned_locus(
    machine: &Machine,
    target: &PartPose,
    turns: [[f64; 2]; 2],
    tool_length: f64,
) -> Result<PlatformLocus, KinematicsError> {
    let PartPose { x, y, z, phi1, phi2 } = *target;
    check_numbers(&machine.mechanism, &[x, y, z, tool_length], &[phi1, phi2])?;
    let locus = table_locus(machine, target, turns, tool_length);
    check_proportion(&machine.mechanism, &locus.y[1..])?;
    Ok(locus)
}

/// Eq (26) solved for P with theta2 = -phi2 (9) and theta1 = a - phi1 (14). P moves on a circle about the tilting axis,
/// with the radius of the last two numbers of y. `turns` are sine and cosine of phi1 and phi2.
#[inline(always)]
pub(super) fn table_locus(
    machine: &Machine,
    target: &PartPose,
    [[s1, c1], [s2, c2]]: [[f64; 2]; 2],
    tool_length: f64,
) -> PlatformLocus {
    let PartPose { x, y, z, .. } = *target;
    let table = machine.table();
    // theta2 = -phi2.
    let v1 = y * c2 - x * s2;
    let a = tool_length * s1 - v1;
    let b = table.dt - z - tool_length * c1;
    let (along, across) = (a * c1 + b * s1, a * s1 - b * c1);
    PlatformLocus { x: x * c2 + y * s2, y: [0.0, along, across], z: [table.da, -across, along] }
}
