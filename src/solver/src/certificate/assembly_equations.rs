//! The forward problem in (a, λ), as in [`crate::forward`], with bounds of all numbers.

use arrayvec::ArrayVec;

use super::angle::{direction, turned_within};
use super::answer::Scope;
use super::circle_search::CircleEquations;
use super::enclosure::Enclosure;
use super::plane_search::{EquationRange, PlaneEquations, Rectangle};
use crate::mechanism::Mechanism;
use crate::trig_polynomial::{TrigPolynomial, linear};

/// λ D - N = 0 and X1² + (λ² + 1)(C - k cos a) - L1² = 0 with X1 = (λ u S + T) / d, for a machine with R1 ≠ r1 and
/// e1 ≠ e2.
#[derive(Clone, Copy, Debug)]
pub(super) struct AssemblyEquations<'a> {
    mechanism: &'a Mechanism,
    scope: Scope,
    /// rho1 - rho2 and rho1 - rho3.
    gaps: [Enclosure; 2],
    /// C, k and L1².
    spread: [Enclosure; 2],
    /// (R1 - r1)², rounded down.
    least_spread: f64,
    l1_square: Enclosure,
    s: Enclosure,
    /// 1/d.
    inverse_d: Enclosure,
    /// D = d[0] u + d[1] sin a.
    d: [Enclosure; 2],
    /// N = n[0] + n[1] sin a.
    n: [Enclosure; 2],
    /// T = t[0] + t[1] cos a + t[2] sin a.
    t: [Enclosure; 3],
}

impl<'a> AssemblyEquations<'a> {
    /// `None` if d may be zero.
    pub(super) fn new(mechanism: &'a Mechanism, rho: [f64; 3], scope: Scope) -> Option<Self> {
        let g = &mechanism.geometry;
        let [rho1, rho2, rho3] = rho.map(Enclosure::of);
        let number = Enclosure::of;
        let (a, b, gap) = (rho1 - rho2, rho1 - rho3, rho3 - rho2);
        let s = a + b;
        let offset = (number(g.D1) - number(g.d1)) - (number(g.D2) - number(g.d2));
        let product = |a: f64, b: f64| number(a).times(b);
        let [l1, l2, l3] = [g.L1, g.L2, g.L3].map(|length| number(length).square());
        let (c, k) = (product(g.R1, g.R1) + product(g.r1, g.r1), product(g.R1, g.r1).times(2.0));
        let arms = product(g.R2, g.R2) + product(g.r4, g.r4);
        let squares = (a.square() + b.square() - l2 - l3).times(0.5);
        Some(Self {
            mechanism,
            scope,
            gaps: [a, b],
            spread: [c, k],
            least_spread: (number(g.R1) - number(g.r1)).square().low,
            l1_square: l1,
            s,
            inverse_d: offset.times(2.0).reciprocal()?,
            d: [gap.times(2.0), (product(g.R2, g.r1) - product(g.R1, g.r4)).times(4.0)],
            n: [(number(g.L2) - number(g.L3)) * (number(g.L2) + number(g.L3)) - gap * s, s.times(2.0 * g.R2)],
            t: [
                arms - c + l1 + squares + offset.square(),
                k - product(g.R2, g.r4).times(2.0),
                -gap.times(g.R2),
            ],
        })
    }

    fn u(&self, c: Enclosure) -> Enclosure {
        c.times(self.mechanism.geometry.R1) - Enclosure::of(self.mechanism.geometry.r1)
    }

    fn d_and_n(&self, [c, s]: [Enclosure; 2]) -> [Enclosure; 2] {
        [self.d[0] * self.u(c) + self.d[1] * s, self.n[0] + self.n[1] * s]
    }

    /// T and C - k cos a = u² + v², which is at least (R1 - r1)².
    fn t_and_spread(&self, [c, s]: [Enclosure; 2]) -> [Enclosure; 2] {
        let spread = self.spread[0] - self.spread[1] * c;
        let spread = Enclosure { low: spread.low.max(self.least_spread), ..spread };
        [self.t[0] + self.t[1] * c + self.t[2] * s, spread]
    }

    /// The bounds of a solution in (a, λ), from those of (x, y, w1, a): λ = (w1 u - y v) / (u² + v²).
    pub(super) fn coordinates(&self, [_, y, w, a]: [Enclosure; 4]) -> Option<[Enclosure; 2]> {
        let [c, s] = super::angle::directions(a);
        let (u, v) = (self.u(c), s.times(self.mechanism.geometry.R1));
        Some([a, (w * u - y * v) * (u.square() + v.square()).reciprocal()?])
    }

    /// Whether the rods of leg I cross, or the slider of a rod lies below the platform, all over these bounds.
    fn is_out_of_mode(&self, u: Enclosure, s: Enclosure, w: Enclosure) -> bool {
        let g = &self.mechanism.geometry;
        let (v, q) = (s.times(g.R1), s.times(g.R2));
        let heights = [u, w - v, w + v, w + self.gaps[0] - q, w + self.gaps[1] + q];
        heights.into_iter().any(|height| height.high < 0.0)
    }
}

impl PlaneEquations for AssemblyEquations<'_> {
    const ANGLES: [bool; 2] = [true, false];

    fn over(&self, rectangle: &Rectangle) -> Option<[EquationRange; 2]> {
        let ([a, middle], [half, radius]) = (rectangle.centre, rectangle.half);
        let turn = turned_within(direction(a), half);
        let ([c, s], lambda) = (turn, Enclosure::of(middle).widened(radius));
        let u = self.u(c);
        if self.scope == Scope::Working && self.is_out_of_mode(u, s, lambda * u) {
            return None;
        }
        let r1 = self.mechanism.geometry.R1;
        let ([d, n], [t, spread], du) = (self.d_and_n(turn), self.t_and_spread(turn), -s.times(r1));
        let x = (lambda * u * self.s + t) * self.inverse_d;
        let x_slope = (lambda * du * self.s - self.t[1] * s + self.t[2] * c) * self.inverse_d;
        let per_lambda = u * self.s * self.inverse_d;
        let stretch = lambda.square() + Enclosure::ONE;
        let linear = EquationRange {
            value: lambda * d - n,
            slopes: [lambda * (self.d[1] * c + self.d[0] * du) - self.n[1] * c, d],
        };
        let quadratic = EquationRange {
            value: x.square() + stretch * spread - self.l1_square,
            slopes: [
                (x * x_slope).times(2.0) + stretch * self.spread[1] * s,
                (x * per_lambda + lambda * spread).times(2.0),
            ],
        };
        Some([linear, quadratic])
    }
}

impl CircleEquations<5> for AssemblyEquations<'_> {
    fn polynomial(&self) -> TrigPolynomial<5, Enclosure> {
        let (r1, arm) =
            (Enclosure::of(self.mechanism.geometry.R1), Enclosure::of(self.mechanism.geometry.r1));
        let d = linear(-(self.d[0] * arm), self.d[0] * r1, self.d[1]);
        let n = linear(self.n[0], Enclosure::ZERO, self.n[1]);
        let t = linear(self.t[0], self.t[1], self.t[2]);
        let x = t.times(&d).plus(self.s, &linear(-arm, r1, Enclosure::ZERO).times(&n));
        let from_n = n.times(&n).times_even(self.spread[0], -self.spread[1]);
        let from_d = d.times(&d).times_even(self.spread[0] - self.l1_square, -self.spread[1]);
        from_n.plus(Enclosure::ONE, &from_d).raised::<5>().plus(self.inverse_d.square(), &x.squared())
    }

    fn is_unwanted(&self, turn: [Enclosure; 2]) -> bool {
        if self.scope == Scope::All {
            return false;
        }
        // λ = N/D is positive in the working mode.
        let [d, n] = self.d_and_n(turn);
        self.u(turn[0]).high < 0.0 || (d * n).high < 0.0
    }

    fn other_unknown(&self, turn: [Enclosure; 2]) -> Option<ArrayVec<Enclosure, 2>> {
        let [t, spread] = self.t_and_spread(turn);
        let (per_lambda, x) = (self.u(turn[0]) * self.s * self.inverse_d, t * self.inverse_d);
        let [a2, a1, a0] =
            [per_lambda.square() + spread, per_lambda * x, x.square() + spread - self.l1_square];
        let inverse = a2.reciprocal()?;
        let mut found = ArrayVec::new();
        let Some(root) = (a1.square() - a2 * a0).root() else { return Some(found) };
        let [below, above] = [(-a1 - root) * inverse, (root - a1) * inverse];
        if root.low > 0.0 {
            found.extend([below, above]);
        } else {
            found.push(below.hull(above));
        }
        if self.scope == Scope::Working {
            found.retain(|range| range.high >= 0.0);
        }
        Some(found)
    }
}
