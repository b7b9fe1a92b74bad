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

/// All postures (up to 16) with the platform at `p` in the base frame; at least one, or the refusal.
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

/// The posture in the working mode with the platform at `p` in the base frame.
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

/// The cubic can have both roots where the rods do not cross, and the working mode is then at
/// either; it is never at both.
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

/// Newton's method on (A) itself, where the cubic has lost digits: w1 and y both near zero.
#[cold]
fn polished(machine: &Machine, p: Point, start: &Root) -> Option<Closed> {
    let track = Track::still(p);
    let root = polish(&LegOne::new(machine, &track), *start)?;
    // The slider above stays above; its mirror image is the other one.
    let above = Root { w: root.w.max(0.0), ..root };
    ((root.a - start.a).abs() < NEAR).then(|| track.closed(machine, &above))
}
