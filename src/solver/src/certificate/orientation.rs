//! Orientations of a tool that are known within bounds.

use std::f64::consts::TAU;

use super::angle::directions;
use super::enclosure::Enclosure;
use crate::axis::{Preimages, preimages};

/// The orientation of a tool in the part frame: cosine and sine of phi1 and of phi2, each within bounds.
///
/// # Units
///
/// Radians.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (8), (9), (14).
///
/// # Examples
///
/// ```
/// use verne_solver::certificate::EnclosedOrientation;
///
/// // No double is 20° in radians. These bounds contain it.
/// let phi1 = 20_f64.to_radians();
/// assert!(EnclosedOrientation::within([phi1.next_down(), phi1.next_up()], [0.0, 0.0]).is_some());
/// assert_eq!(EnclosedOrientation::within([0.0, 7.0], [0.0, 0.0]), None, "more than a turn");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnclosedOrientation {
    /// Cosine and sine.
    pub(super) phi1: [Enclosure; 2],
    pub(super) phi2: [Enclosure; 2],
}

impl EnclosedOrientation {
    /// All orientations with phi1 and phi2 within these bounds. `None` if a bound is not within a turn of zero, or a
    /// lower bound is above its upper one.
    ///
    /// # Units
    ///
    /// Radians.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::certificate::EnclosedOrientation;
    ///
    /// assert!(EnclosedOrientation::within([0.1, 0.1], [-3.0, -2.9]).is_some());
    /// ```
    pub fn within(phi1: [f64; 2], phi2: [f64; 2]) -> Option<Self> {
        let is_valid = |[low, high]: [f64; 2]| -TAU <= low && low <= high && high <= TAU && high - low <= TAU;
        let turn = |[low, high]: [f64; 2]| directions(Enclosure::new(low, high));
        (is_valid(phi1) && is_valid(phi2)).then(|| Self { phi1: turn(phi1), phi2: turn(phi2) })
    }

    /// Both orientations with a tool axis, in the order of [`preimages`]. `None` if the axis leaves phi2 free, or is no
    /// direction.
    ///
    /// # Units
    ///
    /// The axis may have any unit.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (8), (9), (14).
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::certificate::EnclosedOrientation;
    ///
    /// assert!(EnclosedOrientation::of_axis([0.3, -0.4, 1.2]).is_some());
    /// assert_eq!(EnclosedOrientation::of_axis([0.0, 0.0, 1.0]), None);
    /// ```
    pub fn of_axis(axis: [f64; 3]) -> Option<[Self; 2]> {
        let Preimages::Two(_) = preimages(axis)? else { return None };
        let scale = power_of_two_near_inverse(axis.iter().fold(0.0, |most, c| most.max(c.abs())));
        let [i, j, k] = axis.map(|component| Enclosure::of(component).times(scale));
        let across_square = i.square() + j.square();
        let across = across_square.root()?;
        let (inverse, azimuth) = ((across_square + k.square()).root()?.reciprocal()?, across.reciprocal()?);
        let (cosine, sine) = (k * inverse, across * inverse);
        let phi2 = [-j * azimuth, i * azimuth];
        Some([
            Self { phi1: [cosine, sine], phi2 },
            Self { phi1: [cosine, -sine], phi2: phi2.map(|number| -number) },
        ])
    }
}

/// A power of two whose product with a positive number is of the order of one. Multiplying by it does not round, but
/// for numbers that are negligible beside it.
fn power_of_two_near_inverse(number: f64) -> f64 {
    const BITS: u32 = f64::MANTISSA_DIGITS - 1;
    let exponent = (number.to_bits() >> BITS).clamp(1, 2045);
    f64::from_bits((2046 - exponent) << BITS)
}
