//! P as a function of the platform angle, and leg I's loop closure along it.

use std::f64::consts::PI;

use super::legs::{self, Closed};
use super::level;
use super::obstacle;
use super::platform::{platform, platform_working};
use crate::circle::{TrigPolynomial, linear};
use crate::closure::{Closure, Equations, LAST_STEP, Root, Roots, find_roots, from_level, wrapped};
use crate::limit::Refusal;
use crate::machine::Machine;
use crate::pose::Point;
use crate::posture::{Posture, Postures, gathered};
use crate::residual::{RESIDUAL_TOLERANCE, size};

/// Relative rounding error of a leg that is nearly level: its drop has all its digits.
const LEVEL_NOISE: f64 = 1e-14;

/// P = (x, y0 + yc cos a + ys sin a, z0 + zc cos a + zs sin a): the position of the platform for each of its angles,
/// for a tool given in the base or the part frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Track {
    pub(super) x: f64,
    pub(super) y: [f64; 3],
    pub(super) z: [f64; 3],
}

impl Track {
    /// A platform that stays at one point.
    pub(super) fn still([x, y, z]: Point) -> Self {
        Self { x, y: [y, 0.0, 0.0], z: [z, 0.0, 0.0] }
    }

    #[inline]
    pub(super) fn at(&self, c: f64, s: f64) -> Point {
        let ([y0, yc, ys], [z0, zc, zs]) = (self.y, self.z);
        [self.x, y0 + yc * c + ys * s, z0 + zc * c + zs * s]
    }

    /// The point, if P does not depend on the angle.
    fn fixed(&self) -> Option<Point> {
        (self.y[1..] == [0.0, 0.0] && self.z[1..] == [0.0, 0.0]).then_some([self.x, self.y[0], self.z[0]])
    }

    /// All postures along the track.
    pub(super) fn postures(&self, machine: &Machine) -> Result<Postures, Refusal> {
        if let Some(p) = self.fixed() {
            return platform(machine, p);
        }
        let leg = LegOne::new(machine, self);
        let mut roots = Roots::new();
        // The working mode's posture is the one that `working` answers, to the last bit.
        find_roots(&leg, PI, from_level(&leg), &mut roots);
        gathered(
            |found| roots.iter().for_each(|root| legs::postures(machine, &self.closed(machine, root), found)),
            || obstacle::of_all(machine, self),
        )
    }

    /// The posture in the working mode along the track.
    #[inline]
    pub(super) fn working(&self, machine: &Machine) -> Result<Posture, Refusal> {
        if let Some(p) = self.fixed() {
            return platform_working(machine, p);
        }
        let leg = LegOne::new(machine, self);
        let level = from_level(&leg);
        if let Some(root) = &level {
            let answer = legs::working(machine, &self.closed(machine, root));
            if answer.is_ok() {
                return answer;
            }
        }
        self.among_all(machine, &leg, level).map(|postures| postures[0])
    }

    /// All postures in the working mode along the track, that of [`Self::working`] first. There is at least one, or
    /// the function refuses.
    pub(super) fn every_working(&self, machine: &Machine) -> Result<Postures, Refusal> {
        if let Some(p) = self.fixed() {
            return platform_working(machine, p).map(|posture| [posture].into_iter().collect());
        }
        let leg = LegOne::new(machine, self);
        let level = from_level(&leg);
        let mut found = self.among_all(machine, &leg, level)?;
        let first =
            level.and_then(|level| found.iter().position(|posture| posture.pose.alpha == wrapped(level.a)));
        found.swap(0, first.unwrap_or(0));
        Ok(found)
    }

    /// The working mode among all roots of the sheet at which leg I's rods do not cross.
    #[cold]
    fn among_all(&self, machine: &Machine, leg: &LegOne, level: Option<Root>) -> Result<Postures, Refusal> {
        let (mut found, mut refused) = (Postures::new(), None);
        let mut roots = Roots::new();
        find_roots(leg, machine.derived.uncrossed, level, &mut roots);
        for root in roots.iter().filter(|root| root.w >= 0.0) {
            match legs::working(machine, &self.closed(machine, root)) {
                Ok(posture) => found.push(posture),
                Err(refusal) => refused = refused.or(Some(refusal)),
            }
        }
        if found.is_empty() {
            return Err(refused.unwrap_or_else(|| Refusal::Blocked(obstacle::of_leg_one(machine, self))));
        }
        Ok(found)
    }

    /// The platform's pose at a root of leg I's closure.
    #[inline]
    pub(super) fn closed(&self, machine: &Machine, root: &Root) -> Closed {
        let p = self.at(root.c, root.s);
        Closed::new(machine, p, root, size(machine, p[2]) + self.y[1].abs() + self.y[2].abs())
    }
}

/// Leg I along a track: y u + w1 v = 0 and X1² + y² + C - k cos a + w1² = L1², equations (A), in
/// (a, w1). Eliminating w1 gives (15), of the third degree on the circle.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegOne {
    y: [f64; 3],
    r1_platform: f64,
    r1_slider: f64,
    c: f64,
    k: f64,
    /// L1² - X1² - C.
    e: f64,
    /// E + k and E - k.
    ends: [f64; 2],
    /// Whether one of them is small: leg I can then be level near this x, y and angle.
    level: bool,
    scale: f64,
    last_step: f64,
}

impl LegOne {
    #[inline]
    pub(super) fn new(machine: &Machine, track: &Track) -> Self {
        let g = machine.geometry();
        let derived = &machine.derived;
        let at_zero = level::at_zero(machine, track.x);
        let ends = [at_zero, level::at_half_a_turn(machine, track.x, at_zero)];
        Self {
            y: track.y,
            r1_platform: g.R1,
            r1_slider: g.r1,
            c: derived.c,
            k: derived.k,
            e: ends[0] - derived.k,
            ends,
            level: ends.iter().any(|end| level::is_little(machine, *end)),
            scale: derived.scale,
            // A long arm bends the closure by as much as it is longer than the machine.
            last_step: LAST_STEP * derived.scale / (derived.scale + track.y[1].abs() + track.y[2].abs()),
        }
    }

    /// w1², from the nearer of the angles 0 and π, where it may be little.
    #[inline]
    fn square_of_drop(&self, y: f64, c: f64, s: f64) -> f64 {
        let bend = self.k * s * s;
        let end = if c > 0.0 { self.ends[0] - bend / (1.0 + c) } else { self.ends[1] + bend / (1.0 - c) };
        end - y * y
    }

    /// The distance by which leg I fails to close at an angle, mm: |v| w1 - |y u| over the length of (u, v), which is
    /// positive between the two roots; or the missing drop where w1 is imaginary.
    pub(super) fn slack(&self, c: f64, s: f64) -> f64 {
        let (u, v) = (self.r1_platform * c - self.r1_slider, self.r1_platform * s);
        let y = self.y[0] + self.y[1] * c + self.y[2] * s;
        let square = self.square_of_drop(y, c, s);
        let arm = u.hypot(v);
        let offset = (y * u).abs() / arm;
        if square < 0.0 {
            level::signed_root(square) - offset
        } else {
            v.abs() * square.sqrt() / arm - offset
        }
    }
}

impl Closure<4> for LegOne {
    #[inline]
    fn polynomial(&self) -> (TrigPolynomial<4>, f64) {
        let y = linear(self.y[0], self.y[1], self.y[2]);
        let half = 0.5 * self.r1_platform * self.r1_platform;
        let v_square = TrigPolynomial { cos: [half, 0.0, -half], sin: [0.0; 3] };
        let from_y = y.times(&y).times_even(self.c, -self.k);
        let poly = from_y.plus(1.0, &v_square.times_even(-self.e, -self.k));
        let size = y.bound(0);
        let magnitude = size * size * (self.c + self.k) + 2.0 * half * (self.e.abs() + self.k);
        (poly, magnitude)
    }

    #[inline]
    fn equations(&self, c: f64, s: f64, w: f64) -> Equations {
        let (u, v) = (self.r1_platform * c - self.r1_slider, self.r1_platform * s);
        let y = self.y[0] + self.y[1] * c + self.y[2] * s;
        let dy = self.y[2] * c - self.y[1] * s;
        let closed = if self.level {
            w * w - self.square_of_drop(y, c, s)
        } else {
            y * y + w * w - self.k * c - self.e
        };
        Equations {
            f: [y * u + w * v, closed],
            da: [dy * u - y * v + w * self.r1_platform * c, 2.0 * y * dy + self.k * s],
            dw: [v, 2.0 * w],
        }
    }

    fn sheets(&self, c: f64, s: f64) -> Option<[f64; 2]> {
        let y = self.y[0] + self.y[1] * c + self.y[2] * s;
        let square = self.square_of_drop(y, c, s);
        (square >= 0.0).then(|| [square.sqrt(), -square.sqrt()])
    }

    #[inline]
    fn w_at_root(&self, c: f64, s: f64) -> f64 {
        let (u, v) = (self.r1_platform * c - self.r1_slider, self.r1_platform * s);
        let y = self.y[0] + self.y[1] * c + self.y[2] * s;
        let square = self.square_of_drop(y, c, s);
        let moment = -y * u * v;
        // The better of two formulas, as in the first leg's: near v = 0 the quotient is 0/0.
        if square > 0.01 * (self.e.abs() + self.k) { square.sqrt().copysign(moment) } else { -y * u / v }
    }

    fn unit(&self) -> f64 {
        self.scale
    }

    fn discriminant(&self, c: f64, s: f64) -> f64 {
        self.square_of_drop(self.y[0] + self.y[1] * c + self.y[2] * s, c, s)
    }

    fn noise(&self, c: f64, s: f64, w: f64) -> f64 {
        // Both equations are squares of lengths: their sizes are alike.
        let size = self.scale * self.scale;
        if self.level {
            let (u, v) = (self.r1_platform * c - self.r1_slider, self.r1_platform * s);
            let y = self.y[0].abs() + (self.y[1] * c).abs() + (self.y[2] * s).abs();
            return LEVEL_NOISE * (y * u.abs() + (w * v).abs()).min(size);
        }
        2.0 * RESIDUAL_TOLERANCE * size
    }

    #[inline]
    fn last_step(&self, root: &Root) -> f64 {
        // Near a level leg the closure bends within a and w1 themselves.
        let bend = if self.level { (root.s.abs() + root.w.abs() / self.scale).clamp(1e-9, 1.0) } else { 1.0 };
        self.last_step * bend
    }
}
