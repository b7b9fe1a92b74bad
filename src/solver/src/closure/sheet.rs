//! Newton's method on the loop closure, and one sheet of it as a function of the angle.

use super::{Closure, Root};
use crate::angle::{angle_of, sin_cos};

/// Greatest number of Newton steps. Convergence is quadratic, so few are used.
const STEPS: usize = 12;
/// Step, rad, above which the iteration diverges.
const ASTRAY: f64 = 1.0;

/// Newton's method in (a, w); `None` if it does not converge.
#[inline]
pub(crate) fn polish<const M: usize, C: Closure<M>>(closure: &C, start: Root) -> Option<Root> {
    let mut root = start;
    for _ in 0..STEPS {
        let step = step(closure, &root);
        root = stepped(&root, step)?;
        if settled(closure, &root, step) {
            return Some(arrived(&start, root));
        }
    }
    None
}

/// Applies [`polish`] to two roots in step. A processor works on both at once; two calls would wait for each division
/// in turn.
#[inline]
fn polish_both<const M: usize, C: Closure<M>>(closure: &C, starts: [Root; 2]) -> Option<[Root; 2]> {
    let [mut first, mut second] = starts;
    for _ in 0..STEPS {
        let steps = [step(closure, &first), step(closure, &second)];
        first = stepped(&first, steps[0])?;
        second = stepped(&second, steps[1])?;
        if settled(closure, &first, steps[0]) & settled(closure, &second, steps[1]) {
            return Some([arrived(&starts[0], first), arrived(&starts[1], second)]);
        }
    }
    None
}

#[inline]
fn settled<const M: usize, C: Closure<M>>(closure: &C, root: &Root, step: [f64; 2]) -> bool {
    let last = closure.last_step(root);
    (step[0].abs() < last) & (step[1].abs() <= last * (root.w.abs() + closure.unit()))
}

/// The root in a bracket that holds one, from either sheet.
pub(super) fn root_between<const M: usize, C: Closure<M>>(
    closure: &C,
    [low, high]: [f64; 2],
    a: f64,
) -> Option<Root> {
    let (s, c) = sin_cos(a);
    let inside = |root: &Root| root.a >= low && root.a <= high;
    let w = closure.w_at_root(c, s);
    let sheets = closure.sheets(c, s).unwrap_or([w, w]);
    // The nearer sheet first: a root close to another in the angle may be on either.
    let nearer = usize::from((sheets[1] - w).abs() < (sheets[0] - w).abs());
    [nearer, 1 - nearer]
        .into_iter()
        .find_map(|sheet| polish(closure, Root::at(a, [c, s], sheets[sheet])).filter(inside))
}

/// The two roots of a bracket, one at either side of `at` and one on each sheet: each is alone on
/// its sheet, and Newton's method goes straight to it however near they are. `None` if they are
/// not so placed.
#[inline]
pub(super) fn either_side<const M: usize, C: Closure<M>>(
    closure: &C,
    [low, high]: [f64; 2],
    at: f64,
) -> Option<[Root; 2]> {
    let (s, c) = sin_cos(at);
    let [above, below] = closure.sheets(c, s)?;
    let [first, second] = polish_both(closure, [above, below].map(|w| Root::at(at, [c, s], w)))?;
    let pair = if first.a < second.a { [first, second] } else { [second, first] };
    let placed = low <= pair[0].a && pair[0].a <= at && at <= pair[1].a && pair[1].a <= high;
    placed.then_some(pair)
}

/// The root of a pair beside the one that is known, on the other side of `at` and on the other
/// sheet. `None` if the known one is not of the pair, or if the two are not so placed.
#[inline]
pub(super) fn beside<const M: usize, C: Closure<M>>(
    closure: &C,
    [low, high]: [f64; 2],
    at: f64,
    known: &Root,
) -> Option<Root> {
    let a = known.turned_into(low, high)?;
    let (s, c) = sin_cos(at);
    let [above, below] = closure.sheets(c, s)?;
    let w = if (known.w - above).abs() < (known.w - below).abs() { below } else { above };
    let [from, to] = if a < at { [at, high] } else { [low, at] };
    polish(closure, Root::at(at, [c, s], w)).filter(|other| (from..=to).contains(&other.a))
}

/// The determinant of the closure's derivatives: zero at a parallel singularity, and a multiple of
/// `det_P` whose factor has one sign for a machine.
#[inline]
pub(crate) fn determinant<const M: usize, C: Closure<M>>(closure: &C, root: &Root) -> f64 {
    let e = closure.equations(root.c, root.s, root.w);
    e.da[0] * e.dw[1] - e.da[1] * e.dw[0]
}

/// The Newton step in (a, w).
#[inline]
fn step<const M: usize, C: Closure<M>>(closure: &C, root: &Root) -> [f64; 2] {
    let e = closure.equations(root.c, root.s, root.w);
    let scale = 1.0 / (e.da[0] * e.dw[1] - e.da[1] * e.dw[0]);
    [(e.f[1] * e.dw[0] - e.f[0] * e.dw[1]) * scale, (e.f[0] * e.da[1] - e.f[1] * e.da[0]) * scale]
}

/// The root moved by a step, except for its angle; `None` for a step that leads astray.
///
/// The direction (c, s) is turned by the rational rotation with half the step for the tangent of
/// the half angle: it keeps a unit vector as exactly as cos and sin do and differs from the step
/// by its cube only, which Newton's method does not notice.
#[inline]
fn stepped(root: &Root, [step_a, step_w]: [f64; 2]) -> Option<Root> {
    let square = 0.25 * step_a * step_a;
    let scale = 1.0 / (1.0 + square);
    let (cd, sd) = ((1.0 - square) * scale, step_a * scale);
    let (c, s) = (root.c * cd - root.s * sd, root.s * cd + root.c * sd);
    (step_a.abs() < ASTRAY).then_some(Root { c, s, w: root.w + step_w, ..*root })
}

/// The root with the angle of its direction. The angle continues that of the start.
#[inline]
fn arrived(start: &Root, root: Root) -> Root {
    let turned = angle_of(root.c * start.c + root.s * start.s, root.s * start.c - root.c * start.s);
    Root { a: start.a + turned, ..root }
}

/// The linear equation on one sheet: its value and its slope along the sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct OnSheet {
    pub(super) value: f64,
    pub(super) slope: f64,
    /// Value below which the angle is a solution within rounding errors.
    pub(super) noise: f64,
}

/// Sheet 0 (w₊) or 1 (w₋) in a direction; `None` where it does not exist.
pub(super) fn on_sheet<const M: usize, C: Closure<M>>(
    closure: &C,
    sheet: usize,
    [c, s]: [f64; 2],
) -> Option<OnSheet> {
    let w = closure.sheets(c, s)?[sheet];
    let e = closure.equations(c, s, w);
    let slope = e.da[0] - e.dw[0] * e.da[1] / e.dw[1];
    slope.is_finite().then_some(OnSheet { value: e.f[0], slope, noise: closure.noise(c, s, w) })
}
