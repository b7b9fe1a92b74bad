//! The parallel module: P given in the base frame.

use std::f64::consts::PI;

use super::first_leg::{FirstLeg, LegAngle};
use super::legs::{self, Closed, check};
use super::obstacle;
use super::track::{LegOne, Track};
use crate::closure::{Root, polish};
use crate::limit::{Refusal, in_domain};
use crate::machine::Machine;
use crate::pose::Point;
use crate::posture::{Posture, Postures, Side, gathered};
use crate::residual::size;

/// cos and sin are equally steep at this cosine.
const FLAT: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Polishing moves an angle by less than this.
const NEAR: f64 = 1e-4;

/// All postures (up to 16) with the platform at `p` in the base frame; at least one, or the refusal.
pub fn platform(machine: &Machine, p: Point) -> Result<Postures, Refusal> {
    in_domain(&p)?;
    let angles = FirstLeg::new(machine, p[0], p[1]).both();
    gathered(
        |found| {
            for angle in &angles {
                let above = closed(machine, p, angle);
                legs::postures(machine, &above, found);
                legs::postures(machine, &mirrored(&above), found);
            }
        },
        || obstacle::of_all(machine, &Track::still(p)),
    )
}

/// The posture in the working mode with the platform at `p` in the base frame.
#[inline]
pub fn platform_working(machine: &Machine, p: Point) -> Result<Posture, Refusal> {
    in_domain(&p)?;
    let leg = FirstLeg::new(machine, p[0], p[1]);
    if let Some(angle) = leg.nearest()
        && let Ok(posture) = legs::working(machine, &closed(machine, p, &angle))
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
        match legs::working(machine, &closed(machine, p, &angle)) {
            Ok(posture) => return Ok(posture),
            Err(margin) => refused = refused.or(Some(margin)),
        }
    }
    Err(Refusal::Blocked(refused.unwrap_or_else(|| obstacle::of_leg_one(machine, &Track::still(p)))))
}

#[inline]
fn closed(machine: &Machine, p: Point, angle: &LegAngle) -> Closed {
    let LegAngle { c, s, w1, merged } = *angle;
    let alpha = angle_of(c, s);
    let size = size(machine, p[2]);
    let closed = Closed { p, alpha, c, s, checked: check(alpha), w1, side: Side::Above, merged, size };
    if merged || legs::is_fine(machine, &closed) { closed } else { polished(machine, &closed) }
}

/// Newton's method on (A) itself, where the cubic has lost digits: w1 and y both near zero.
#[cold]
fn polished(machine: &Machine, closed: &Closed) -> Closed {
    let track = Track::still(closed.p);
    let start = Root::at(closed.alpha, [closed.c, closed.s], closed.w1);
    match polish(&LegOne::new(machine, &track), start) {
        Some(root) if (root.a - closed.alpha).abs() < NEAR => {
            Closed { side: Side::Above, ..track.closed(machine, &root) }
        }
        _ => *closed,
    }
}

/// Leg I closed from the other side: (c, -s, -w1) satisfies (A) with (c, s, w1).
#[inline]
fn mirrored(above: &Closed) -> Closed {
    let alpha = if above.alpha == PI { PI } else { -above.alpha };
    let [c, s] = above.checked;
    Closed { alpha, s: -above.s, checked: [c, -s], w1: -above.w1, side: Side::Below, ..*above }
}

/// The angle of a direction, in (-π, π], by the inverse function that is flat there: twice as
/// fast as the arc tangent of two arguments and as exact.
#[inline]
fn angle_of(c: f64, s: f64) -> f64 {
    let angle = if c > FLAT {
        s.asin()
    } else if c < -FLAT {
        let supplement = s.asin();
        if supplement < 0.0 { -PI - supplement } else { PI - supplement }
    } else {
        c.acos().copysign(s)
    };
    if angle <= -PI { PI } else { angle }
}
