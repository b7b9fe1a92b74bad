//! One branch of the loop closure as a function of the angle, and the roots of an arc on both.

use super::equations::{LoopClosure, Root};
use super::newton::{polish, polish_both};
use crate::fast_math::sin_cos;

/// The root in a bracket that holds one, from either branch.
pub(super) fn root_between<const M: usize, C: LoopClosure<M>>(
    closure: &C,
    [low, high]: [f64; 2],
    a: f64,
) -> Option<Root> {
    let (s, c) = sin_cos(a);
    let inside = |root: &Root| root.a >= low && root.a <= high;
    let w = closure.w_at_root(c, s);
    let branches = closure.branches(c, s).unwrap_or([w, w]);
    // The nearer branch first: a root close to another in the angle may be on either.
    let nearer = usize::from((branches[1] - w).abs() < (branches[0] - w).abs());
    [nearer, 1 - nearer]
        .into_iter()
        .find_map(|branch| polish(closure, Root::at(a, [c, s], branches[branch])).filter(inside))
}

/// The two roots of a bracket, one at either side of `at` and one on each branch: each is alone on
/// its branch, and Newton's method goes straight to it however near they are. `None` if they
/// lie elsewhere.
#[inline]
pub(super) fn both_of_pair<const M: usize, C: LoopClosure<M>>(
    closure: &C,
    [low, high]: [f64; 2],
    at: f64,
) -> Option<[Root; 2]> {
    let (s, c) = sin_cos(at);
    let [above, below] = closure.branches(c, s)?;
    let [first, second] = polish_both(closure, [above, below].map(|w| Root::at(at, [c, s], w)))?;
    let pair = if first.a < second.a { [first, second] } else { [second, first] };
    let at_either_side = low <= pair[0].a && pair[0].a <= at && at <= pair[1].a && pair[1].a <= high;
    at_either_side.then_some(pair)
}

/// The root of a pair beside the one that is known, on the other side of `at` and on the other
/// branch. `None` if the known one is not of the pair, or if the other lies elsewhere.
#[inline]
pub(super) fn other_of_pair<const M: usize, C: LoopClosure<M>>(
    closure: &C,
    [low, high]: [f64; 2],
    at: f64,
    known: &Root,
) -> Option<Root> {
    let a = known.angle_within(low, high)?;
    let (s, c) = sin_cos(at);
    let [above, below] = closure.branches(c, s)?;
    let w = if (known.w - above).abs() < (known.w - below).abs() { below } else { above };
    let [from, to] = if a < at { [at, high] } else { [low, at] };
    polish(closure, Root::at(at, [c, s], w)).filter(|other| (from..=to).contains(&other.a))
}

/// The linear equation on one branch: its value and its slope along the branch.
#[derive(Clone, Copy, Debug)]
pub(super) struct BranchPoint {
    pub(super) value: f64,
    pub(super) slope: f64,
    /// Value below which the angle is a solution within rounding errors.
    pub(super) rounding: f64,
}

/// Branch 0 (w₊) or 1 (w₋) in a direction; `None` where it does not exist.
pub(super) fn branch_point<const M: usize, C: LoopClosure<M>>(
    closure: &C,
    branch: usize,
    [c, s]: [f64; 2],
) -> Option<BranchPoint> {
    let w = closure.branches(c, s)?[branch];
    let e = closure.equations(c, s, w);
    let slope = e.da[0] - e.dw[0] * e.da[1] / e.dw[1];
    slope.is_finite().then_some(BranchPoint { value: e.f[0], slope, rounding: closure.rounding(c, s, w) })
}
