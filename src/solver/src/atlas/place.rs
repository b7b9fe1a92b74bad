//! A configuration of the parallel module, which is a posture up to a common shift along z, and what follows from it.
//!
//! Its coordinates are X1, m, φ (see [`super::leg_one`]) and the heights w2 and w3 of legs II and III, in units of
//! the longest dimension; on the level branch X1, y, w1, w2 and w3. Three equations hold: leg I closes, and both
//! heights fit the lengths of their legs.

use super::leg_one::{Branch, LegOneAngles, Shape};
use super::request::Space;
use super::scalar::{COORDINATES, Dual, Scalar};

/// Five coordinates.
pub(super) type Configuration = [f64; COORDINATES];

/// The platform with leg I, and what depends on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<'a, T> {
    shape: &'a Shape,
    /// `None` on the level branch.
    angles: Option<(LegOneAngles<T>, T)>,
    x1: T,
    y: T,
    w1: T,
    /// cos a and sin a.
    c: T,
    s: T,
}

impl<'a, T: Scalar> Place<'a, T> {
    pub(super) fn new(shape: &'a Shape, [x1, m]: [T; 2], angles: LegOneAngles<T>) -> Self {
        let (y, w1) = (m * angles.sin_phi, m * angles.cos_phi);
        Self { shape, angles: Some((angles, m)), x1, y, w1, c: angles.c, s: angles.s }
    }

    /// A place on the level branch.
    pub(super) fn level(shape: &'a Shape, [x1, y, w1]: [T; 3]) -> Self {
        Self { shape, angles: None, x1, y, w1, c: T::constant(1.0), s: T::constant(0.0) }
    }

    pub(super) fn x1(&self) -> T {
        self.x1
    }

    pub(super) fn w1(&self) -> T {
        self.w1
    }

    fn x2(&self) -> T {
        self.x1.plus(self.shape.offset)
    }

    /// R2 cos a - r4.
    fn p(&self) -> T {
        self.c.times(self.shape.R2).plus(-self.shape.r4)
    }

    /// R2 sin a.
    fn q(&self) -> T {
        self.s.times(self.shape.R2)
    }

    /// Heights of rods 11 and 12.
    pub(super) fn rods_of_leg_one(&self) -> [T; 2] {
        let v = self.s.times(self.shape.R1);
        [self.w1 + v, self.w1 - v]
    }

    /// u over R1, or a multiple of it with the same sign: positive if the rods of leg I do not cross.
    pub(super) fn uncrossed(&self) -> T {
        self.angles.as_ref().map_or(T::constant(1.0), |(angles, _)| angles.cos_phi)
    }

    /// The squares of the heights of legs II and III.
    pub(super) fn height_squares(&self) -> [T; 2] {
        let [_, second, third] = self.shape.squares;
        let (x2, p) = (self.x2().square(), self.p());
        [
            (x2 + (self.y - p).square()).times(-1.0).plus(second),
            (x2 + (self.y + p).square()).times(-1.0).plus(third),
        ]
    }

    /// The square of leg I's extent less L1².
    pub(super) fn leg_one_error(&self) -> T {
        let across = match &self.angles {
            None => self.y.square() + self.w1.square(),
            Some((angles, m)) => m.square() + angles.arm.square(),
        };
        (self.x1.square() + across).plus(-self.shape.squares[0])
    }

    /// Zero where two angles of leg I merge: the platform's y is stationary along leg I's motion at constant X1. On
    /// the branches of R1 = r1 that is where they meet.
    pub(super) fn leg_one_fold(&self) -> T {
        let Some((LegOneAngles { cos_phi, sin_phi, arm, cos_psi, .. }, m)) = self.angles else {
            return self.w1;
        };
        if self.shape.branch == Branch::Crossed {
            return cos_phi;
        }
        (m.square() * cos_phi * cos_psi).times(self.shape.R1)
            - (arm.square() * sin_phi.square()).times(self.shape.r1)
    }

    /// The coordinates in the plane of an atlas, in units of the longest dimension, without the heights of legs II
    /// and III; the second number is the factor of these.
    pub(super) fn image(&self, space: Space) -> ([T; 2], f64) {
        match space {
            Space::Platform => ([self.x1.plus(-self.shape.e1), self.y], 0.0),
            Space::Joints => ([self.w1 - self.q(), self.w1 + self.q()], -1.0),
        }
    }

    /// The second to fourth numbers of half the difference of leg I's rows in the parallel matrix; and y times the
    /// third less w1 times the second. The factor cos ψ, which is positive, is left out; for R1 = r1 it vanishes
    /// where the two branches meet. On the level branch the factor m is left out besides: w1 = m cos ψ there.
    fn difference(&self) -> ([T; 3], T) {
        let (zero, r1) = (T::constant(0.0), self.shape.R1);
        let Some((LegOneAngles { cos_phi, sin_phi, scaled_arm, .. }, m)) = self.angles else {
            return ([zero, zero, T::constant(r1)], zero);
        };
        ([scaled_arm * cos_phi, -(scaled_arm * sin_phi), m.times(r1)], -(scaled_arm * m))
    }

    /// `det_P` of the equations (A), (5) and (6), less the factors that vanish everywhere on known curves, as a
    /// polynomial in w2 and w3: coefficients of 1, w2, w3 and w2 w3. For e1 = e2 the factor X1 is left out.
    pub(super) fn determinant(&self) -> [T; 4] {
        let Self { shape, y, w1, c, .. } = *self;
        let (p, q, r2) = (self.p(), self.q(), shape.R2);
        let ([a1, a2, a3], u12) = self.difference();
        let (x1, x2) = if shape.has_equal_offsets() {
            (T::constant(1.0), T::constant(1.0))
        } else {
            (self.x1, self.x2())
        };
        // Minors of the rows of leg I: their mean (X1, y, w1, R1 r1 sin a), and half their difference.
        let turn = self.s.times(shape.R1 * shape.r1);
        let [u01, u02, u03] = [x1 * a1, x1 * a2, x1 * a3];
        let [u13, u23] = [y * a3 - turn * a1, w1 * a3 - turn * a2];
        let [b2, b3] = [y - p, y + p];
        let free =
            (q * (b2 * b3) * u02).times(2.0) - (x2 * q * y * u12).times(2.0) + (p * x2 * u23).times(2.0);
        let common = (x2 * c * u12).times(r2);
        let second = common - q * b3 * u01 - (c * b3 * u02).times(r2) - b3 * u03 + x2 * u13;
        let third = common - q * b2 * u01 - (c * b2 * u02).times(r2) + b2 * u03 - x2 * u13;
        [free, second, third, (c * u01).times(2.0 * r2)]
    }
}

impl Shape {
    /// The place of a configuration.
    pub(super) fn place(&self, q: &Configuration) -> Place<'_, f64> {
        if self.branch == Branch::Level {
            return Place::level(self, [q[0], q[1], q[2]]);
        }
        Place::new(self, [q[0], q[1]], self.angles(q[2]).map(|[value, _]| value))
    }

    /// The same with derivatives.
    pub(super) fn place_with_slopes(&self, q: &Configuration) -> Place<'_, Dual> {
        let [x1, second, third] = [0, 1, 2].map(|axis| Dual::of(q[axis], 1.0, axis));
        if self.branch == Branch::Level {
            return Place::level(self, [x1, second, third]);
        }
        let angles = self.angles(q[2]).map(|[value, slope]| Dual::of(value, slope, 2));
        Place::new(self, [x1, second], angles)
    }

    /// The point of the plane of a configuration.
    pub(super) fn image(&self, space: Space, q: &Configuration) -> [f64; 2] {
        let ([u, v], factor) = self.place(q).image(space);
        [u + factor * q[3], v + factor * q[4]]
    }
}
