//! The parallel module: P given in the base frame.

use super::first_leg::{FirstLeg, LegAngle};
use super::legs::{self, Closed};
use super::obstacle;
use super::track::Track;
use crate::limit::{Refusal, in_domain};
use crate::machine::Machine;
use crate::pose::Point;
use crate::posture::{Posture, Postures, Side};

/// All postures (up to 16) with the platform at `p` in the base frame; at least one, or the refusal.
pub fn platform(machine: &Machine, p: Point) -> Result<Postures, Refusal> {
    in_domain(&p)?;
    let mut postures = Postures::new();
    for angle in FirstLeg::new(machine, p[0], p[1]).both() {
        // The mirror image closes leg I from the other side: (c, -s, -w1).
        for side in [Side::Above, Side::Below] {
            legs::postures(machine, &closed(p, &angle, side), &mut postures);
        }
    }
    if postures.is_empty() {
        Err(Refusal::Blocked(obstacle::of_all(machine, &Track::still(p))))
    } else {
        Ok(postures)
    }
}

/// The posture in the working mode with the platform at `p` in the base frame.
#[inline]
pub fn platform_working(machine: &Machine, p: Point) -> Result<Posture, Refusal> {
    in_domain(&p)?;
    let leg = FirstLeg::new(machine, p[0], p[1]);
    if let Some(angle) = leg.nearest()
        && let Ok(posture) = legs::working(machine, &closed(p, &angle, Side::Above))
    {
        return Ok(posture);
    }
    second_choice(machine, p, &leg)
}

/// The cubic can have both roots where the rods do not cross, and the working mode is then at
/// either; it is never at both.
#[cold]
fn second_choice(machine: &Machine, p: Point, leg: &FirstLeg<'_>) -> Result<Posture, Refusal> {
    let mut refused = None;
    for angle in leg.both() {
        match legs::working(machine, &closed(p, &angle, Side::Above)) {
            Ok(posture) => return Ok(posture),
            Err(margin) => refused = refused.or(Some(margin)),
        }
    }
    Err(Refusal::Blocked(refused.unwrap_or_else(|| obstacle::of_leg_one(machine, &Track::still(p)))))
}

#[inline]
fn closed(p: Point, angle: &LegAngle, side: Side) -> Closed {
    let sign = side.sign();
    Closed { p, c: angle.c, s: sign * angle.s, w1: sign * angle.w1, side, merged: angle.merged }
}
