//! Legs II and III with the platform's pose known, and the postures that come of it.

use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::pose::{PlatformPose, Point};
use crate::posture::{Mode, Posture, Postures, Side};
use crate::residual::{FINE, RESIDUAL_TOLERANCE};

/// Relative to L², what is left for a leg's drop is zero up to rounding: its two sides are one.
const FLAT: f64 = 8.0 * f64::EPSILON;

/// A pose of the platform with leg I closed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Closed {
    /// P, mm.
    pub(super) p: Point,
    pub(super) alpha: f64,
    pub(super) c: f64,
    pub(super) s: f64,
    /// cos and sin of `alpha` itself, for the check: see [`check`].
    pub(super) checked: [f64; 2],
    pub(super) w1: f64,
    pub(super) side: Side,
    pub(super) merged: bool,
    /// The size of the numbers that P was found from: its rounding.
    pub(super) size: f64,
}

/// cos and sin of the angle that is given out. The check of a solution starts from them, not from
/// the c and s that it was found with.
#[inline]
pub(super) fn check(alpha: f64) -> [f64; 2] {
    let (s, c) = alpha.sin_cos();
    [c, s]
}

/// One way to close a leg: its slider's position, and the rod length's error there.
#[derive(Clone, Copy, Debug)]
struct Leg {
    rho: f64,
    side: Side,
    error: f64,
}

/// Both sides of leg II or III, the same one twice if they have merged.
#[derive(Clone, Copy, Debug)]
struct Sides {
    legs: [Leg; 2],
    merged: bool,
}

/// A closed platform and what the other legs need of it.
#[derive(Clone, Copy, Debug)]
struct Platform<'a> {
    machine: &'a Machine,
    closed: &'a Closed,
    u: f64,
    v: f64,
    p: f64,
    q: f64,
    x2: f64,
    /// p and q again, from the angle that is given out, for the check.
    checked: [f64; 2],
    tolerance: f64,
}

impl<'a> Platform<'a> {
    /// The platform and its leg I, whose error is found from the angle that is given out.
    #[inline]
    fn new(machine: &'a Machine, closed: &'a Closed) -> (Self, Leg) {
        let g = machine.geometry();
        let [c, s] = closed.checked;
        let platform = Self {
            machine,
            closed,
            u: g.R1 * closed.c - g.r1,
            v: g.R1 * closed.s,
            p: g.R2 * closed.c - g.r4,
            q: g.R2 * closed.s,
            x2: closed.p[0] + machine.derived.e2,
            checked: [g.R2 * c - g.r4, g.R2 * s],
            tolerance: RESIDUAL_TOLERANCE * closed.size,
        };
        let [x, y, z] = closed.p;
        let rho = z - closed.w1;
        let (u, v, w) = (g.R1 * c - g.r1, g.R1 * s, z - rho);
        let x = x + machine.derived.e1;
        let error = |y: f64, z: f64| ((x * x + y * y + (z - g.L1) * (z + g.L1)) * (0.5 / g.L1)).abs();
        let error = error(y + u, w + v).max(error(y - u, w - v));
        (platform, Leg { rho, side: closed.side, error })
    }

    /// Rod length of leg II (`sign` -1) or III (+1).
    #[inline]
    fn length(&self, sign: f64) -> f64 {
        let g = self.machine.geometry();
        if sign < 0.0 { g.L2 } else { g.L3 }
    }

    /// What leg II or III has left for its drop, squared.
    #[inline]
    fn left(&self, sign: f64) -> f64 {
        let length = self.length(sign);
        let y = self.closed.p[1] + sign * self.p;
        (length - self.x2) * (length + self.x2) - y * y
    }

    #[inline]
    fn leg(&self, sign: f64, side: Side, drop: f64) -> Leg {
        let [_, y, z] = self.closed.p;
        let length = self.length(sign);
        let rho = z + sign * self.q - side.sign() * drop;
        let [p, q] = self.checked;
        let (y, z) = (y + sign * p, z + sign * q - rho);
        let error = (self.x2 * self.x2 + y * y + (z - length) * (z + length)) * (0.5 / length);
        Leg { rho, side, error: error.abs() }
    }

    /// Both sides of leg II or III; none if it does not reach.
    #[inline]
    fn sides(&self, sign: f64) -> Option<Sides> {
        let left = self.left(sign);
        let flat = FLAT * self.length(sign) * self.length(sign);
        if left < -flat {
            return None;
        }
        let merged = left <= flat;
        let drop = if merged { 0.0 } else { left.sqrt() };
        let legs = [self.leg(sign, Side::Above, drop), self.leg(sign, Side::Below, drop)];
        Some(Sides { legs, merged })
    }

    /// The posture with these legs; `None` if it does not satisfy Eqs (3)-(6).
    #[inline]
    fn posture(&self, legs: [&Leg; 3], merged: bool) -> Option<Posture> {
        let residual = legs[0].error.max(legs[1].error).max(legs[2].error);
        let above = legs[0].side == Side::Above && legs[1].side == Side::Above && legs[2].side == Side::Above;
        let [x, y, z] = self.closed.p;
        (residual <= self.tolerance).then_some(Posture {
            pose: PlatformPose { x, y, z, alpha: self.closed.alpha },
            rho: [legs[0].rho, legs[1].rho, legs[2].rho],
            mode: Mode { legs: [legs[0].side, legs[1].side, legs[2].side], crossed: self.u < 0.0 },
            working: above && !merged && self.u > 0.0 && self.closed.w1 > self.v.abs(),
            merged: merged || self.closed.merged,
            residual,
        })
    }
}

/// Whether leg I closes to the last digits.
#[inline]
pub(super) fn is_fine(machine: &Machine, closed: &Closed) -> bool {
    Platform::new(machine, closed).1.error <= FINE * closed.size
}

/// All postures of a closed leg I.
#[inline]
pub(super) fn postures(machine: &Machine, closed: &Closed, found: &mut Postures) {
    let (platform, first) = Platform::new(machine, closed);
    let (Some(second), Some(third)) = (platform.sides(-1.0), platform.sides(1.0)) else { return };
    let merged = second.merged || third.merged;
    for leg2 in &second.legs[usize::from(second.merged)..] {
        for leg3 in &third.legs[usize::from(third.merged)..] {
            // At most six angles of leg I exist, and four postures of each: there is room.
            if let Some(posture) = platform.posture([&first, leg2, leg3], merged)
                && !found.is_full()
            {
                found.push(posture);
            }
        }
    }
}

/// The posture with all sliders above, if it is in the working mode; else what prevents it.
#[inline]
pub(super) fn working(machine: &Machine, closed: &Closed) -> Result<Posture, Margin> {
    let (platform, first) = Platform::new(machine, closed);
    let (second, third) = (platform.left(-1.0), platform.left(1.0));
    if second <= 0.0 || third <= 0.0 {
        return Err(out_of_reach(second, third));
    }
    let second = platform.leg(-1.0, Side::Above, second.sqrt());
    let third = platform.leg(1.0, Side::Above, third.sqrt());
    match platform.posture([&first, &second, &third], false) {
        Some(posture) if posture.working => Ok(posture),
        _ => Err(out_of_mode(machine, closed).unwrap_or_else(|| out_of_reach(-0.0, -0.0))),
    }
}

/// The leg that is short, or shorter of the two.
#[cold]
fn out_of_reach(second: f64, third: f64) -> Margin {
    let (leg, left) = if second <= third { (2, second) } else { (3, third) };
    Margin { constraint: Constraint::LegLength, element: Element::Leg(leg), value: signed_root(left) }
}

/// √x with the sign of x: a length that goes through zero with it.
pub(super) fn signed_root(x: f64) -> f64 {
    x.abs().sqrt().copysign(x)
}

/// What keeps a closed leg I out of the working mode: its rods cross, or a slider end lies lower
/// than its platform end; `None` if nothing does.
#[cold]
pub(super) fn out_of_mode(machine: &Machine, closed: &Closed) -> Option<Margin> {
    let g = machine.geometry();
    let (u, v) = (g.R1 * closed.c - g.r1, g.R1 * closed.s);
    if u <= 0.0 {
        return Some(Margin { constraint: Constraint::RodCrossing, element: Element::Leg(1), value: u });
    }
    let (rod, drop) = if v > 0.0 { (12, closed.w1 - v) } else { (11, closed.w1 + v) };
    let value = drop / g.L1 - machine.limits().serial_margin;
    let margin = Margin { constraint: Constraint::SerialSingularity, element: Element::Rod(rod), value };
    (drop <= 0.0).then_some(margin)
}

/// What keeps legs II and III from reaching a pose at all, if anything does.
#[cold]
pub(super) fn reach_of_others(machine: &Machine, closed: &Closed) -> Option<Margin> {
    let (platform, _) = Platform::new(machine, closed);
    let (second, third) = (platform.left(-1.0), platform.left(1.0));
    (second < 0.0 || third < 0.0).then(|| out_of_reach(second, third))
}
