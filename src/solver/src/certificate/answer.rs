//! What is proved of a request's solutions.

use arrayvec::ArrayVec;

use super::enclosure::Enclosure;
use crate::posture::MAX_POSTURES;

/// The solutions that a request asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// All.
    All,
    /// Those in the working mode.
    Working,
}

/// A box that contains exactly one solution: `[low, high]` of each coordinate. The coordinates that the request gives
/// have equal bounds. It contains the posture that was proved, too, so its width bounds the posture's error.
///
/// Lengths are millimetres. alpha is in radians and may exceed π. Still exactly one solution is inside if alpha's
/// bounds are moved outwards by up to 1e-14 rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PostureBox {
    /// x of P.
    pub x: [f64; 2],
    /// y of P.
    pub y: [f64; 2],
    /// z of P.
    pub z: [f64; 2],
    /// Rotation of the platform.
    pub alpha: [f64; 2],
    /// The sliders.
    pub rho: [[f64; 2]; 3],
}

/// Distance, rad, by which alpha's bounds of a [`PostureBox`] can be moved.
pub(super) const ALPHA_MARGIN: f64 = 1e-14;

/// The reason why no box is proved for a posture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unproved {
    /// Two solutions coincide within double precision: [`Posture::merged`](crate::Posture::merged).
    Merged,
    /// The posture is so near to a singularity that rounding decides about the equations.
    NearSingularity,
}

/// The reason why it is not proved that there are no other solutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Incomplete {
    /// A posture has no box.
    Unproved,
    /// Rounding decides whether there is another solution, or the search would take too long: solutions nearly merge,
    /// or they form a curve.
    Undecided,
    /// Rounding decides whether a solution is in the working mode.
    UndecidedMode,
}

/// What is proved of the postures of a request.
#[derive(Clone, Debug, PartialEq)]
pub struct Certification {
    /// The box of each posture, in their order.
    pub boxes: ArrayVec<Result<PostureBox, Unproved>, MAX_POSTURES>,
    /// `Ok` if the equations have no solution in the scope but those in the boxes.
    pub complete: Result<(), Incomplete>,
}

impl From<Enclosure> for [f64; 2] {
    fn from(bounds: Enclosure) -> Self {
        [bounds.low, bounds.high]
    }
}
