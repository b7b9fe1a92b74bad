//! The tool centre point given in the base frame; alpha follows.

use super::track::Track;
use crate::limit::{Refusal, in_domain};
use crate::machine::Machine;
use crate::pose::Point;
use crate::posture::{Posture, Postures};

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
/// - [`Refusal::OutOfDomain`]: a number is not finite or beyond [`DOMAIN`](crate::DOMAIN).
/// - [`Refusal::TooFar`]: a length is more than [`MOST_RATIO`](crate::MOST_RATIO) times [`Machine::longest`].
/// - [`Refusal::Blocked`]: no posture exists; the margin names the constraint that prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eq (27), with (15) as an equation
/// of degree three on the circle.
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, Refusal, tool, tool_point};
///
/// let machine = Machine::verne();
/// for posture in tool(&machine, [50.0, 120.0, 1300.0], 150.0)? {
///     let [_, y, _] = tool_point(&posture.pose, 150.0);
///     assert!((y - 120.0).abs() < 1e-9);
/// }
/// # Ok::<(), Refusal>(())
/// ```
pub fn tool(machine: &Machine, u: Point, tool_length: f64) -> Result<Postures, Refusal> {
    track(machine, u, tool_length)?.postures(machine)
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
/// - [`Refusal::OutOfDomain`]: a number is not finite or beyond [`DOMAIN`](crate::DOMAIN).
/// - [`Refusal::TooFar`]: a length is more than [`MOST_RATIO`](crate::MOST_RATIO) times [`Machine::longest`].
/// - [`Refusal::Blocked`]: the working mode does not reach `u`; the margin names the constraint that prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eq (27), with (15) as an equation
/// of degree three on the circle.
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, Refusal, tool_working};
///
/// let posture = tool_working(&Machine::verne(), [50.0, 120.0, 1300.0], 150.0)?;
/// assert!(posture.working);
/// # Ok::<(), Refusal>(())
/// ```
pub fn tool_working(machine: &Machine, u: Point, tool_length: f64) -> Result<Posture, Refusal> {
    track(machine, u, tool_length)?.working(machine)
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
/// - [`Refusal::OutOfDomain`]: a number is not finite or beyond [`DOMAIN`](crate::DOMAIN).
/// - [`Refusal::TooFar`]: a length is more than [`MOST_RATIO`](crate::MOST_RATIO) times [`Machine::longest`].
/// - [`Refusal::Blocked`]: the working mode does not reach `u`; the margin names the constraint that prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eq (27), with (15) as an equation
/// of degree three on the circle.
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, Refusal, tool_every_working};
///
/// let all = tool_every_working(&Machine::verne(), [50.0, 120.0, 1300.0], 150.0)?;
/// assert_eq!(all.len(), 1);
/// # Ok::<(), Refusal>(())
/// ```
pub fn tool_every_working(machine: &Machine, u: Point, tool_length: f64) -> Result<Postures, Refusal> {
    track(machine, u, tool_length)?.every_working(machine)
}

/// Eq (27) solved for P.
fn track(machine: &Machine, [x, y, z]: Point, tool_length: f64) -> Result<Track, Refusal> {
    in_domain(machine, &[x, y, z, tool_length], &[])?;
    Ok(Track { x, y: [y, 0.0, tool_length], z: [z, -tool_length, 0.0] })
}
