//! Newton's method on the loop closure in (a, w).

use super::equations::{LoopClosure, Root};
use crate::fast_math::angle_of;

/// Greatest number of Newton steps. Convergence is quadratic, so few are used.
pub(super) const STEPS: usize = 12;
/// Step, rad, above which the iteration diverges.
const DIVERGED: f64 = 1.0;
/// The level platform.
pub(super) const LEVEL: Root = Root { a: 0.0, c: 1.0, s: 0.0, w: 0.0, merged: false };

/// Newton's method in (a, w); `None` if it does not converge.
#[inline]
pub(crate) fn polish<const M: usize, C: LoopClosure<M>>(closure: &C, start: Root) -> Option<Root> {
    let mut root = start;
    for _ in 0..STEPS {
        let step = step(closure, &root);
        root = moved(&root, step)?;
        if converged(closure, &root, step) {
            return Some(with_angle(&start, root));
        }
    }
    None
}

/// Applies [`polish`] to two roots in step. A processor works on both at once; two calls would wait for each division
/// in turn.
#[inline]
pub(super) fn polish_both<const M: usize, C: LoopClosure<M>>(
    closure: &C,
    starts: [Root; 2],
) -> Option<[Root; 2]> {
    let [mut first, mut second] = starts;
    for _ in 0..STEPS {
        let steps = [step(closure, &first), step(closure, &second)];
        first = moved(&first, steps[0])?;
        second = moved(&second, steps[1])?;
        if converged(closure, &first, steps[0]) & converged(closure, &second, steps[1]) {
            return Some([with_angle(&starts[0], first), with_angle(&starts[1], second)]);
        }
    }
    None
}

#[inline(always)]
pub(super) fn converged<const M: usize, C: LoopClosure<M>>(closure: &C, root: &Root, step: [f64; 2]) -> bool {
    let last = closure.converged_step(root);
    (step[0].abs() < last) & (step[1].abs() <= last * (root.w.abs() + closure.w_scale()))
}

/// The solution that Newton's method finds from the level platform on the branch w₊. In practice only the working
/// mode lies in this basin of attraction.
#[inline]
pub(crate) fn from_level_platform<const M: usize, C: LoopClosure<M>>(closure: &C) -> Option<Root> {
    let [w, _] = closure.branches(LEVEL.c, LEVEL.s)?;
    polish(closure, Root { w, ..LEVEL })
}

/// The determinant of the closure's derivatives: zero at a parallel singularity, and a multiple of
/// `det_P` whose factor has one sign for a machine.
#[inline(always)]
pub(crate) fn determinant<const M: usize, C: LoopClosure<M>>(closure: &C, root: &Root) -> f64 {
    closure.equations(root.c, root.s, root.w).determinant()
}

/// The Newton step in (a, w).
#[inline(always)]
pub(super) fn step<const M: usize, C: LoopClosure<M>>(closure: &C, root: &Root) -> [f64; 2] {
    let e = closure.equations(root.c, root.s, root.w);
    let scale = 1.0 / e.determinant();
    [(e.f[1] * e.dw[0] - e.f[0] * e.dw[1]) * scale, (e.f[0] * e.da[1] - e.f[1] * e.da[0]) * scale]
}

/// The root moved by a step, except for its angle; `None` for a step so long that the method diverges.
///
/// The direction (c, s) is turned by the rational rotation with half the step for the tangent of
/// the half angle: it keeps a unit vector as exactly as cos and sin do and differs from the step
/// by its cube only, which does not slow Newton's method down.
#[inline(always)]
pub(super) fn moved(root: &Root, [step_a, step_w]: [f64; 2]) -> Option<Root> {
    let square = 0.25 * step_a * step_a;
    let scale = 1.0 / (1.0 + square);
    let (cd, sd) = ((1.0 - square) * scale, step_a * scale);
    let (c, s) = (root.c * cd - root.s * sd, root.s * cd + root.c * sd);
    (step_a.abs() < DIVERGED).then_some(Root { c, s, w: root.w + step_w, ..*root })
}

/// The root with the angle of its direction. The angle continues that of the start.
#[inline(always)]
pub(super) fn with_angle(start: &Root, root: Root) -> Root {
    let turned = angle_of(root.c * start.c + root.s * start.s, root.s * start.c - root.c * start.s);
    Root { a: start.a + turned, ..root }
}
