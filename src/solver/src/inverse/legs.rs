//! Legs II and III with the platform's pose known, and the postures that come of it.

use arrayvec::ArrayVec;

use crate::closure::angle_of;
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::pose::{PlatformPose, Point};
use crate::posture::{Mode, Posture, Postures, Side};
use crate::residual::tolerance;

/// Relative to L², what is left for a leg's drop is zero up to rounding: its two sides are one.
const FLAT: f64 = 8.0 * f64::EPSILON;

/// A pose of the platform with leg I closed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Closed {
    /// P, mm.
    pub(super) p: Point,
    pub(super) c: f64,
    pub(super) s: f64,
    pub(super) w1: f64,
    pub(super) side: Side,
    pub(super) merged: bool,
}

/// One way to close a leg: its slider's position, and the rod length's error there.
#[derive(Clone, Copy, Debug)]
struct Leg {
    rho: f64,
    side: Side,
    merged: bool,
    error: f64,
}

/// What the three legs share, from the pose and, for the check, from its alpha alone.
#[derive(Clone, Copy, Debug)]
struct Platform<'a> {
    machine: &'a Machine,
    pose: PlatformPose,
    u: f64,
    v: f64,
    p: f64,
    q: f64,
    x2: f64,
    checked: [f64; 2],
}

impl<'a> Platform<'a> {
    #[inline]
    fn new(machine: &'a Machine, closed: &Closed) -> Self {
        let g = machine.geometry();
        let [x, y, z] = closed.p;
        let alpha = angle_of(closed.c, closed.s);
        let (s, c) = alpha.sin_cos();
        Self {
            machine,
            pose: PlatformPose { x, y, z, alpha },
            u: g.R1 * closed.c - g.r1,
            v: g.R1 * closed.s,
            p: g.R2 * closed.c - g.r4,
            q: g.R2 * closed.s,
            x2: x + machine.derived.e2,
            checked: [c, s],
        }
    }

    /// Leg I, closed already.
    #[inline]
    fn first(&self, closed: &Closed) -> Leg {
        let g = self.machine.geometry();
        let rho = self.pose.z - closed.w1;
        let [c, s] = self.checked;
        let (u, v, w) = (g.R1 * c - g.r1, g.R1 * s, self.pose.z - rho);
        let x = self.pose.x + self.machine.derived.e1;
        let error = |y: f64, z: f64| ((x * x + y * y + (z - g.L1) * (z + g.L1)) * (0.5 / g.L1)).abs();
        let error = error(self.pose.y + u, w + v).max(error(self.pose.y - u, w - v));
        Leg { rho, side: closed.side, merged: closed.merged, error }
    }

    /// What leg II (`sign` -1) or III (+1) has left for its drop, squared; and its length.
    #[inline]
    fn left(&self, sign: f64) -> (f64, f64) {
        let g = self.machine.geometry();
        let length = if sign < 0.0 { g.L2 } else { g.L3 };
        let y = self.pose.y + sign * self.p;
        ((length - self.x2) * (length + self.x2) - y * y, length)
    }

    #[inline]
    fn leg(&self, sign: f64, side: Side, drop: f64, length: f64, merged: bool) -> Leg {
        let g = self.machine.geometry();
        let rho = self.pose.z + sign * self.q - side.sign() * drop;
        let [c, s] = self.checked;
        let y = self.pose.y + sign * (g.R2 * c - g.r4);
        let z = self.pose.z + sign * g.R2 * s - rho;
        let error = (self.x2 * self.x2 + y * y + (z - length) * (z + length)) * (0.5 / length);
        Leg { rho, side, merged, error: error.abs() }
    }

    /// Both sides of leg II or III, one if they have merged, none if it does not reach.
    #[inline]
    fn sides(&self, sign: f64) -> ArrayVec<Leg, 2> {
        let (left, length) = self.left(sign);
        let flat = FLAT * length * length;
        let mut legs = ArrayVec::new();
        if left > flat {
            let drop = left.sqrt();
            legs.push(self.leg(sign, Side::Above, drop, length, false));
            legs.push(self.leg(sign, Side::Below, drop, length, false));
        } else if left >= -flat {
            legs.push(self.leg(sign, Side::Above, 0.0, length, true));
        }
        legs
    }

    #[inline]
    fn posture(&self, legs: [&Leg; 3]) -> Option<Posture> {
        let residual = legs[0].error.max(legs[1].error).max(legs[2].error);
        let sides = legs.map(|leg| leg.side);
        let drop = self.pose.z - legs[0].rho;
        let merged = legs.iter().any(|leg| leg.merged);
        let unfolded = !legs[1].merged && !legs[2].merged;
        let working = sides == [Side::Above; 3] && self.u > 0.0 && drop > self.v.abs() && unfolded;
        (residual <= tolerance(self.machine, self.pose.z)).then_some(Posture {
            pose: self.pose,
            rho: [legs[0].rho, legs[1].rho, legs[2].rho],
            mode: Mode { legs: sides, crossed: self.u < 0.0 },
            working,
            merged,
            residual,
        })
    }
}

/// All postures of a closed leg I.
#[inline]
pub(super) fn postures(machine: &Machine, closed: &Closed, found: &mut Postures) {
    let platform = Platform::new(machine, closed);
    let first = platform.first(closed);
    let third = platform.sides(1.0);
    for second in platform.sides(-1.0) {
        for third in &third {
            if !found.is_full() {
                found.extend(platform.posture([&first, &second, third]));
            }
        }
    }
}

/// The posture with all sliders above, if it is in the working mode; else what prevents it.
#[inline]
pub(super) fn working(machine: &Machine, closed: &Closed) -> Result<Posture, Margin> {
    let platform = Platform::new(machine, closed);
    let first = platform.first(closed);
    let [(second, l2), (third, l3)] = [platform.left(-1.0), platform.left(1.0)];
    if second <= 0.0 || third <= 0.0 {
        return Err(out_of_reach(second, third));
    }
    let legs = [
        &first,
        &platform.leg(-1.0, Side::Above, second.sqrt(), l2, false),
        &platform.leg(1.0, Side::Above, third.sqrt(), l3, false),
    ];
    match platform.posture(legs) {
        Some(posture) if posture.working => Ok(posture),
        _ => Err(platform.out_of_mode(closed)),
    }
}

/// The leg that is short, or shorter of the two.
#[cold]
pub(super) fn out_of_reach(second: f64, third: f64) -> Margin {
    let (leg, left) = if second <= third { (2, second) } else { (3, third) };
    Margin { constraint: Constraint::LegLength, element: Element::Leg(leg), value: signed_root(left) }
}

/// √x with the sign of x: a length that goes through zero with it.
pub(super) fn signed_root(x: f64) -> f64 {
    x.abs().sqrt().copysign(x)
}

impl Platform<'_> {
    /// Leg I is closed, but its rods cross or a slider end lies below its platform end.
    #[cold]
    fn out_of_mode(&self, closed: &Closed) -> Margin {
        let g = self.machine.geometry();
        if self.u <= 0.0 {
            return Margin { constraint: Constraint::RodCrossing, element: Element::Leg(1), value: self.u };
        }
        let (rod, drop) = if self.v > 0.0 { (12, closed.w1 - self.v) } else { (11, closed.w1 + self.v) };
        let value = drop / g.L1 - self.machine.limits().serial_margin;
        Margin { constraint: Constraint::SerialSingularity, element: Element::Rod(rod), value }
    }
}

/// What keeps legs II and III from reaching a pose at all, if anything does.
#[cold]
pub(super) fn reach_of_others(machine: &Machine, closed: &Closed) -> Option<Margin> {
    let platform = Platform::new(machine, closed);
    let (second, third) = (platform.left(-1.0).0, platform.left(1.0).0);
    (second < 0.0 || third < 0.0).then(|| out_of_reach(second, third))
}
