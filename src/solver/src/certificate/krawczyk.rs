//! The interval Newton method in the form of Krawczyk.
//!
//! For equations f = 0, a box W about a centre c, bounds J of the derivatives over W and any matrix Y let
//!
//! ```text
//! K(W) = c - Y f(c) + (1 - Y J) (W - c)
//! ```
//!
//! Every zero in W lies in K(W). If K(W) lies in the interior of W, there is exactly one zero in W (R. Krawczyk, 1969,
//! [doi:10.1007/BF02234767](https://doi.org/10.1007/BF02234767); R. E. Moore, 1977,
//! [doi:10.1137/0714040](https://doi.org/10.1137/0714040)).

use std::array::from_fn;

use super::enclosure::{Enclosure, are_moderate};

/// Radii of W that are tried, over the scale of each unknown. The first one is small enough for the curvature of nearly
/// all equations, and large beside rounding. The others are for solutions with a large rounding error, and near to a
/// singularity.
const RADII: [f64; 3] = [1e-8, 1e-6, 1e-9];

/// Equations in N unknowns.
pub(super) trait Equations<const N: usize> {
    /// The equations at a point.
    fn values(&self, at: &[f64; N]) -> [Enclosure; N];
    /// Their derivatives, row by row, over a box.
    fn slopes(&self, centre: &[f64; N], radii: &[f64; N]) -> [[Enclosure; N]; N];
    /// The scale of each unknown.
    fn scales(&self) -> [f64; N];
    /// The inverse of a matrix, in double precision.
    fn inverse(matrix: &[[f64; N]; N]) -> Option<[[f64; N]; N]>;
}

/// A zero that is proved.
#[derive(Clone, Copy, Debug)]
pub(super) struct ProvedZero<const N: usize> {
    centre: [f64; N],
    /// W: no other zero lies within these distances of the centre.
    radii: [f64; N],
    /// The zero.
    pub(super) bounds: [Enclosure; N],
}

impl<const N: usize> ProvedZero<N> {
    /// Whether all these numbers lie in W.
    pub(super) fn is_alone_in(&self, unknown: usize, numbers: Enclosure) -> bool {
        Enclosure::around(self.radii[unknown]).contains(numbers - Enclosure::of(self.centre[unknown]))
    }
}

/// Proves that there is exactly one zero near a point, if there is.
pub(super) fn prove<const N: usize, E: Equations<N>>(
    equations: &E,
    centre: [f64; N],
) -> Option<ProvedZero<N>> {
    let values = equations.values(&centre);
    RADII.into_iter().find_map(|radius| {
        let radii = equations.scales().map(|scale| radius * scale);
        let slopes = equations.slopes(&centre, &radii);
        let inverse = E::inverse(&slopes.map(|row| row.map(Enclosure::middle))).filter(are_moderate)?;
        let offsets = image(&values, &slopes, &radii, &inverse)?;
        let bounds = from_fn(|i| Enclosure::of(centre[i]) + offsets[i]);
        Some(ProvedZero { centre, radii, bounds })
    })
}

/// K(W) - c, if it lies in the interior of W - c.
fn image<const N: usize>(
    values: &[Enclosure; N],
    slopes: &[[Enclosure; N]; N],
    radii: &[f64; N],
    inverse: &[[f64; N]; N],
) -> Option<[Enclosure; N]> {
    let offsets: [Enclosure; N] = from_fn(|i| {
        let row = &inverse[i];
        let spread = (0..N).map(|j| {
            let unit = if i == j { Enclosure::ONE } else { Enclosure::ZERO };
            (unit - combined(row, |k| slopes[k][j])).magnitude()
        });
        let rest = spread.zip(radii).map(|(spread, radius)| Enclosure::around(spread).times(*radius));
        rest.fold(-combined(row, |k| values[k]), |sum, part| sum + part)
    });
    let is_inside = (0..N).all(|i| Enclosure::around(radii[i]).strictly_contains(offsets[i]));
    is_inside.then_some(offsets)
}

/// The sum of numbers with these factors.
#[inline(always)]
fn combined<const N: usize>(factors: &[f64; N], number: impl Fn(usize) -> Enclosure) -> Enclosure {
    (1..N).fold(number(0).times(factors[0]), |sum, k| sum + number(k).times(factors[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x² = c.
    struct Square(f64);

    impl Equations<1> for Square {
        fn values(&self, [x]: &[f64; 1]) -> [Enclosure; 1] {
            [Enclosure::of(*x).square() - Enclosure::of(self.0)]
        }

        fn slopes(&self, [x]: &[f64; 1], [radius]: &[f64; 1]) -> [[Enclosure; 1]; 1] {
            [[Enclosure::of(*x).widened(*radius).times(2.0)]]
        }

        fn scales(&self) -> [f64; 1] {
            [1.0]
        }

        fn inverse([[slope]]: &[[f64; 1]; 1]) -> Option<[[f64; 1]; 1]> {
            Some([[1.0 / slope]])
        }
    }

    #[test]
    fn a_simple_zero_is_proved_within_rounding() {
        let zero =
            prove(&Square(2.0), [2.0_f64.sqrt() + 1e-10]).unwrap_or_else(|| unreachable!("√2 is simple"));
        let [root] = zero.bounds;
        assert!(root.square().contains(Enclosure::of(2.0)) && root.high - root.low < 2e-15, "{root:?}");
        assert!(zero.is_alone_in(0, root) && !zero.is_alone_in(0, root.widened(1e-7)));
    }

    #[test]
    fn neither_a_double_zero_nor_none_is_proved() {
        for (c, start) in [(0.0, 0.0), (0.0, 1e-9), (-1e-12, 1e-6), (2.0, 1.0)] {
            assert!(prove(&Square(c), [start]).is_none(), "{c}");
        }
    }
}
