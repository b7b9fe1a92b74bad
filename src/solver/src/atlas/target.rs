//! The curves that an atlas is made of, as zeros of functions of a configuration.

use super::leg_one::Shape;
use super::place::{Configuration, Place};
use super::request::Space;
use super::scalar::{COORDINATES, Dual, Scalar};

/// A function of a configuration; its zeros are a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// `det_P` without the factors that [`Place::determinant`] leaves out.
    Parallel,
    /// X1, which is a factor of `det_P` for e1 = e2.
    MirrorPlane,
    /// w1, which is a factor of `det_P` on the level branch.
    Constraint,
    /// The height of leg II.
    LegTwo,
    /// The height of leg III.
    LegThree,
    /// The height of rod 11.
    RodEleven,
    /// The height of rod 12.
    RodTwelve,
}

/// A quantity that is positive, or zero, on the part of a curve that matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bound {
    /// w2.
    LegTwo,
    /// w3.
    LegThree,
    /// The heights of rods 11 and 12.
    RodEleven,
    RodTwelve,
    /// w1.
    LegOne,
    /// cos φ: the rods of leg I do not cross.
    Uncrossed,
    /// X1, where e1 = e2 and the mirror images at X1 and -X1 have the same sliders.
    MirrorSide,
}

/// A set of bounds.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bounds(u8);

/// One curve: which function vanishes, in which plane it is drawn, and which part of it matters.
#[derive(Clone, Copy, Debug)]
pub(super) struct System<'a> {
    pub(super) shape: &'a Shape,
    pub(super) space: Space,
    pub(super) target: Target,
    pub(super) bounds: Bounds,
}

/// Values of the four equations of a curve, and their derivatives.
pub(super) type Linearised = ([f64; 4], [[f64; COORDINATES]; 4]);

impl Target {
    /// The function as a polynomial in w2 and w3: coefficients of 1, w2, w3 and w2 w3.
    pub(super) fn coefficients<T: Scalar>(self, place: &Place<'_, T>) -> [T; 4] {
        let [zero, one] = [0.0, 1.0].map(T::constant);
        match self {
            Self::Parallel => place.determinant(),
            Self::MirrorPlane => [place.x1(), zero, zero, zero],
            Self::Constraint => [place.w1(), zero, zero, zero],
            Self::LegTwo => [zero, one, zero, zero],
            Self::LegThree => [zero, zero, one, zero],
            Self::RodEleven => [place.rods_of_leg_one()[0], zero, zero, zero],
            Self::RodTwelve => [place.rods_of_leg_one()[1], zero, zero, zero],
        }
    }

    /// Whether the curve is the critical set of the map to the joints: it may turn back there.
    pub(super) fn is_critical(self) -> bool {
        matches!(self, Self::Parallel | Self::MirrorPlane)
    }
}

impl Bound {
    fn value(self, place: &Place<'_, f64>, q: &Configuration) -> f64 {
        match self {
            Self::LegTwo => q[3],
            Self::LegThree => q[4],
            Self::RodEleven => place.rods_of_leg_one()[0],
            Self::RodTwelve => place.rods_of_leg_one()[1],
            Self::LegOne => place.w1(),
            Self::Uncrossed => place.uncrossed(),
            Self::MirrorSide => q[0],
        }
    }

    const ALL: [Self; 7] = [
        Self::LegTwo,
        Self::LegThree,
        Self::RodEleven,
        Self::RodTwelve,
        Self::LegOne,
        Self::Uncrossed,
        Self::MirrorSide,
    ];
}

impl Bounds {
    pub(super) fn of(bounds: &[Bound]) -> Self {
        Self(bounds.iter().fold(0, |set, bound| set | 1 << *bound as u8))
    }

    pub(super) fn with(self, bound: Bound) -> Self {
        Self(self.0 | 1 << bound as u8)
    }

    pub(super) fn contains(self, bound: Bound) -> bool {
        self.0 & 1 << bound as u8 != 0
    }

    fn iter(self) -> impl Iterator<Item = Bound> {
        Bound::ALL.into_iter().filter(move |bound| self.contains(*bound))
    }
}

impl System<'_> {
    /// The least of the bounds.
    pub(super) fn reserve(&self, q: &Configuration) -> f64 {
        let place = self.shape.place(q);
        self.bounds.iter().map(|bound| bound.value(&place, q)).fold(f64::INFINITY, f64::min)
    }

    pub(super) fn image(&self, q: &Configuration) -> [f64; 2] {
        self.shape.image(self.space, q)
    }

    /// The equations at a configuration.
    pub(super) fn linearised(&self, q: &Configuration) -> Linearised {
        let place = self.shape.place_with_slopes(q);
        let [w2, w3] = [Dual::of(q[3], 1.0, 3), Dual::of(q[4], 1.0, 4)];
        let [second, third] = place.height_squares();
        let [a, b, c, d] = self.target.coefficients(&place);
        let equations = [
            place.leg_one_error(),
            w2.square() - second,
            w3.square() - third,
            a + b * w2 + c * w3 + d * w2 * w3,
        ];
        (equations.map(|equation| equation.value), equations.map(|equation| equation.slopes))
    }

    /// The derivatives of the point of the plane.
    pub(super) fn image_slopes(&self, q: &Configuration) -> [[f64; COORDINATES]; 2] {
        let ([u, v], factor) = self.shape.place_with_slopes(q).image(self.space);
        let [mut u, mut v] = [u.slopes, v.slopes];
        u[3] += factor;
        v[4] += factor;
        [u, v]
    }
}
