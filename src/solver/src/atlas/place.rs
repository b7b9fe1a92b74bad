//! A configuration of the parallel module, which is a posture up to a common shift along z, and what follows from it.
//!
//! Its coordinates are X1, m, φ (see [`super::leg_one`]) and the heights w2 and w3 of legs II and III, in units of the
//! longest dimension. Three equations hold: leg I closes, and both heights fit the lengths of their legs.

use super::leg_one::{Branch, LegOneAngles, Shape};
use super::request::Space;
use super::scalar::{COORDINATES, Dual, Scalar};

/// Coordinates of a configuration: X1, m, φ, w2, w3.
pub(super) type Configuration = [f64; COORDINATES];

/// The platform with leg I closed, and what depends on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<'a, T> {
    shape: &'a Shape,
    angles: LegOneAngles<T>,
    x1: T,
    m: T,
    pub(super) y: T,
    pub(super) w1: T,
    p: T,
    q: T,
}

impl<'a, T: Scalar> Place<'a, T> {
    pub(super) fn new(shape: &'a Shape, [x1, m]: [T; 2], angles: LegOneAngles<T>) -> Self {
        Self {
            shape,
            x1,
            m,
            y: m * angles.sin_phi,
            w1: m * angles.cos_phi,
            p: angles.c.times(shape.R2).plus(-shape.r4),
            q: angles.s.times(shape.R2),
            angles,
        }
    }

    /// v = R1 sin a.
    fn v(&self) -> T {
        self.angles.s.times(self.shape.R1)
    }

    fn x2(&self) -> T {
        self.x1.plus(self.shape.offset)
    }

    /// The squares of the heights of legs II and III.
    pub(super) fn height_squares(&self) -> [T; 2] {
        let [_, second, third] = self.shape.squares;
        let x2 = self.x2().square();
        [
            (x2 + (self.y - self.p).square()).times(-1.0).plus(second),
            (x2 + (self.y + self.p).square()).times(-1.0).plus(third),
        ]
    }

    /// X1² + m² + ℓ² - L1².
    pub(super) fn leg_one_error(&self) -> T {
        (self.x1.square() + self.m.square() + self.angles.arm.square()).plus(-self.shape.squares[0])
    }

    /// The coordinates in the plane of an atlas, in units of the longest dimension, without the heights of legs II and
    /// III; the second number is the factor of these.
    pub(super) fn image(&self, space: Space) -> ([T; 2], f64) {
        match space {
            Space::Platform => ([self.x1.plus(-self.shape.e1), self.y], 0.0),
            Space::Joints => ([self.w1 - self.q, self.w1 + self.q], -1.0),
        }
    }

    /// Heights of rods 11 and 12.
    pub(super) fn rods_of_leg_one(&self) -> [T; 2] {
        [self.w1 + self.v(), self.w1 - self.v()]
    }

    /// `det_P` of the equations (A), (5) and (6), less the factors that vanish everywhere on known curves, as a
    /// polynomial in w2 and w3: coefficients of 1, w2, w3 and w2 w3.
    ///
    /// For R1 = r1 the factor cos φ, or m cos φ, is left out: it vanishes where the two branches of leg I meet. For e1
    /// = e2 the factor X1 is left out.
    pub(super) fn determinant(&self) -> [T; 4] {
        let Self { shape, y, w1, p, q, m, .. } = *self;
        let LegOneAngles { cos_phi, sin_phi, arm, cos_psi, c, s } = self.angles;
        let ([a1, a2], a3, cross) = match shape.branch {
            Branch::Only => ([arm * cos_phi, -(arm * sin_phi)], (m * cos_psi).times(shape.R1), -(arm * m)),
            Branch::Level => ([T::constant(0.0); 2], T::constant(shape.R1), T::constant(0.0)),
            Branch::Crossed => {
                let twice = 2.0 * shape.R1;
                ([cos_phi.times(-twice), sin_phi.times(twice)], m.times(-shape.R1), m.times(twice))
            }
        };
        let (x1, x2) = if shape.has_equal_offsets() {
            (T::constant(1.0), T::constant(1.0))
        } else {
            (self.x1, self.x2())
        };
        // Minors of the rows of leg I: their mean and half their difference.
        let turn = s.times(shape.R1 * shape.r1);
        let [u01, u02, u03] = [x1 * a1, x1 * a2, x1 * a3];
        let [u12, u13, u23] = [cross, y * a3 - turn * a1, w1 * a3 - turn * a2];
        let (r2, [b2, b3]) = (shape.R2, [y - p, y + p]);
        let sb = q * (b2 * b3);
        let level = (sb * u02).times(2.0) - (x2 * q * y * u12).times(2.0) + (p * x2 * u23).times(2.0);
        let common = (x2 * c * u12).times(r2);
        let second = common - q * b3 * u01 - (c * b3 * u02).times(r2) - b3 * u03 + x2 * u13;
        let third = common - q * b2 * u01 - (c * b2 * u02).times(r2) + b2 * u03 - x2 * u13;
        [level, second, third, (c * u01).times(2.0 * r2)]
    }

    pub(super) fn x1(&self) -> T {
        self.x1
    }

    pub(super) fn cos_phi(&self) -> T {
        self.angles.cos_phi
    }

    /// On the two sides of it leg I has one angle more or less at the same x and y: zero where two angles merge.
    pub(super) fn leg_one_fold(&self) -> T {
        let Self { shape, m, .. } = *self;
        let LegOneAngles { cos_phi, sin_phi, arm, cos_psi, .. } = self.angles;
        match shape.branch {
            Branch::Only => {
                (m.square() * cos_phi * cos_psi).times(shape.R1)
                    - (arm.square() * sin_phi.square()).times(shape.r1)
            }
            Branch::Level | Branch::Crossed => cos_phi,
        }
    }
}

impl Shape {
    pub(super) fn has_equal_offsets(&self) -> bool {
        self.offset == 0.0
    }

    /// The place of a configuration.
    pub(super) fn place(&self, q: &Configuration) -> Place<'_, f64> {
        Place::new(self, [q[0], q[1]], self.angles(q[2]).map(|[value, _]| value))
    }

    /// The same with derivatives.
    pub(super) fn place_with_slopes(&self, q: &Configuration) -> Place<'_, Dual> {
        let angles = self.angles(q[2]).map(|[value, slope]| Dual::of(value, slope, 2));
        Place::new(self, [Dual::of(q[0], 1.0, 0), Dual::of(q[1], 1.0, 1)], angles)
    }

    /// The point of the plane of a configuration.
    pub(super) fn image(&self, space: Space, q: &Configuration) -> [f64; 2] {
        let ([u, v], factor) = self.place(q).image(space);
        [u + factor * q[3], v + factor * q[4]]
    }
}
