//! Leg I along a locus of P: equations (A) in (a, w1), with bounds of all numbers.

use arrayvec::ArrayVec;

use super::angle::{direction, directions, turned_within};
use super::answer::Scope;
use super::circle_search::CircleEquations;
use super::enclosure::Enclosure;
use super::krawczyk::Equations;
use super::locus::EnclosedLocus;
use super::plane_search::{EquationRange, PlaneEquations, Rectangle, inverse};
use super::rod_equations::is_level;
use crate::mechanism::Mechanism;
use crate::trig_polynomial::{TrigPolynomial, linear};

/// y u + w1 v = 0 and w1² + y² + E - k cos a = 0 with E = X1² - L1² + C.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegOneEquations<'a> {
    mechanism: &'a Mechanism,
    locus: &'a EnclosedLocus,
    scope: Scope,
    /// C, k and E.
    c: Enclosure,
    k: Enclosure,
    e: Enclosure,
    /// L² - X2² of legs II and III.
    reach_squares: [Enclosure; 2],
}

impl<'a> LegOneEquations<'a> {
    pub(super) fn new(mechanism: &'a Mechanism, locus: &'a EnclosedLocus, scope: Scope) -> Self {
        let g = &mechanism.geometry;
        let number = Enclosure::of;
        let (x1, length) = (locus.x + (number(g.D1) - number(g.d1)), number(g.L1));
        let c = number(g.R1).square() + number(g.r1).square();
        let k = number(g.R1).times(2.0 * g.r1);
        let x2 = locus.x + (number(g.D2) - number(g.d2));
        let reach_squares = [g.L2, g.L3].map(|length| (number(length) - x2) * (number(length) + x2));
        Self { mechanism, locus, scope, c, k, e: (x1 - length) * (x1 + length) + c, reach_squares }
    }

    /// u and v.
    fn arm(&self, [c, s]: [Enclosure; 2]) -> [Enclosure; 2] {
        let g = &self.mechanism.geometry;
        [c.times(g.R1) - Enclosure::of(g.r1), s.times(g.R1)]
    }

    /// Whether leg II or III does not reach the platform all over these bounds.
    fn is_out_of_reach(&self, c: Enclosure, y: Enclosure) -> bool {
        let g = &self.mechanism.geometry;
        let p = c.times(g.R2) - Enclosure::of(g.r4);
        let [second, third] = self.reach_squares;
        (second - (y - p).square()).high < 0.0 || (third - (y + p).square()).high < 0.0
    }

    /// Whether the rods of leg I hang down and do not cross, for certain, at a solution within bounds of (y, w1) and of
    /// alpha.
    pub(super) fn hang_uncrossed(&self, [y, w]: [Enclosure; 2], a: Enclosure) -> bool {
        let [u, v] = self.arm(directions(a));
        let uncrossed = if self.mechanism.is_delta() { is_level([y, w], a) } else { u.low > 0.0 };
        uncrossed && (w - v).low > 0.0 && (w + v).low > 0.0
    }

    fn ranges(&self, turn: [Enclosure; 2], w: Enclosure) -> [EquationRange; 2] {
        let ([c, s], [u, v]) = (turn, self.arm(turn));
        let ([y, _], [dy, _]) = (self.locus.at(turn), self.locus.slopes(turn));
        let linear = EquationRange {
            value: y * u + w * v,
            slopes: [dy * u - y * v + (w * c).times(self.mechanism.geometry.R1), v],
        };
        let quadratic = EquationRange {
            value: w.square() + y.square() + self.e - self.k * c,
            slopes: [(y * dy).times(2.0) + self.k * s, w.times(2.0)],
        };
        [linear, quadratic]
    }
}

impl PlaneEquations for LegOneEquations<'_> {
    const ANGLES: [bool; 2] = [true, false];

    fn over(&self, rectangle: &Rectangle) -> Option<[EquationRange; 2]> {
        let ([a, middle], [half, radius]) = (rectangle.centre, rectangle.half);
        let (turn, w) = (turned_within(direction(a), half), Enclosure::of(middle).widened(radius));
        if self.scope == Scope::Working {
            // Both rods hang down and do not cross.
            let [u, v] = self.arm(turn);
            if [u, w - v, w + v].into_iter().any(|height| height.high < 0.0) {
                return None;
            }
        }
        let [y, _] = self.locus.at(turn);
        (!self.is_out_of_reach(turn[0], y)).then(|| self.ranges(turn, w))
    }
}

impl CircleEquations<4> for LegOneEquations<'_> {
    fn polynomial(&self) -> TrigPolynomial<4, Enclosure> {
        let [constant, cos, sin] = self.locus.y;
        let y = linear(constant, cos, sin);
        let half = Enclosure::of(self.mechanism.geometry.R1).square().times(0.5);
        let zero = Enclosure::ZERO;
        let v_square = TrigPolynomial { cos: [half, zero, -half], sin: [zero; 3] };
        // v² (E - k cos a) + (C - k cos a) y²
        let from_y = y.times(&y).times_even(self.c, -self.k);
        from_y.plus(Enclosure::ONE, &v_square.times_even(self.e, -self.k))
    }

    fn is_unwanted(&self, turn: [Enclosure; 2]) -> bool {
        let ([u, v], [y, _]) = (self.arm(turn), self.locus.at(turn));
        // y u + w1 v = 0 with w1 > 0 and u > 0: y and v have different signs.
        let is_unwanted =
            self.scope == Scope::Working && (u.high < 0.0 || (u.low > 0.0 && (y * v).low > 0.0));
        is_unwanted || self.is_out_of_reach(turn[0], y)
    }

    fn other_unknown(&self, turn: [Enclosure; 2]) -> Option<ArrayVec<Enclosure, 2>> {
        let [y, _] = self.locus.at(turn);
        let mut found = ArrayVec::new();
        if let Some(height) = (self.k * turn[0] - self.e - y.square()).root() {
            let all = self.scope == Scope::All;
            if !all || height.low > 0.0 {
                found.push(height);
            }
            if all {
                let below = -height;
                found.push(if height.low > 0.0 { below } else { below.hull(height) });
            }
        }
        Some(found)
    }
}

impl Equations<2> for LegOneEquations<'_> {
    fn values(&self, &[a, w]: &[f64; 2]) -> [Enclosure; 2] {
        self.ranges(direction(a), Enclosure::of(w)).map(|range| range.value)
    }

    fn slopes(&self, &[a, w]: &[f64; 2], radii: &[f64; 2]) -> [[Enclosure; 2]; 2] {
        let turn = turned_within(direction(a), radii[0]);
        self.ranges(turn, Enclosure::of(w).widened(radii[1])).map(|range| range.slopes)
    }

    fn scales(&self) -> [f64; 2] {
        [1.0, self.mechanism.longest]
    }

    fn inverse(matrix: &[[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
        inverse(*matrix)
    }
}
