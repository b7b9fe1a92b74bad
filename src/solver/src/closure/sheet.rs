//! Newton's method on the loop closure, and one sheet of it as a function of the angle.

use super::{Closure, Root, rotated};

/// Newton steps until the last digit; convergence is quadratic, so few are ever used.
const STEPS: usize = 12;
/// A step below this leaves an error of its square: nothing in double precision.
const SMALL: f64 = 1e-8;

/// Newton's method in (a, w); `None` if it does not converge.
#[inline]
pub(super) fn polish<const M: usize, C: Closure<M>>(closure: &C, start: Root) -> Option<Root> {
    let mut root = start;
    for _ in 0..STEPS {
        let e = closure.equations(root.c, root.s, root.w);
        let det = e.da[0] * e.dw[1] - e.da[1] * e.dw[0];
        let scale = 1.0 / det;
        let step_a = (e.f[1] * e.dw[0] - e.f[0] * e.dw[1]) * scale;
        let step_w = (e.f[0] * e.da[1] - e.f[1] * e.da[0]) * scale;
        if !(step_a.abs() < 1.0) {
            return None;
        }
        (root.c, root.s) = rotated(root.c, root.s, step_a);
        root.w += step_w;
        if step_a.abs() < SMALL && step_w.abs() <= SMALL * (root.w.abs() + closure.unit()) {
            return renormalised(root);
        }
    }
    None
}

#[inline]
fn renormalised(root: Root) -> Option<Root> {
    let norm = root.c * root.c + root.s * root.s;
    // One Newton step for 1/sqrt: the norm is one up to a few roundings.
    let scale = 1.5 - 0.5 * norm;
    Some(Root { c: root.c * scale, s: root.s * scale, ..root })
}

/// The linear equation on one sheet: its value and its slope along the sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnSheet {
    pub(super) value: f64,
    pub(super) slope: f64,
}

/// Sheet 0 (w₊) or 1 (w₋) at an angle; `None` where it does not exist.
pub(super) fn on_sheet<const M: usize, C: Closure<M>>(closure: &C, sheet: usize, a: f64) -> Option<OnSheet> {
    let (s, c) = a.sin_cos();
    let w = closure.sheets(c, s)?[sheet];
    let e = closure.equations(c, s, w);
    let slope = e.da[0] - e.dw[0] * e.da[1] / e.dw[1];
    slope.is_finite().then_some(OnSheet { value: e.f[0], slope })
}
