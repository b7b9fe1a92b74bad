//! The proof that a loop closure has no other solutions than those that are known, on the circle of platform angles.

use arrayvec::ArrayVec;

use super::angle::{bounds, turned_within};
use super::bounded_polynomial::BoundedPolynomial;
use super::enclosure::Enclosure;
use super::plane_search::{PlaneEquations, PlaneSearch, Rectangle, half_of, reach};
use crate::fast_math::sin_cos;
use crate::trig_polynomial::TrigPolynomial;

/// Arcs at the start. The first is centred at -π: the symmetry plane lies in the middle of two arcs.
const ARCS: u8 = 16;
/// Halvings of an arc after which the plane decides.
const DEEPEST: u32 = 4;
/// Distance of two known angles, over the arc's half, below which it does at once.
const CLOSE: f64 = 0.5;

/// Two equations in the platform's angle and one more unknown, whose elimination is a polynomial on the circle.
pub(super) trait CircleEquations<const M: usize>: PlaneEquations {
    /// The polynomial. A simple zero belongs to one solution at most.
    fn polynomial(&self) -> TrigPolynomial<M, Enclosure>;
    /// Whether no wanted solution has an angle with a cosine and sine within these bounds.
    fn is_unwanted(&self, direction: [Enclosure; 2]) -> bool;
    /// The intervals to which the other unknown is confined at such angles. `None` if they cannot be stated.
    fn other_unknown(&self, direction: [Enclosure; 2]) -> Option<ArrayVec<Enclosure, 2>>;
}

/// Whether every wanted solution is known. `known` are the bounds of distinct solutions.
pub(super) fn knows_all<const M: usize, E: CircleEquations<M>>(
    equations: &E,
    known: &[[Enclosure; 2]],
) -> bool {
    let polynomial = BoundedPolynomial::new(&equations.polynomial());
    let mut search = CircleSearch { equations, polynomial, known, plane: PlaneSearch::new(equations, known) };
    let half = std::f64::consts::PI / f64::from(ARCS);
    (0..ARCS)
        .all(|i| search.examine(f64::from(2 * i) * half - std::f64::consts::PI, half_of(2.0 * half, 4.0), 0))
}

struct CircleSearch<'a, const M: usize, E> {
    equations: &'a E,
    polynomial: BoundedPolynomial<M>,
    known: &'a [[Enclosure; 2]],
    plane: PlaneSearch<'a, E>,
}

impl<const M: usize, E: CircleEquations<M>> CircleSearch<'_, M, E> {
    /// Whether every wanted solution on an arc is known.
    fn examine(&mut self, middle: f64, half: f64, depth: u32) -> bool {
        let (s, c) = sin_cos(middle);
        let range = self.polynomial.at([c, s]);
        if range.excludes_zero(half) {
            return true;
        }
        let mut inside = self.known.iter().filter_map(|[angle, _]| {
            let reach = reach(middle, half, *angle, true)?;
            Some((reach, angle.middle()))
        });
        let several = match (inside.next(), inside.next()) {
            (Some((reach, _)), None) if range.is_monotone(reach) => return true,
            (Some((_, first)), Some((_, second))) => (first - second).abs() < CLOSE * half,
            _ => false,
        };
        let over = turned_within(bounds([c, s]), half);
        if self.equations.is_unwanted(over) {
            return true;
        }
        if several || depth == DEEPEST {
            return self.examine_plane(middle, half, over);
        }
        let part = half_of(half, middle);
        [-0.5, 0.5].into_iter().all(|side| self.examine(middle + side * half, part, depth + 1))
    }

    fn examine_plane(&mut self, middle: f64, half: f64, over: [Enclosure; 2]) -> bool {
        let Some(others) = self.equations.other_unknown(over) else { return false };
        others.into_iter().all(|other| {
            let centre = other.middle();
            let other_half = (other - Enclosure::of(centre)).magnitude();
            self.plane.knows_all_of(&Rectangle { centre: [middle, centre], half: [half, other_half] })
        })
    }
}
