//! The parallel module: P given in the base frame.

use super::first_leg::{FirstLeg, LegAngle};
use super::legs::{self, Closed};
use super::obstacle;
use super::track::{LegOne, Track};
use crate::angle::angle_of;
use crate::closure::{Root, polish};
use crate::limit::{Refusal, in_domain};
use crate::machine::Machine;
use crate::pose::Point;
use crate::posture::{Posture, Postures, gathered};
use crate::residual::size;

/// Polishing moves an angle by less than this.
const NEAR: f64 = 1e-4;

/// Finds all postures (up to 16) with the platform's reference point P at `p` in the base frame.
///
/// # Units
///
/// `p` and the sliders `rho` of the postures are millimetres; z points down. alpha is in radians.
///
/// # Errors
///
/// - [`Refusal::OutOfDomain`]: a number is not finite or beyond [`DOMAIN`](crate::DOMAIN).
/// - [`Refusal::TooFar`]: a length is more than [`MOST_RATIO`](crate::MOST_RATIO) times [`Machine::longest`].
/// - [`Refusal::Blocked`]: no posture exists; the margin names the constraint that prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), the cubic (15) in cos
/// alpha, section III.C, Fig. 5.
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, Refusal, platform};
///
/// let all = platform(&Machine::verne(), [-240.0, -86.0, 1000.0])?;
/// assert_eq!(all.len(), 16);
/// assert_eq!(all.iter().filter(|posture| posture.working).count(), 1);
/// # Ok::<(), Refusal>(())
/// ```
pub fn platform(machine: &Machine, p: Point) -> Result<Postures, Refusal> {
    in_domain(machine, &p, &[])?;
    let angles = FirstLeg::new(machine, p[0], p[1]).both();
    gathered(
        |found| {
            for angle in &angles {
                legs::mirrored_postures(machine, &closed(machine, p, angle), found);
            }
        },
        || obstacle::of_all(machine, &Track::still(p)),
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
/// - [`Refusal::OutOfDomain`]: a number is not finite or beyond [`DOMAIN`](crate::DOMAIN).
/// - [`Refusal::TooFar`]: a length is more than [`MOST_RATIO`](crate::MOST_RATIO) times [`Machine::longest`].
/// - [`Refusal::Blocked`]: the working mode does not reach `p`; the margin names the constraint that prevents it.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), (15), section III.C.
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, Refusal, forward_working, platform_working};
///
/// let machine = Machine::verne();
/// let posture = platform_working(&machine, [-240.0, -86.0, 1000.0])?;
/// let back = forward_working(&machine, posture.rho)?;
/// assert!((back.pose.y - -86.0).abs() < 1e-9);
/// # Ok::<(), Refusal>(())
/// ```
#[inline]
pub fn platform_working(machine: &Machine, p: Point) -> Result<Posture, Refusal> {
    in_domain(machine, &p, &[])?;
    let leg = FirstLeg::new(machine, p[0], p[1]);
    if let Some(angle) = leg.nearest() {
        let answer = legs::working(machine, &closed(machine, p, &angle));
        if answer.is_ok() {
            return answer;
        }
    }
    second_choice(machine, p, &leg)
}

/// The posture in the working mode at either root of the cubic. Both roots can have uncrossed rods; at most one is in
/// the working mode.
#[cold]
fn second_choice(machine: &Machine, p: Point, leg: &FirstLeg<'_>) -> Result<Posture, Refusal> {
    let mut refused = None;
    for angle in leg.both() {
        match legs::working(machine, &closed(machine, p, &angle)) {
            Ok(posture) => return Ok(posture),
            Err(refusal) => refused = refused.or(Some(refusal)),
        }
    }
    Err(refused.unwrap_or_else(|| Refusal::Blocked(obstacle::of_leg_one(machine, &Track::still(p)))))
}

#[inline]
fn closed(machine: &Machine, p: Point, angle: &LegAngle) -> Closed {
    let LegAngle { c, s, w1, merged } = *angle;
    let root = Root { a: angle_of(c, s), c, s, w: w1, merged };
    let closed = Closed::new(machine, p, &root, size(machine, p[2]));
    if merged || closed.is_fine() { closed } else { polished(machine, p, &root).unwrap_or(closed) }
}

/// Newton's method on (A) itself, if the cubic has lost digits because w1 and y are both near zero.
#[cold]
fn polished(machine: &Machine, p: Point, start: &Root) -> Option<Closed> {
    let track = Track::still(p);
    let root = polish(&LegOne::new(machine, &track), *start)?;
    // The slider above stays above; its mirror image is the other one.
    let above = Root { w: root.w.max(0.0), ..root };
    ((root.a - start.a).abs() < NEAR).then(|| track.closed(machine, &above))
}
