//! The proof that two equations in a plane have no other solutions than those that are known.
//!
//! A rectangle is finished if an equation, or a combination of both, excludes zero there, or if it holds one known
//! solution and the equations are injective: no matrix within the bounds of their derivatives is singular. Otherwise it
//! is halved.

use super::enclosure::{Enclosure, are_moderate};

/// Rectangles after which the search ends without a proof. Proofs take up to 800.
const MOST_RECTANGLES: u32 = 4_000;
/// Halvings after which it does.
const DEEPEST: u32 = 60;

/// A rectangle of the plane. A coordinate may be an angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rectangle {
    pub(super) centre: [f64; 2],
    pub(super) half: [f64; 2],
}

/// An equation over a rectangle: bounds of its values and of its derivatives.
#[derive(Clone, Copy, Debug)]
pub(super) struct EquationRange {
    pub(super) value: Enclosure,
    pub(super) slopes: [Enclosure; 2],
}

/// Two equations in a plane.
pub(super) trait PlaneEquations {
    /// Both over a rectangle; `None` if no wanted solution lies there.
    fn over(&self, rectangle: &Rectangle) -> Option<[EquationRange; 2]>;
    /// Whether each coordinate is an angle.
    const ANGLES: [bool; 2];
}

/// A search with its known solutions: bounds of each, in which a solution is proved.
#[derive(Debug)]
pub(super) struct PlaneSearch<'a, E> {
    equations: &'a E,
    known: &'a [[Enclosure; 2]],
    rectangles: u32,
}

impl<'a, E: PlaneEquations> PlaneSearch<'a, E> {
    pub(super) fn new(equations: &'a E, known: &'a [[Enclosure; 2]]) -> Self {
        Self { equations, known, rectangles: 0 }
    }

    /// Whether every solution in a rectangle is known.
    pub(super) fn knows_all_of(&mut self, rectangle: &Rectangle) -> bool {
        self.examine(rectangle, 0)
    }

    fn examine(&mut self, rectangle: &Rectangle, depth: u32) -> bool {
        self.rectangles += 1;
        if self.rectangles > MOST_RECTANGLES || depth > DEEPEST {
            return false;
        }
        let Some(ranges) = self.equations.over(rectangle) else { return true };
        if ranges.iter().any(|range| range.value.excludes_zero()) {
            return true;
        }
        let mut inside = self.known.iter().filter_map(|known| rectangle.with::<E>(known));
        let is_finished = match (inside.next(), inside.next()) {
            (None, _) => self.is_excluded(rectangle, &ranges),
            (Some(larger), None) => self.equations.over(&larger).is_none_or(|ranges| is_injective(&ranges)),
            _ => false,
        };
        if is_finished {
            return true;
        }
        let parts = rectangle.halves(wider_axis(rectangle, &ranges));
        parts.iter().all(|part| self.examine(part, depth + 1))
    }

    /// Whether the mean value theorem excludes a common zero, for the equations multiplied with the inverse of their
    /// derivatives in the middle.
    fn is_excluded(&self, rectangle: &Rectangle, ranges: &[EquationRange; 2]) -> bool {
        let centre = Rectangle { half: [0.0; 2], ..*rectangle };
        let Some(here) = self.equations.over(&centre) else { return false };
        let offsets = rectangle.half.map(Enclosure::around);
        let excludes = |[a, b]: [f64; 2]| {
            let combined = |[first, second]: [Enclosure; 2]| first.times(a) + second.times(b);
            let slope = |axis: usize| combined([ranges[0].slopes[axis], ranges[1].slopes[axis]]);
            let change = slope(0) * offsets[0] + slope(1) * offsets[1];
            (combined([here[0].value, here[1].value]) + change).excludes_zero()
        };
        let inverse = inverse(ranges.map(|range| range.slopes.map(Enclosure::middle)));
        inverse.is_some_and(|rows| rows.into_iter().any(excludes))
            || excludes([1.0, 0.0])
            || excludes([0.0, 1.0])
    }
}

/// Whether two points of a rectangle never have equal values: with rows from anywhere in the rectangle the matrix of
/// derivatives is regular.
fn is_injective(ranges: &[EquationRange; 2]) -> bool {
    let [[a, b], [c, d]] = ranges.map(|range| range.slopes);
    (a * d - b * c).excludes_zero()
}

/// The coordinate along which the equations change most, relative to their change along both.
fn wider_axis(rectangle: &Rectangle, ranges: &[EquationRange; 2]) -> usize {
    let share = |range: &EquationRange| {
        let [a, b] = [0, 1].map(|axis| range.slopes[axis].magnitude() * rectangle.half[axis]);
        (a - b) / (a + b)
    };
    usize::from(share(&ranges[0]) + share(&ranges[1]) < 0.0)
}

/// The inverse of a matrix in double precision, if it has one.
pub(super) fn inverse([[a, b], [c, d]]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let scale = 1.0 / (a * d - b * c);
    let inverse = [[d * scale, -b * scale], [-c * scale, a * scale]];
    are_moderate(&inverse).then_some(inverse)
}

impl Rectangle {
    /// The rectangle with a known solution as a whole, if both meet.
    fn with<E: PlaneEquations>(&self, known: &[Enclosure; 2]) -> Option<Self> {
        let reach = |axis: usize| reach(self.centre[axis], self.half[axis], known[axis], E::ANGLES[axis]);
        Some(Self { half: [reach(0)?, reach(1)?], ..*self })
    }

    fn halves(&self, axis: usize) -> [Self; 2] {
        let mut parts = [*self; 2];
        for (part, sign) in parts.iter_mut().zip([-0.5, 0.5]) {
            part.centre[axis] += sign * self.half[axis];
            part.half[axis] = half_of(self.half[axis], self.centre[axis]);
        }
        parts
    }
}

/// Half of an interval's radius, and what covers the rounding of the middles.
pub(super) fn half_of(half: f64, middle: f64) -> f64 {
    0.5 * half + 2.0 * f64::EPSILON * (half + middle.abs())
}

/// The radius about a middle that includes an interval that meets the present one. `None` if it does not meet it. An
/// angle may be moved by a turn.
pub(super) fn reach(middle: f64, half: f64, interval: Enclosure, is_angle: bool) -> Option<f64> {
    let turn = Enclosure::PI.times(2.0);
    let moved = |by: Enclosure| {
        let offset = interval + by - Enclosure::of(middle);
        offset.meets(Enclosure::around(half)).then(|| half.max(offset.magnitude()))
    };
    let found = moved(Enclosure::ZERO);
    if is_angle { found.or_else(|| moved(turn)).or_else(|| moved(-turn)) } else { found }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The unit circle and the line y = x + c, in plain coordinates.
    struct CircleAndLine(f64);

    impl PlaneEquations for CircleAndLine {
        const ANGLES: [bool; 2] = [false, false];

        fn over(&self, rectangle: &Rectangle) -> Option<[EquationRange; 2]> {
            let [x, y] = [0, 1].map(|i| Enclosure::of(rectangle.centre[i]).widened(rectangle.half[i]));
            let circle = EquationRange {
                value: x.square() + y.square() - Enclosure::ONE,
                slopes: [x.times(2.0), y.times(2.0)],
            };
            let line = EquationRange {
                value: y - x - Enclosure::of(self.0),
                slopes: [-Enclosure::ONE, Enclosure::ONE],
            };
            Some([circle, line])
        }
    }

    fn knows_all(line: f64, known: &[[f64; 2]]) -> bool {
        let known: Vec<_> =
            known.iter().map(|at| at.map(|number| Enclosure::of(number).widened(1e-12))).collect();
        let everywhere = Rectangle { centre: [0.01, -0.02], half: [3.0, 3.0] };
        PlaneSearch::new(&CircleAndLine(line), &known).knows_all_of(&everywhere)
    }

    #[test]
    fn a_missing_solution_is_noticed() {
        let half = 0.5_f64.sqrt();
        let both = [[half, half], [-half, -half]];
        assert!(knows_all(0.0, &both));
        assert!(!knows_all(0.0, &both[..1]) && !knows_all(0.0, &both[1..]) && !knows_all(0.0, &[]));
        assert!(knows_all(1.5, &[]), "the line passes beside the circle");
    }

    #[test]
    fn a_double_solution_is_not_proved() {
        let half = 0.5_f64.sqrt();
        let touching = 2.0_f64.sqrt();
        assert!(!knows_all(touching, &[[-half, half]]) && !knows_all(touching, &[]));
    }

    #[test]
    fn an_angle_is_found_a_turn_away() {
        let angle = Enclosure::of(-3.1).widened(1e-9);
        assert!(reach(3.1, 0.1, angle, false).is_none());
        assert!(reach(3.1, 0.1, angle, true).is_some_and(|reach| reach == 0.1));
        assert!(reach(3.1, 0.08, angle, true).is_none());
    }
}
