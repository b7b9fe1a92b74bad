//! Enclosures of cosines, sines and angles.
//!
//! # The error of the crate's cosine and sine
//!
//! [`fast_math::sin_cos`](crate::fast_math::sin_cos) splits off k quarter turns. Up to eight of them, it subtracts the
//! first 37 bits of k π/2 without a rounding error. What remains of k π/2 rounds by less than 1e-26, and the difference
//! x, at most π/4, by 2^-54. With u = 2^-53 the further errors are, for the sine and for the cosine:
//!
//! - the polynomials: 4e-18;
//! - what they add to x and to 1 - x²/2: at most 0.082, and 0.016, with a relative error below 8 u;
//! - x²/2, at most 0.31: u/3; its difference with the polynomial: u/4;
//! - the last sum, below 1: u/2.
//!
//! The sum is below 2 u. [`ERROR`] is twice as large.

use std::f64::consts::TAU;

use super::enclosure::Enclosure;
use crate::fast_math::sin_cos;

/// Bound of the error of a cosine and of a sine: 2^-51.
pub(super) const ERROR: f64 = 2.0 * f64::EPSILON;

/// Cosine and sine of an angle within two turns of zero.
#[inline(always)]
pub(super) fn direction(angle: f64) -> [Enclosure; 2] {
    debug_assert!(angle.abs() <= 2.0 * TAU, "a larger angle loses more digits");
    let (s, c) = sin_cos(angle);
    bounds([c, s])
}

/// The bounds of a cosine and a sine that were rounded as [`direction`] does.
#[inline(always)]
pub(super) fn bounds(rounded: [f64; 2]) -> [Enclosure; 2] {
    rounded.map(|number| Enclosure::of(number).widened(ERROR))
}

/// Cosine and sine of all angles within `half` of one that has this cosine and sine. With the change d of the angle,
/// cos(a + d) = cos a cos d - sin a sin d, 1 - d²/2 ≤ cos d ≤ 1 and |sin d| ≤ |d|.
#[inline(always)]
pub(super) fn turned_within([c, s]: [Enclosure; 2], half: f64) -> [Enclosure; 2] {
    let sine = Enclosure::around(half);
    let cosine = Enclosure { high: 1.0, ..Enclosure::ONE - sine.square().times(0.5) };
    let within_one = |number: Enclosure| Enclosure::new(number.low.max(-1.0), number.high.min(1.0));
    [c * cosine - s * sine, s * cosine + c * sine].map(within_one)
}

/// Cosine and sine of an interval of angles.
pub(super) fn directions(angles: Enclosure) -> [Enclosure; 2] {
    if angles == Enclosure::ZERO {
        return [Enclosure::ONE, Enclosure::ZERO];
    }
    let middle = angles.middle();
    let half = (angles - Enclosure::of(middle)).magnitude();
    turned_within(direction(middle), half)
}

/// The angle of the vectors (x, y), in a range of less than half a turn about one in [-π, π]. `None` if the vectors
/// have all directions, or nearly so.
///
/// A rounded angle serves as the axis: the vectors' angles from it have the tangent of across/along, which is not less
/// than the angle.
pub(super) fn angle_of(x: Enclosure, y: Enclosure) -> Option<Enclosure> {
    let rounded = y.middle().atan2(x.middle());
    let [c, s] = direction(rounded);
    let (along, across) = (x * c + y * s, y * c - x * s);
    let tangent = across * along.reciprocal().filter(|_| along.low > 0.0)?;
    Some(Enclosure::of(rounded).widened(tangent.magnitude()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cosine and sine by their Taylor series, from the last factor: 1 - x²/2 (1 - x²/12 (1 - …)) and x (1 - x²/6 (1 -
    /// …)). The series for angles up to half a turn ends after π^32/32!, which is below 1e-19.
    fn series(angle: f64) -> [Enclosure; 2] {
        let square = Enclosure::of(angle).square();
        let sum = |odd: f64| {
            (1..=15).rev().fold(Enclosure::ONE, |sum, n| {
                let last = 2.0 * f64::from(n) + odd;
                let inverse = Enclosure::of(last * (last - 1.0)).reciprocal().unwrap_or(Enclosure::ONE);
                Enclosure::ONE - square * inverse * sum
            })
        };
        [sum(0.0), sum(1.0) * Enclosure::of(angle)].map(|number| number.widened(1e-18))
    }

    #[test]
    fn directions_contain_the_series() {
        for i in -20_000..=20_000 {
            let angle = f64::from(i) * 1.57e-4;
            for (found, expected) in direction(angle).into_iter().zip(series(angle)) {
                // The series itself is less precise for larger angles.
                let is_inside = found.contains(Enclosure::of(expected.middle()));
                assert!(found.meets(expected) && (angle.abs() > 1.6 || is_inside), "{angle}");
            }
        }
    }

    #[test]
    fn angles_of_an_interval_have_their_directions_inside() {
        for i in -60..=60_i32 {
            let (middle, half) = (f64::from(i) * 0.1, 0.05 * f64::from(i.abs() % 7));
            let all = directions(Enclosure::new(middle - half, middle + half));
            for part in [-1.0, -0.3, 0.0, 0.5, 1.0] {
                let one = direction(middle + part * half);
                assert!((0..2).all(|i| all[i].meets(one[i])), "{middle} {half}");
            }
        }
    }

    #[test]
    fn the_angle_of_a_direction_is_inside() {
        for i in -31..=31 {
            let angle = f64::from(i) * 0.1;
            let [c, s] = direction(angle);
            let found = angle_of(c.times(3.0), s.times(3.0));
            assert!(found.is_some_and(|found| found.contains(Enclosure::of(angle))), "{angle}");
            assert!(found.is_some_and(|found| found.high - found.low < 1e-14), "{angle}");
        }
        assert_eq!(angle_of(Enclosure::around(1.0), Enclosure::around(1.0)), None);
    }
}
