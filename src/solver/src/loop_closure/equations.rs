//! The two equations of a loop closure, and a solution of them.

use std::f64::consts::TAU;

use arrayvec::ArrayVec;

use crate::trig_polynomial::TrigPolynomial;

/// [`LoopClosure::converged_step`] of a closure whose curvature is of the order of one.
pub(crate) const CONVERGED_STEP: f64 = 3e-8;
/// Angle within which two roots of one closure are the same root found twice.
const SAME_ANGLE: f64 = 1e-9;
/// Relative difference of w within which they are.
const SAME_W: f64 = 1e-6;

/// Two equations f = 0 in (a, w) and their derivatives. The first is linear in w, the second quadratic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Equations {
    pub(crate) f: [f64; 2],
    pub(crate) da: [f64; 2],
    pub(crate) dw: [f64; 2],
}

impl Equations {
    /// The determinant of the derivatives.
    #[inline(always)]
    pub(super) fn determinant(&self) -> f64 {
        self.da[0] * self.dw[1] - self.da[1] * self.dw[0]
    }
}

/// A loop closure with its eliminated polynomial of degree M - 1.
pub(crate) trait LoopClosure<const M: usize> {
    /// The eliminated polynomial and a bound of its rounding error's scale.
    fn polynomial(&self) -> (TrigPolynomial<M>, f64);
    /// The equations at the angle of cosine `c` and sine `s`.
    fn equations(&self, c: f64, s: f64, w: f64) -> Equations;
    /// w₊ and w₋ at an angle; `None` where the quadratic has no real root.
    fn branches(&self, c: f64, s: f64) -> Option<[f64; 2]>;
    /// w at a simple root of the polynomial, from the equation linear in w where it determines w.
    fn w_at_root(&self, c: f64, s: f64) -> f64;
    /// The scale of w.
    fn w_scale(&self) -> f64;
    /// Positive where the branches exist, zero where they meet, negative where there are none.
    fn discriminant(&self, c: f64, s: f64) -> f64;
    /// Value below which the linear equation is satisfied within its rounding error.
    fn rounding(&self, c: f64, s: f64, w: f64) -> f64;
    /// The Newton step at a root whose square, times the closure's curvature there, is negligible in double
    /// precision.
    fn converged_step(&self, root: &Root) -> f64;
}

/// A solution of the loop closure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Root {
    /// The angle; within a turn of (-π, π].
    pub(crate) a: f64,
    /// Its cosine.
    pub(crate) c: f64,
    /// Its sine.
    pub(crate) s: f64,
    pub(crate) w: f64,
    /// Two solutions that double precision cannot tell apart.
    pub(crate) merged: bool,
}

/// All solutions of a loop closure.
pub(crate) type Roots = ArrayVec<Root, 8>;

impl Root {
    /// A simple root, or a start for Newton's method.
    #[inline(always)]
    pub(crate) fn at(a: f64, [c, s]: [f64; 2], w: f64) -> Self {
        Self { a, c, s, w, merged: false }
    }

    /// The approximate angle between two solutions.
    #[inline]
    pub(super) fn angle_to(&self, other: &Self) -> f64 {
        (self.c - other.c).abs() + (self.s - other.s).abs()
    }

    /// Whether both are the same solution, up to rounding.
    #[inline]
    pub(super) fn coincides(&self, other: &Self) -> bool {
        self.angle_to(other) < SAME_ANGLE
            && (self.w - other.w).abs() <= SAME_W * (self.w.abs() + other.w.abs())
    }

    /// The angle shifted by whole turns into an arc, if it lies there.
    #[inline]
    pub(super) fn angle_within(&self, low: f64, high: f64) -> Option<f64> {
        [self.a, self.a + TAU, self.a - TAU].into_iter().find(|a| (low..=high).contains(a))
    }
}

/// Adds a root that is not there yet.
pub(super) fn add(roots: &mut Roots, root: Root) {
    if !roots.iter().any(|other| other.coincides(&root)) && !roots.is_full() {
        roots.push(root);
    }
}
