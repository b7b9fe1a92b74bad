//! The loop closure of the forward problem in (a, λ), its polynomial of degree four, and the postures of its roots.

use crate::fast_math::{greater, lesser, wrapped};
use crate::loop_closure::{CONVERGED_STEP, Equations, LoopClosure, Root};
use crate::mechanism::Mechanism;
use crate::pose::PlatformPose;
use crate::posture::{Mode, Posture, Side};
use crate::registers::ROWS;
use crate::residual::{CheckedPose, RESIDUAL_TOLERANCE, checked, checked_once, magnitude};
use crate::trig_polynomial::{TrigPolynomial, linear};

/// With (y, w1) = λ (-v, u), which satisfies the difference of Eqs (3) and (4), and x from their
/// mean with Eqs (5) and (6), two equations remain:
///
/// ```text
/// λ D - N = 0            X1² + (λ² + 1)(C - k cos a) - L1² = 0,   X1 = (λ u S + T) / d
/// ```
///
/// with S = 2 rho1 - rho2 - rho3, d = 2 (e1 - e2) and, of the first degree in cos a and sin a, D = 4 sin a (R2 r1 -
/// R1 r4) + 2 (rho3 - rho2) u, N = K - m S with m = rho3 - rho2 - 2 q, and T as in the crate's documentation.
#[derive(Clone, Copy, Debug)]
pub(super) struct AssemblyClosure {
    r1_platform: f64,
    r1_slider: f64,
    c: f64,
    k: f64,
    l1_square: f64,
    s: f64,
    inverse_d: f64,
    d_sin: f64,
    d_gap: f64,
    n0: f64,
    n_sin: f64,
    t: [f64; 3],
}

impl AssemblyClosure {
    #[inline(always)]
    pub(super) fn new(mechanism: &Mechanism, rho: [f64; 3]) -> Self {
        let g = &mechanism.geometry;
        let [a, b] = [rho[0] - rho[1], rho[0] - rho[2]];
        let gap = rho[2] - rho[1];
        let s = a + b;
        let offset = mechanism.e1 - mechanism.e2;
        let t0 = g.R2 * g.R2 + g.r4 * g.r4 - 0.5 * (g.L2 * g.L2 + g.L3 * g.L3) - mechanism.c
            + g.L1 * g.L1
            + 0.5 * (a * a + b * b)
            + offset * offset;
        Self {
            r1_platform: g.R1,
            r1_slider: g.r1,
            c: mechanism.c,
            k: mechanism.k,
            l1_square: g.L1 * g.L1,
            s,
            inverse_d: 0.5 / offset,
            d_sin: 4.0 * (g.R2 * g.r1 - g.R1 * g.r4),
            d_gap: 2.0 * gap,
            n0: (g.L2 - g.L3) * (g.L2 + g.L3) - gap * s,
            n_sin: 2.0 * g.R2 * s,
            t: [t0, mechanism.k - 2.0 * g.R2 * g.r4, -g.R2 * gap],
        }
    }

    #[inline(always)]
    fn d(&self) -> TrigPolynomial<2> {
        linear(-self.d_gap * self.r1_slider, self.d_gap * self.r1_platform, self.d_sin)
    }

    #[inline(always)]
    fn n(&self) -> TrigPolynomial<2> {
        linear(self.n0, 0.0, self.n_sin)
    }

    /// Whether D and N vanish at every angle. Then λ is undetermined, and the platform can move.
    #[inline(always)]
    pub(super) fn has_self_motion(&self, scale: f64) -> bool {
        self.d().bound(0) + self.n().bound(0) <= 1e-13 * scale * scale
    }

    /// The λ that comes nearest to satisfying the quadratic equation at an angle without branches.
    pub(super) fn vertex(&self, c: f64, s: f64) -> f64 {
        let per_w = (self.r1_platform * c - self.r1_slider) * self.s * self.inverse_d;
        let x0 = (self.t[0] + self.t[1] * c + self.t[2] * s) * self.inverse_d;
        -per_w * x0 / (per_w * per_w + self.c - self.k * c)
    }

    /// The quadratic equation at an angle: a2 λ² + 2 a1 λ + a0.
    #[inline(always)]
    fn quadratic(&self, c: f64, s: f64) -> [f64; 3] {
        let u = self.r1_platform * c - self.r1_slider;
        let spread = self.c - self.k * c;
        let per_w = u * self.s * self.inverse_d;
        let x0 = (self.t[0] + self.t[1] * c + self.t[2] * s) * self.inverse_d;
        [per_w * per_w + spread, per_w * x0, x0 * x0 + spread - self.l1_square]
    }

    /// X1 = x + D1 - d1.
    #[inline(always)]
    pub(super) fn x1(&self, c: f64, s: f64, lambda: f64) -> f64 {
        let u = self.r1_platform * c - self.r1_slider;
        (lambda * u * self.s + self.t[0] + self.t[1] * c + self.t[2] * s) * self.inverse_d
    }

    /// The posture of a root; `None` if it does not satisfy Eqs (3)-(6).
    #[inline]
    pub(super) fn posture(&self, mechanism: &Mechanism, rho: [f64; 3], root: &Root) -> Option<Posture> {
        let found = checked(mechanism, self.pose(mechanism, rho, root), rho);
        let (posture, holds) = labelled(mechanism, rho, root, found);
        holds.then_some(posture)
    }

    /// The posture of a root by the elimination alone, and whether it is that of [`Self::posture`].
    #[inline(always)]
    pub(super) fn uncorrected_posture(
        &self,
        mechanism: &Mechanism,
        rho: [f64; 3],
        root: &Root,
    ) -> (Posture, bool) {
        let (found, is_rounded) = checked_once(mechanism, self.pose(mechanism, rho, root), rho);
        let (posture, holds) = labelled(mechanism, rho, root, found);
        (posture, holds & !is_rounded)
    }

    /// The platform's pose at a root.
    #[inline(always)]
    fn pose(&self, mechanism: &Mechanism, rho: [f64; 3], root: &Root) -> PlatformPose {
        let g = &mechanism.geometry;
        PlatformPose {
            x: self.x1(root.c, root.s, root.w) - mechanism.e1,
            y: -root.w * (g.R1 * root.s),
            z: rho[0] + root.w * (g.R1 * root.c - g.r1),
            alpha: wrapped(root.a),
        }
    }
}

/// The posture of a pose with its labels, and whether it satisfies Eqs (3)-(6).
#[inline(always)]
fn labelled(mechanism: &Mechanism, rho: [f64; 3], root: &Root, found: CheckedPose) -> (Posture, bool) {
    let CheckedPose { pose, residual } = found;
    let g = &mechanism.geometry;
    let (u, v, q) = (g.R1 * root.c - g.r1, g.R1 * root.s, g.R2 * root.s);
    let w1 = root.w * u;
    let heights = [w1, pose.z - q - rho[1], pose.z + q - rho[2]];
    let crossed = mechanism.crosses(pose.alpha);
    let working = !crossed & (w1 > v.abs()) & (heights[1] > 0.0) & (heights[2] > 0.0);
    let mode = Mode { legs: heights.map(Side::of), crossed };
    // A NaN satisfies no equation.
    let holds = residual <= RESIDUAL_TOLERANCE * magnitude(mechanism, pose.z);
    (Posture { pose, rho, mode, working, merged: root.merged, residual }, holds)
}

/// The closures of many rows: the numbers that differ, by coordinate.
#[derive(Clone, Copy, Debug)]
pub(super) struct AssemblyClosureRows {
    /// S, d_gap, n0, n_sin, and the first and the last number of T.
    numbers: [[f64; ROWS]; 6],
}

impl AssemblyClosureRows {
    pub(super) fn new() -> Self {
        Self { numbers: [[0.0; ROWS]; 6] }
    }

    /// Sets a row's closure.
    #[inline(always)]
    pub(super) fn set(&mut self, i: usize, mechanism: &Mechanism, rho: [f64; 3]) {
        let AssemblyClosure { s, d_gap, n0, n_sin, t: [t0, _, t_sin], .. } =
            AssemblyClosure::new(mechanism, rho);
        for (row, number) in self.numbers.iter_mut().zip([s, d_gap, n0, n_sin, t0, t_sin]) {
            row[i] = number;
        }
    }

    #[inline(always)]
    pub(super) fn closure(&self, mechanism: &Mechanism, i: usize) -> AssemblyClosure {
        let [s, d_gap, n0, n_sin, t0, t_sin] = self.numbers.each_ref().map(|row| row[i]);
        let common = AssemblyClosure::new(mechanism, [0.0; 3]);
        AssemblyClosure { s, d_gap, n0, n_sin, t: [t0, common.t[1], t_sin], ..common }
    }
}

impl LoopClosure<5> for AssemblyClosure {
    #[inline]
    fn polynomial(&self) -> (TrigPolynomial<5>, f64) {
        let (d, n) = (self.d(), self.n());
        let u = linear(-self.r1_slider, self.r1_platform, 0.0);
        let t = linear(self.t[0], self.t[1], self.t[2]);
        // F = X² + (C - k cos a) N² + (C - k cos a - L1²) D² with X = D X1.
        let x = t.times(&d).plus(self.s, &u.times(&n));
        let from_n = n.times(&n).times_even(self.c, -self.k);
        let rest = from_n.plus(1.0, &d.times(&d).times_even(self.c - self.l1_square, -self.k));
        let weight = self.inverse_d * self.inverse_d;
        let poly = rest.raised::<5>().plus(weight, &x.squared());
        let (bx, bn, bd) = (x.bound(0), n.bound(0), d.bound(0));
        let magnitude = weight * bx * bx + (self.c + self.k) * (bn * bn + bd * bd) + self.l1_square * bd * bd;
        (poly, magnitude)
    }

    #[inline(always)]
    fn equations(&self, c: f64, s: f64, w: f64) -> Equations {
        let u = self.r1_platform * c - self.r1_slider;
        let du = -self.r1_platform * s;
        let d = self.d_sin * s + self.d_gap * u;
        let dd = self.d_sin * c + self.d_gap * du;
        let n = self.n0 + self.n_sin * s;
        let spread = self.c - self.k * c;
        let x1 = (w * u * self.s + self.t[0] + self.t[1] * c + self.t[2] * s) * self.inverse_d;
        let x1_da = (w * du * self.s - self.t[1] * s + self.t[2] * c) * self.inverse_d;
        let x1_dw = u * self.s * self.inverse_d;
        let stretch = w * w + 1.0;
        Equations {
            f: [w * d - n, x1 * x1 + stretch * spread - self.l1_square],
            da: [w * dd - self.n_sin * c, 2.0 * x1 * x1_da + stretch * self.k * s],
            dw: [d, 2.0 * x1 * x1_dw + 2.0 * w * spread],
        }
    }

    #[inline(always)]
    fn branches(&self, c: f64, s: f64) -> Option<[f64; 2]> {
        let [a2, a1, a0] = self.quadratic(c, s);
        let disc = a1 * a1 - a2 * a0;
        (disc >= 0.0).then(|| {
            let root = disc.sqrt();
            // The larger root first, the other by Vieta: no cancellation.
            let far = -(a1 + root.copysign(a1));
            let (x, y) = if far == 0.0 { (0.0, 0.0) } else { (far / a2, a0 / far) };
            [greater(x, y), lesser(x, y)]
        })
    }

    #[inline]
    fn w_at_root(&self, c: f64, s: f64) -> f64 {
        let u = self.r1_platform * c - self.r1_slider;
        let d = self.d_sin * s + self.d_gap * u;
        (self.n0 + self.n_sin * s) / d
    }

    #[inline(always)]
    fn w_scale(&self) -> f64 {
        1.0
    }

    fn discriminant(&self, c: f64, s: f64) -> f64 {
        let [a2, a1, a0] = self.quadratic(c, s);
        a1 * a1 - a2 * a0
    }

    fn rounding(&self, _: f64, _: f64, _: f64) -> f64 {
        // Both equations are squares of lengths: their sizes are alike.
        2.0 * RESIDUAL_TOLERANCE * self.l1_square
    }

    #[inline(always)]
    fn converged_step(&self, _: &Root) -> f64 {
        CONVERGED_STEP
    }
}
