//! Two coordinates t and θ of the configurations of leg I, for the search over boxes.
//!
//! X1 = r sin θ and m = r cos θ with r² = L1² - ℓ², and t is φ, or another function of it where leg I does not reach
//! all φ. On the level branch y takes the place of m, and w1 = L1 cos t, r = L1 sin t: there t = 0 is a place that
//! no curve meets but by chance.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::leg_one::{Branch, Shape};
use super::place::{Configuration, Place};
use super::scalar::Scalar;
use crate::interval::Interval;
use crate::jet::Jet;
use crate::workspace::zero;

/// By how much the range of t on the level branch is longer than needed.
const BEYOND: f64 = 0.0618;

/// The coordinates, and their range: it holds all configurations or their mirror images.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chart {
    /// The least φ and, if leg I does not reach further, the greatest. φ is then end - (end - low)(1 - t)².
    low: f64,
    end: Option<f64>,
    /// The range of t.
    pub(super) range: Interval,
}

impl Chart {
    /// `None` if leg I reaches nowhere.
    pub(super) fn new(shape: &Shape) -> Option<Self> {
        let [low, high] = match shape.branch {
            Branch::Only => [0.0, PI],
            // Further than w1 = 0, which is a curve itself and must not be an edge.
            Branch::Level => [0.0, FRAC_PI_2 + BEYOND],
            Branch::Crossed => [FRAC_PI_2, PI],
        };
        if shape.branch == Branch::Level {
            return Some(Self { low, end: None, range: Interval::new(low, high) });
        }
        let square = |phi: f64| shape.squares[0] - shape.angles(phi).arm[0].powi(2);
        if square(high) > 0.0 {
            return Some(Self { low, end: None, range: Interval::new(low, high) });
        }
        if square(low) <= 0.0 {
            return None;
        }
        let at = zero(square(low), square(high), 1e-16, |t| square(low + t * (high - low)));
        Some(Self { low, end: Some(low + at * (high - low)), range: Interval::UNIT })
    }

    /// φ at t and its derivative.
    fn phi(&self, t: f64) -> [f64; 2] {
        match self.end {
            None => [t, 1.0],
            Some(end) => {
                let reach = end - self.low;
                [end - reach * (1.0 - t) * (1.0 - t), 2.0 * reach * (1.0 - t)]
            }
        }
    }

    /// t and θ of a configuration.
    pub(super) fn coordinates(&self, shape: &Shape, q: &Configuration) -> [f64; 2] {
        let t = match (shape.branch, self.end) {
            (Branch::Level, _) => (q[2] / shape.squares[0].sqrt()).clamp(-1.0, 1.0).acos(),
            (_, None) => q[2],
            (_, Some(end)) => 1.0 - ((end - q[2]) / (end - self.low)).max(0.0).sqrt(),
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
        let ends = [t.low, t.high].map(|t| self.phi(t));
        let rate = Interval::new(ends[0][1].min(ends[1][1]), ends[0][1].max(ends[1][1]));
        let angles = shape.angle_ranges(Interval::new(ends[0][0], ends[1][0].max(ends[0][0])));
        let angles = angles.map(|[value, slope]| Jet { value, slopes: [slope * rate, Interval::ZERO] });
        let r = self.radius(shape, t, &angles.arm);
        Place::new(shape, [r * sin, r * cos], angles)
    }

    /// r over a range of t. It falls as ℓ rises.
    fn radius(&self, shape: &Shape, t: Interval, arm: &Jet) -> Jet {
        let root = |arm: f64| (shape.squares[0] - arm * arm).max(0.0).sqrt();
        let value = Interval::new(root(arm.value.high), root(arm.value.low));
        let slope = match self.end {
            None => -(arm.value * arm.slopes[0] * value.reciprocal()),
            Some(end) => {
                // With r² = (end - φ) K, where K is a mean of 2 ℓ dℓ/dφ from φ to the end, and end - φ = reach (1 - t)²:
                // dr/dt = -2 ℓ dℓ/dφ √(reach / K).
                let from = self.phi(t.low)[0];
                let to = self.phi(t.high)[0].max(from);
                let [beyond, here] =
                    [Interval::new(from, end.max(from)), Interval::new(from, to)].map(|phi| {
                        let [arm, rate] = shape.angle_ranges(phi).arm;
                        (arm * rate).times(2.0)
                    });
                let least = Interval::new(beyond.low.max(1e-12), beyond.high.max(1e-12));
                -(here * least.reciprocal().times(end - self.low).root())
            }
        };
        Jet { value, slopes: [slope, Interval::ZERO] }
    }
}
