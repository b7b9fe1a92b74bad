//! The tool centre point given in the base frame; alpha follows.

use super::locus_solver::{every, every_working, working};
use super::platform_locus::PlatformLocus;
use crate::error::KinematicsError;
use crate::machine::Machine;
use crate::pose::Point;
use crate::posture::{Posture, Postures};
use crate::request_range::check_numbers;

/// Finds all postures (up to 24) with the tool centre point at `u` in the base frame.
///
/// The tool lies along the platform's axis; alpha follows from `u`. `tool_length` is measured from P.
///
/// # Units
///
/// `u`, `tool_length` and the sliders `rho` are millimetres; z points down. alpha is in radians.
///
/// # Errors
///
/// - [`KinematicsError::OutOfDomain`], [`KinematicsError::OutOfProportion`]: a number is out of range.
/// - [`KinematicsError::Unreachable`]: no posture exists; the margin names the constraint that prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eq (27), with (15) as an equation
/// of degree three on the circle.
///
/// # Examples
///
/// ```
/// use verne_solver::{KinematicsError, Machine, tool, tool_point};
///
/// let machine = Machine::verne();
/// for posture in tool(&machine, [50.0, 120.0, 1300.0], 150.0)? {
///     let [_, y, _] = tool_point(&posture.pose, 150.0);
///     assert!((y - 120.0).abs() < 1e-9);
/// }
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn tool(machine: &Machine, u: Point, tool_length: f64) -> Result<Postures, KinematicsError> {
    every(machine, &locus(machine, u, tool_length)?)
}

/// Finds a posture in the working mode with the tool centre point at `u` in the base frame.
///
/// Nearly always there is one at most; see [`tool_every_working`].
///
/// # Units
///
/// `u`, `tool_length` and the sliders `rho` are millimetres; z points down. alpha is in radians.
///
/// # Errors
///
/// - [`KinematicsError::OutOfDomain`], [`KinematicsError::OutOfProportion`]: a number is out of range.
/// - [`KinematicsError::Unreachable`]: the working mode does not reach `u`; the margin names the constraint that
///   prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eq (27), with (15) as an equation
/// of degree three on the circle.
///
/// # Examples
///
/// ```
/// use verne_solver::{KinematicsError, Machine, tool_working};
///
/// let posture = tool_working(&Machine::verne(), [50.0, 120.0, 1300.0], 150.0)?;
/// assert!(posture.working);
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn tool_working(machine: &Machine, u: Point, tool_length: f64) -> Result<Posture, KinematicsError> {
    working(machine, &locus(machine, u, tool_length)?)
}

/// Finds all postures in the working mode with the tool centre point at `u` in the base frame. The posture of
/// [`tool_working`] is the first.
///
/// Nearly always there is one. A tool far from the tilting axis, or a long one, can have several.
///
/// # Units
///
/// `u`, `tool_length` and the sliders `rho` are millimetres; z points down. alpha is in radians.
///
/// # Errors
///
/// - [`KinematicsError::OutOfDomain`], [`KinematicsError::OutOfProportion`]: a number is out of range.
/// - [`KinematicsError::Unreachable`]: the working mode does not reach `u`; the margin names the constraint that
///   prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eq (27), with (15) as an equation
/// of degree three on the circle.
///
/// # Examples
///
/// ```
/// use verne_solver::{KinematicsError, Machine, tool_every_working};
///
/// let all = tool_every_working(&Machine::verne(), [50.0, 120.0, 1300.0], 150.0)?;
/// assert_eq!(all.len(), 1);
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn tool_every_working(
    machine: &Machine,
    u: Point,
    tool_length: f64,
) -> Result<Postures, KinematicsError> {
    every_working(machine, &locus(machine, u, tool_length)?)
}

fn locus(machine: &Machine, [x, y, z]: Point, tool_length: f64) -> Result<PlatformLocus, KinematicsError> {
    check_numbers(&machine.mechanism, &[x, y, z, tool_length], &[])?;
    Ok(tool_locus([x, y, z], tool_length))
}

/// Eq (27) solved for P.
#[inline(always)]
pub(super) fn tool_locus([x, y, z]: Point, tool_length: f64) -> PlatformLocus {
    PlatformLocus { x, y: [y, 0.0, tool_length], z: [z, -tool_length, 0.0] }
}
