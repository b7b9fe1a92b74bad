//! The forward problem in the angles (φ, θ), as in [`crate::forward`], with bounds of all numbers: for machines with
//! R1 = r1 or e1 = e2, and near both.

use std::f64::consts::PI;

use super::angle::{angle_of, direction, directions, turned_within};
use super::answer::Scope;
use super::enclosure::Enclosure;
use super::plane_search::{EquationRange, PlaneEquations, PlaneSearch, Rectangle};
use crate::mechanism::Mechanism;

/// Strips of φ at the start.
const STRIPS: u8 = 32;
/// Shift of the first strip: the symmetry plane lies within strips.
const SHIFT: f64 = 0.0173;
/// A bound of slopes where none is known.
const UNBOUNDED: f64 = 1e50;

/// 2 m ((gap - 2q) cos φ - 2p sin φ) + S (gap - 2q) - K = 0 and d X1 - m cos φ S - T = 0, where X1 = √E sin θ and
/// m = √E cos θ.
#[derive(Clone, Copy, Debug)]
pub(super) struct ChartEquations<'a> {
    mechanism: &'a Mechanism,
    scope: Scope,
    /// x = X1 - e1.
    e1: Enclosure,
    /// r1/R1 and 1 - (r1/R1)².
    ratio: Enclosure,
    complement: Enclosure,
    /// E = e[0] + e[1] cos a.
    e: [Enclosure; 2],
    /// T = t[0] + t[1] cos a + t[2] sin a.
    t: [Enclosure; 3],
    /// rho1 - rho2 and rho1 - rho3, rho3 - rho2, S and K.
    gaps: [Enclosure; 2],
    gap: Enclosure,
    s: Enclosure,
    k: Enclosure,
    /// 2 (e1 - e2).
    d: Enclosure,
}

/// The platform's angle a over a range of φ.
struct PlatformAngle {
    /// Cosine and sine.
    turn: [Enclosure; 2],
    /// da/dφ.
    rate: Enclosure,
}

impl<'a> ChartEquations<'a> {
    pub(super) fn new(mechanism: &'a Mechanism, rho: [f64; 3], scope: Scope) -> Self {
        let g = &mechanism.geometry;
        let number = Enclosure::of;
        let [rho1, rho2, rho3] = rho.map(number);
        let (a, b, gap) = (rho1 - rho2, rho1 - rho3, rho3 - rho2);
        let e1 = number(g.D1) - number(g.d1);
        let offset = e1 - (number(g.D2) - number(g.d2));
        let [l1, l2, l3] = [g.L1, g.L2, g.L3].map(|length| number(length).square());
        let (difference, k) = (number(g.R1) - number(g.r1), number(g.R1).times(2.0 * g.r1));
        // R1 is at least 1e-3 mm.
        let inverse = number(g.R1).reciprocal().unwrap_or(Enclosure::around(UNBOUNDED));
        let ratio = inverse.times(g.r1);
        let e0 = l1 - difference.square() - k;
        let arms = number(g.R2).square() + number(g.r4).square();
        let squares = (a.square() + b.square() - l2 - l3).times(0.5);
        Self {
            mechanism,
            scope,
            e1,
            ratio,
            complement: difference * (number(g.R1) + number(g.r1)) * inverse.square(),
            e: [e0, k],
            t: [arms + squares + e0 + offset.square(), k - number(g.R2).times(2.0 * g.r4), -gap.times(g.R2)],
            gaps: [a, b],
            gap,
            s: a + b,
            k: (number(g.L2) - number(g.L3)) * (number(g.L2) + number(g.L3)),
            d: offset.times(2.0),
        }
    }

    /// Whether every wanted solution is known.
    pub(super) fn knows_all(&self, known: &[[Enclosure; 2]]) -> bool {
        let mut search = PlaneSearch::new(self, known);
        let half = PI / f64::from(STRIPS);
        (0..STRIPS).all(|i| {
            let phi = SHIFT - PI + f64::from(2 * i) * half;
            search.knows_all_of(&Rectangle { centre: [phi, 0.0], half: [half + 1e-14, PI + 1e-14] })
        })
    }

    /// The bounds of a solution in (φ, θ), from those of (x, y, w1, a). (y, w1) = m (sin φ, cos φ) leaves the sign of m
    /// open; the platform's angle decides.
    pub(super) fn coordinates(&self, [x, y, w, a]: [Enclosure; 4]) -> Option<[Enclosure; 2]> {
        let ([c, s], x1) = (directions(a), x + self.e1);
        let m = (y.square() + w.square()).root()?;
        let mut found = [1.0, -1.0].into_iter().filter_map(|sign| {
            let phi = angle_of(w.times(sign), y.times(sign))?;
            let [cosine, sine] =
                self.platform_angle(phi.middle(), (phi - Enclosure::of(phi.middle())).magnitude()).turn;
            (cosine.meets(c) && sine.meets(s)).then_some((phi, m.times(sign)))
        });
        match (found.next(), found.next()) {
            (Some((phi, m)), None) => Some([phi, angle_of(m, x1)?]),
            _ => None,
        }
    }

    /// R1 sin(a + φ) = r1 sin φ with cos(a + φ) ≥ 0.
    fn platform_angle(&self, middle: f64, half: f64) -> PlatformAngle {
        let [c, s] = direction(middle);
        let (x, sine) = (self.ratio * c, self.ratio * s);
        // The square is not negative.
        let cosine = (self.complement + x.square()).root().unwrap_or(Enclosure::ZERO);
        let here = [cosine * c + sine * s, sine * c - cosine * s];
        let [over, _] = turned_within([c, s], half);
        let rate = self.rate_over(over);
        PlatformAngle { turn: turned_within(here, rate.times(half).magnitude()), rate }
    }

    /// da/dφ = x/√(1 - (r1/R1)² + x²) - 1 with x = r1/R1 cos φ; it rises with x.
    fn rate_over(&self, cosine: Enclosure) -> Enclosure {
        let x = self.ratio * cosine;
        let quotient = |x: f64| {
            let x = Enclosure::of(x);
            let length = (self.complement + x.square()).root()?.reciprocal()?;
            Some(x * length)
        };
        let low = quotient(x.low).map_or(-1.0, |quotient| quotient.low.max(-1.0));
        let high = quotient(x.high).map_or(1.0, |quotient| quotient.high.min(1.0));
        Enclosure::new(low, high) - Enclosure::ONE
    }

    /// √E and its derivative along φ; `None` where E is negative.
    fn radius(&self, [c, s]: [Enclosure; 2], rate: Enclosure) -> Option<[Enclosure; 2]> {
        let radius = (self.e[0] + self.e[1] * c).root()?;
        let slope = radius.times(2.0).reciprocal().map(|inverse| -(self.e[1] * s * rate * inverse));
        Some([radius, slope.unwrap_or(Enclosure::around(UNBOUNDED))])
    }

    /// Whether m, leg I's height or u is negative, or a slider lies below the platform.
    fn is_out_of_mode(&self, [c, s]: [Enclosure; 2], cosine: Enclosure, m: Enclosure) -> bool {
        let g = &self.mechanism.geometry;
        let (v, q, w) = (s.times(g.R1), s.times(g.R2), m * cosine);
        let u = c.times(g.R1) - Enclosure::of(g.r1);
        let heights = [cosine, m, u, w - v, w + v, w + self.gaps[0] - q, w + self.gaps[1] + q];
        heights.into_iter().any(|height| height.high < 0.0)
    }
}

impl PlaneEquations for ChartEquations<'_> {
    const ANGLES: [bool; 2] = [true, true];

    fn over(&self, rectangle: &Rectangle) -> Option<[EquationRange; 2]> {
        let ([phi, theta], [half, theta_half]) = (rectangle.centre, rectangle.half);
        let [c, s] = turned_within(direction(phi), half);
        let [cos_theta, sin_theta] = turned_within(direction(theta), theta_half);
        let PlatformAngle { turn, rate } = self.platform_angle(phi, half);
        let [radius, radius_slope] = self.radius(turn, rate)?;
        let (m, x1) = (radius * cos_theta, radius * sin_theta);
        if self.scope == Scope::Working && self.is_out_of_mode(turn, c, m) {
            return None;
        }
        let [cos_a, sin_a] = turn;
        let [cos_slope, sin_slope] = [-(sin_a * rate), cos_a * rate];
        let g = &self.mechanism.geometry;
        let (p, p_slope) = (cos_a.times(g.R2) - Enclosure::of(g.r4), cos_slope.times(g.R2));
        let (spread, spread_slope) = (self.gap - sin_a.times(2.0 * g.R2), -sin_slope.times(2.0 * g.R2));
        let m_slopes = [radius_slope * cos_theta, -x1];
        let across = (c * spread - (s * p).times(2.0)).times(2.0);
        let across_slope = (c * spread_slope - s * spread - (c * p + s * p_slope).times(2.0)).times(2.0);
        let difference = EquationRange {
            value: m * across + self.s * spread - self.k,
            slopes: [m_slopes[0] * across + m * across_slope + self.s * spread_slope, m_slopes[1] * across],
        };
        let t = self.t[0] + self.t[1] * cos_a + self.t[2] * sin_a;
        let t_slope = self.t[1] * cos_slope + self.t[2] * sin_slope;
        let mean = EquationRange {
            value: x1 * self.d - m * c * self.s - t,
            slopes: [
                radius_slope * sin_theta * self.d - (m_slopes[0] * c - m * s) * self.s - t_slope,
                m * self.d - m_slopes[1] * c * self.s,
            ],
        };
        Some([difference, mean])
    }
}
