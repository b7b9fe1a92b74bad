//! Two coordinates t and θ of the configurations of leg I, for the search over boxes.
//!
//! X1 = r sin θ and m = r cos θ with r² = L1² - ℓ², and φ is a function of t: φ = π/2 + δ sinh t with δ² = 1 -
//! (r1/R1)², because the angles of leg I bend within δ of π/2; or a function with a stationary end where leg I does
//! not reach all φ. On the level branch y takes the place of m, and w1 = L1 cos t, r = L1 sin t: there t = 0 is a
//! place that no curve meets but by chance.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::leg_one::{Branch, Shape};
use super::place::{Configuration, Place};
use crate::interval::Interval;
use crate::jet::Jet;
use crate::workspace::zero;

/// By how much the range of t on the level branch is longer than needed.
const BEYOND: f64 = 0.0618;

/// φ as a function of t.
#[derive(Clone, Copy, Debug)]
enum Angle {
    /// φ = t.
    Same,
    /// φ = π/2 + δ sinh t.
    Stretched(f64),
    /// φ = end - (end - low)(1 - t)².
    Ending { low: f64, end: f64 },
}

/// The coordinates, and the range of t: it holds all configurations or their mirror images.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chart {
    angle: Angle,
    pub(super) range: Interval,
}

impl Chart {
    /// `None` if leg I reaches nowhere.
    pub(super) fn new(shape: &Shape) -> Option<Self> {
        let square = |phi: f64| shape.squares[0] - shape.angles(phi).arm[0].powi(2);
        let low = match shape.branch {
            // Further than w1 = 0, which is a curve itself and must not be an edge.
            Branch::Level => {
                return Some(Self { angle: Angle::Same, range: Interval::new(0.0, FRAC_PI_2 + BEYOND) });
            }
            Branch::Only => 0.0,
            Branch::Crossed => FRAC_PI_2,
        };
        if square(low) <= 0.0 {
            return None;
        }
        if square(PI) <= 0.0 {
            let at = zero(square(low), square(PI), 1e-16, |t| square(low + t * (PI - low)));
            let angle = Angle::Ending { low, end: low + at * (PI - low) };
            return Some(Self { angle, range: Interval::UNIT });
        }
        if shape.branch == Branch::Crossed {
            return Some(Self { angle: Angle::Same, range: Interval::new(low, PI) });
        }
        let bend = shape.bend();
        let range = Interval::around((FRAC_PI_2 / bend).asinh());
        Some(Self { angle: Angle::Stretched(bend), range })
    }

    /// φ at t and its derivative.
    fn phi(&self, t: f64) -> [f64; 2] {
        match self.angle {
            Angle::Same => [t, 1.0],
            Angle::Stretched(bend) => [(FRAC_PI_2 + bend * t.sinh()).clamp(0.0, PI), bend * t.cosh()],
            Angle::Ending { low, end } => {
                let reach = end - low;
                [end - reach * (1.0 - t) * (1.0 - t), 2.0 * reach * (1.0 - t)]
            }
        }
    }

    /// The range of the derivative of φ.
    fn rate(&self, t: Interval) -> Interval {
        let [a, b] = [t.low, t.high].map(|t| self.phi(t)[1]);
        let least = if matches!(self.angle, Angle::Stretched(_)) && t.low < 0.0 && t.high > 0.0 {
            self.phi(0.0)[1]
        } else {
            a.min(b)
        };
        Interval::new(least, a.max(b))
    }

    /// t and θ of a configuration.
    pub(super) fn coordinates(&self, shape: &Shape, q: &Configuration) -> [f64; 2] {
        let t = match self.angle {
            Angle::Same if shape.branch == Branch::Level => {
                (q[2] / shape.squares[0].sqrt()).clamp(-1.0, 1.0).acos()
            }
            Angle::Same => q[2],
            Angle::Stretched(bend) => ((q[2] - FRAC_PI_2) / bend).asinh(),
            Angle::Ending { low, end } => 1.0 - ((end - q[2]) / (end - low)).max(0.0).sqrt(),
        };
        [t, q[0].atan2(q[1])]
    }

    /// The first three coordinates of the configuration at t and θ.
    pub(super) fn configuration(&self, shape: &Shape, [t, theta]: [f64; 2]) -> [f64; 3] {
        let (r, third) = if shape.branch == Branch::Level {
            let (sin, cos) = t.sin_cos();
            let length = shape.squares[0].sqrt();
            (length * sin, length * cos)
        } else {
            let phi = self.phi(t)[0];
            ((shape.squares[0] - shape.angles(phi).arm[0].powi(2)).max(0.0).sqrt(), phi)
        };
        let (sin, cos) = theta.sin_cos();
        [r * sin, r * cos, third]
    }

    /// A direction that is perpendicular to the surface on which t (axis 0) or θ (axis 1) has a value.
    pub(super) fn normal(axis: usize, value: f64) -> Configuration {
        if axis == 0 {
            [0.0, 0.0, 1.0, 0.0, 0.0]
        } else {
            let (sin, cos) = value.sin_cos();
            [cos, -sin, 0.0, 0.0, 0.0]
        }
    }

    /// θ within half a turn of another value.
    pub(super) fn nearest(theta: f64, other: f64) -> f64 {
        theta - TAU * ((theta - other) / TAU).round()
    }

    /// The place over a box.
    pub(super) fn place<'a>(&self, shape: &'a Shape, [t, theta]: [Interval; 2]) -> Place<'a, Jet> {
        let [cos, sin] = Jet::coordinate(theta, 1).cosine_and_sine();
        if shape.branch == Branch::Level {
            let length = shape.squares[0].sqrt();
            let [cos_t, sin_t] = Jet::coordinate(t, 0).cosine_and_sine();
            let (r, w1) = (sin_t.times(length), cos_t.times(length));
            return Place::level(shape, [r * sin, r * cos, w1]);
        }
        let [low, high] = [t.low, t.high].map(|t| self.phi(t)[0]);
        let rate = self.rate(t);
        let angles = shape.angle_ranges(Interval::new(low, high.max(low)));
        let angles = angles.map(|[value, slope]| Jet { value, slopes: [slope * rate, Interval::ZERO] });
        let r = self.radius(shape, t, &angles.arm);
        Place::new(shape, [r * sin, r * cos], angles)
    }

    /// r over a range of t. It falls as ℓ rises.
    fn radius(&self, shape: &Shape, t: Interval, arm: &Jet) -> Jet {
        let root = |arm: f64| (shape.squares[0] - arm * arm).max(0.0).sqrt();
        let value = Interval::new(root(arm.value.high), root(arm.value.low));
        let slope = if let Angle::Ending { low, end } = self.angle {
            // With r² = (end - φ) K, where K is a mean of 2 ℓ dℓ/dφ from φ to the end, and end - φ = reach (1 - t)²:
            // dr/dt = -2 ℓ dℓ/dφ √(reach / K).
            let from = self.phi(t.low)[0];
            let to = self.phi(t.high)[0].max(from);
            let [beyond, here] = [Interval::new(from, end.max(from)), Interval::new(from, to)].map(|phi| {
                let [arm, rate] = shape.angle_ranges(phi).arm;
                (arm * rate).times(2.0)
            });
            let least = Interval::new(beyond.low.max(1e-12), beyond.high.max(1e-12));
            -(here * least.reciprocal().times(end - low).root())
        } else {
            -(arm.value * arm.slopes[0] * value.reciprocal())
        };
        Jet { value, slopes: [slope, Interval::ZERO] }
    }
}
