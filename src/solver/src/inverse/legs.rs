//! Legs II and III for a known pose of the platform, and the postures that follow.

use std::f64::consts::PI;

use super::level;
use crate::angle::sin_cos;
use crate::closure::{Root, wrapped};
use crate::limit::{Constraint, Element, Margin, Refusal};
use crate::machine::Machine;
use crate::pose::{PlatformPose, Point};
use crate::posture::{Mode, Posture, Postures, Side};
use crate::residual::{FINE, RESIDUAL_TOLERANCE, greater};

/// Threshold relative to L² below which the square of a leg's drop is zero up to rounding. The two sides of the leg
/// are then one.
const FLAT: f64 = 8.0 * f64::EPSILON;

/// A pose of the platform with leg I closed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Closed {
    /// P, mm.
    p: Point,
    alpha: f64,
    c: f64,
    s: f64,
    /// cos and sin of the returned `alpha`, not of the root that was found: the check starts from them.
    checked: [f64; 2],
    w1: f64,
    first: Leg,
    merged: bool,
    /// The size of the numbers from which P was computed: it scales their rounding.
    size: f64,
}

/// One way to close a leg: its slider's position, and the rod length's error there.
#[derive(Clone, Copy, Debug)]
struct Leg {
    rho: f64,
    side: Side,
    error: f64,
}

/// Vertical extent of leg II or III, mm. Zero if its two sides have merged.
#[derive(Clone, Copy, Debug)]
struct Drop {
    size: f64,
    merged: bool,
}

impl Closed {
    /// The platform at `p` with leg I at a root. `size` is that of the numbers from which both were computed.
    #[inline]
    pub(super) fn new(machine: &Machine, p: Point, root: &Root, size: f64) -> Self {
        let alpha = wrapped(root.a);
        let (s, c) = sin_cos(alpha);
        let first = first_leg(machine, p, [c, s], root.w);
        let Root { c: found_c, s: found_s, w: w1, merged, .. } = *root;
        Self { p, alpha, c: found_c, s: found_s, checked: [c, s], w1, first, merged, size }
    }

    /// Leg I closed from the other side, if P does not depend on the angle: (c, -s, -w1) satisfies (A) if (c, s, w1)
    /// does.
    #[inline]
    fn mirrored(&self, machine: &Machine) -> Self {
        let alpha = if self.alpha == PI { PI } else { -self.alpha };
        let checked = [self.checked[0], -self.checked[1]];
        let first = first_leg(machine, self.p, checked, -self.w1);
        Self { alpha, s: -self.s, checked, w1: -self.w1, first, ..*self }
    }

    /// Whether a rod-length error is small enough for a solution. A NaN is not.
    #[inline]
    fn holds(&self, error: f64) -> bool {
        error <= RESIDUAL_TOLERANCE * self.size
    }

    /// Whether leg I closes within the last digits.
    #[inline]
    pub(super) fn is_fine(&self) -> bool {
        self.first.error <= FINE * self.size
    }
}

/// Leg I with the returned direction (c, s) of the platform.
#[inline]
fn first_leg(machine: &Machine, [x, y, z]: Point, [c, s]: [f64; 2], w1: f64) -> Leg {
    let g = machine.geometry();
    let rho = z - w1;
    let (u, v, w) = (g.R1 * c - g.r1, g.R1 * s, z - rho);
    let x = x + machine.derived.e1;
    let scale = 0.5 * machine.derived.inverse_lengths[0];
    let error = |y: f64, z: f64| ((x * x + y * y + (z - g.L1) * (z + g.L1)) * scale).abs();
    Leg { rho, side: Side::of(w1), error: greater(error(y + u, w + v), error(y - u, w - v)) }
}

/// Leg II or III for a known pose of the platform.
#[derive(Clone, Copy, Debug)]
struct Other<'a> {
    closed: &'a Closed,
    length: f64,
    half_inverse: f64,
    x: f64,
    /// p and q with their signs: from the root that was found, and from the returned angle.
    found: [f64; 2],
    checked: [f64; 2],
}

impl<'a> Other<'a> {
    /// Legs II and III.
    #[inline]
    fn both(machine: &Machine, closed: &'a Closed) -> [Self; 2] {
        let (g, derived) = (machine.geometry(), &machine.derived);
        let [c, s] = closed.checked;
        let x = closed.p[0] + derived.e2;
        let (found, checked) = ([g.R2 * closed.c - g.r4, g.R2 * closed.s], [g.R2 * c - g.r4, g.R2 * s]);
        let leg = |sign: f64, length, inverse: f64| {
            let (found, checked) = (found.map(|arm| sign * arm), checked.map(|arm| sign * arm));
            Self { closed, length, half_inverse: 0.5 * inverse, x, found, checked }
        };
        let [_, _, inverse2, inverse3] = derived.inverse_lengths;
        [leg(-1.0, g.L2, inverse2), leg(1.0, g.L3, inverse3)]
    }

    /// The square of the leg's drop.
    #[inline]
    fn left(&self) -> f64 {
        let y = self.closed.p[1] + self.found[0];
        (self.length - self.x) * (self.length + self.x) - y * y
    }

    /// The rounding error of that square.
    fn flat(&self) -> f64 {
        FLAT * self.length * self.length
    }

    /// The leg's drop; `None` if it does not reach.
    #[inline]
    fn drop(&self) -> Option<Drop> {
        let (left, flat) = (self.left(), self.flat());
        let merged = left <= flat;
        (left >= -flat).then(|| Drop { size: if merged { 0.0 } else { left.sqrt() }, merged })
    }

    /// The leg with its slider above, and below.
    #[inline]
    fn sides(&self, drop: f64) -> [Leg; 2] {
        [self.leg(Side::Above, drop), self.leg(Side::Below, drop)]
    }

    #[inline]
    fn leg(&self, side: Side, drop: f64) -> Leg {
        let [_, y, z] = self.closed.p;
        let rho = z + self.found[1] - side.sign() * drop;
        let (y, z) = (y + self.checked[0], z + self.checked[1] - rho);
        let square = self.x * self.x + y * y + (z - self.length) * (z + self.length);
        Leg { rho, side, error: (square * self.half_inverse).abs() }
    }
}

/// The drops of legs II and III; `None` if one does not reach.
#[inline]
fn drops(legs: &[Other<'_>; 2]) -> Option<[Drop; 2]> {
    Some([legs[0].drop()?, legs[1].drop()?])
}

/// All postures of a closed leg I.
#[inline]
pub(super) fn postures(machine: &Machine, closed: &Closed, found: &mut Postures) {
    let legs = Other::both(machine, closed);
    if let Some(drops) = drops(&legs) {
        add(machine, closed, &legs, drops, found);
    }
}

/// All postures of a closed leg I and of its mirror image: the drops depend on c alone.
#[inline]
pub(super) fn mirrored_postures(machine: &Machine, above: &Closed, found: &mut Postures) {
    let legs = Other::both(machine, above);
    if let Some(drops) = drops(&legs) {
        add(machine, above, &legs, drops, found);
        // A level leg I with a level platform equals its own mirror image.
        if above.s != 0.0 || above.w1 != 0.0 {
            let below = above.mirrored(machine);
            add(machine, &below, &Other::both(machine, &below), drops, found);
        }
    }
}

#[inline]
fn add(
    machine: &Machine,
    closed: &Closed,
    [second, third]: &[Other<'_>; 2],
    drops: [Drop; 2],
    found: &mut Postures,
) {
    let (seconds, thirds) = (second.sides(drops[0].size), third.sides(drops[1].size));
    let merged = drops[0].merged || drops[1].merged;
    let holds = |leg: &Leg| closed.holds(leg.error);
    let all_hold = holds(&closed.first) && seconds.iter().chain(&thirds).all(holds);
    // Nearly always all four exist, and none needs a special case.
    if !merged && all_hold && found.remaining_capacity() >= 4 {
        for leg2 in &seconds {
            for leg3 in &thirds {
                found.push(posture(machine, closed, [leg2, leg3], false));
            }
        }
        return;
    }
    add_those_that_hold(
        machine,
        closed,
        [&seconds[usize::from(drops[0].merged)..], &thirds[usize::from(drops[1].merged)..]],
        merged,
        found,
    );
}

/// Like [`add`], for the case that two sides have merged (and count once) or that a posture does not satisfy Eqs
/// (3)-(6).
#[cold]
fn add_those_that_hold(
    machine: &Machine,
    closed: &Closed,
    [seconds, thirds]: [&[Leg]; 2],
    merged: bool,
    found: &mut Postures,
) {
    for leg2 in seconds {
        for leg3 in thirds {
            let holds = [&closed.first, leg2, leg3].iter().all(|leg| closed.holds(leg.error));
            // Leg I has at most six angles, and each has at most four postures: the capacity suffices.
            if holds && !found.is_full() {
                found.push(posture(machine, closed, [leg2, leg3], merged));
            }
        }
    }
}

/// The posture of a closed leg I and these two.
#[inline]
fn posture(machine: &Machine, closed: &Closed, [leg2, leg3]: [&Leg; 2], merged: bool) -> Posture {
    let g = machine.geometry();
    let (u, v) = (g.R1 * closed.c - g.r1, g.R1 * closed.s);
    let above = leg2.side == Side::Above && leg3.side == Side::Above;
    let [x, y, z] = closed.p;
    Posture {
        pose: PlatformPose { x, y, z, alpha: closed.alpha },
        rho: [closed.first.rho, leg2.rho, leg3.rho],
        mode: Mode { legs: [closed.first.side, leg2.side, leg3.side], crossed: u < 0.0 },
        working: above && !merged && u > 0.0 && closed.w1 > v.abs(),
        merged: merged || closed.merged,
        residual: greater(closed.first.error, greater(leg2.error, leg3.error)),
    }
}

/// The posture with all sliders above, if it is in the working mode; otherwise the constraint that prevents it.
#[inline]
pub(super) fn working(machine: &Machine, closed: &Closed) -> Result<Posture, Refusal> {
    let [second, third] = Other::both(machine, closed);
    let (left2, left3) = (second.left(), third.left());
    // A leg whose two sides have merged belongs to no mode.
    if left2 <= second.flat() || left3 <= third.flat() {
        return Err(Refusal::Blocked(out_of_reach(left2 - second.flat(), left3 - third.flat())));
    }
    let (leg2, leg3) = (second.leg(Side::Above, left2.sqrt()), third.leg(Side::Above, left3.sqrt()));
    let posture = posture(machine, closed, [&leg2, &leg3], false);
    let holds = [closed.first, leg2, leg3].iter().all(|leg| closed.holds(leg.error));
    if posture.working && holds {
        return Ok(posture);
    }
    Err(Refusal::Blocked(out_of_mode(machine, closed).unwrap_or_else(|| out_of_reach(-0.0, -0.0))))
}

/// The leg that is too short; of two the shorter one.
#[cold]
fn out_of_reach(second: f64, third: f64) -> Margin {
    let (leg, left) = if second <= third { (2, second) } else { (3, third) };
    Margin { constraint: Constraint::LegLength, element: Element::Leg(leg), value: level::signed_root(left) }
}

/// The constraint that keeps a closed leg I out of the working mode: its rods cross, or a slider end lies lower than
/// its platform end. `None` if there is none.
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

/// The constraint that prevents legs II and III from reaching a pose, if there is one.
#[cold]
pub(super) fn reach_of_others(machine: &Machine, closed: &Closed) -> Option<Margin> {
    let [second, third] = Other::both(machine, closed).map(|leg| leg.left());
    (second < 0.0 || third < 0.0).then(|| out_of_reach(second, third))
}
