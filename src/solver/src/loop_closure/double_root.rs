//! Roots where the polynomial is too close to zero to be trusted: its branches decide.

use arrayvec::ArrayVec;

use super::branch::{BranchPoint, branch_point};
use super::branch_intervals::{BranchInterval, OffsetArc};
use super::equations::{LoopClosure, Root, Roots, add};
use super::newton::polish;

/// Bisections of an interval: as many as a double has bits.
const BISECTIONS: u8 = 60;

/// Adds the roots near a double root of the polynomial: one on each of two branches, or two, one merged or none on one
/// of them. The branches are smooth where the polynomial is only rounding error. A few dozen steps, shorter near the
/// double root and where the branches meet, show every root that double precision can resolve.
#[cold]
pub(super) fn add_roots<const M: usize, C: LoopClosure<M>>(
    closure: &C,
    ends: [f64; 2],
    at: f64,
    found: &mut Roots,
) {
    let arc = OffsetArc::new(ends, at);
    let branches = [0, 1].map(|number| Branch { closure, arc, number });
    for interval in &arc.branch_intervals(closure) {
        for branch in &branches {
            branch.add_roots(interval, found);
        }
        for end in 0..2 {
            if interval.meets[end] {
                let offset = interval.offsets[end * (interval.offsets.len() - 1)];
                add_root_where_branches_meet(&branches, offset, found);
            }
        }
    }
}

/// Adds the root where the branches meet: rounding leaves a gap between them, across which the
/// linear equation may change its sign.
fn add_root_where_branches_meet<const M: usize, C: LoopClosure<M>>(
    branches: &[Branch<'_, M, C>; 2],
    offset: f64,
    found: &mut Roots,
) {
    let [Some(above), Some(below)] = branches.each_ref().map(|branch| branch.value(offset)) else { return };
    if (above < 0.0) != (below < 0.0)
        && let [Some(high), Some(low)] = branches.each_ref().map(|branch| branch.root(offset, false))
    {
        let middle = Root { w: 0.5 * (high.w + low.w), ..high };
        let gap = (high.w - low.w).abs();
        let near = |root: &Root| (root.w - middle.w).abs() <= gap;
        add(found, polish(branches[0].closure, middle).filter(near).unwrap_or(middle));
    }
}

/// One branch of a closure on an arc.
struct Branch<'a, const M: usize, C> {
    closure: &'a C,
    arc: OffsetArc,
    number: usize,
}

impl<const M: usize, C: LoopClosure<M>> Branch<'_, M, C> {
    /// Adds the roots on one interval.
    fn add_roots(&self, interval: &BranchInterval, found: &mut Roots) {
        let last = interval.offsets.len() - 1;
        let mut keep = |root| add(found, root);
        for (i, pair) in interval.offsets.windows(2).enumerate() {
            let ends = [pair[0], pair[1]];
            let [Some(low), Some(high)] = ends.map(|offset| self.value(offset)) else { continue };
            if (low < 0.0) != (high < 0.0) {
                self.bracketed(ends).into_iter().for_each(&mut keep);
            } else if !(i == 0 && interval.meets[0] || i + 1 == last && interval.meets[1]) {
                self.tangent(ends).into_iter().for_each(&mut keep);
            }
        }
    }

    fn at(&self, offset: f64) -> Option<BranchPoint> {
        branch_point(self.closure, self.number, self.arc.direction(offset))
    }

    /// The linear equation's value.
    fn value(&self, offset: f64) -> Option<f64> {
        let [c, s] = self.arc.direction(offset);
        let w = self.closure.branches(c, s)?[self.number];
        Some(self.closure.equations(c, s, w).f[0])
    }

    fn root(&self, offset: f64, merged: bool) -> Option<Root> {
        let [c, s] = self.arc.direction(offset);
        let w = self.closure.branches(c, s)?[self.number];
        Some(self.arc.root(offset, w, merged))
    }

    /// The root of a branch that changes sign over an interval.
    fn bracketed(&self, [mut low, mut high]: [f64; 2]) -> Option<Root> {
        let reach = high - low;
        let rising = self.value(low)? < 0.0;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if (self.value(middle)? < 0.0) == rising { low = middle } else { high = middle }
        }
        let root = self.root(0.5 * (low + high), false)?;
        let inside = |polished: &Root| (polished.a - root.a).abs() <= reach;
        Some(polish(self.closure, root).filter(inside).unwrap_or(root))
    }

    /// A branch of one sign at both ends that bends towards zero in between: it crosses twice,
    /// touches zero, or turns back.
    fn tangent(&self, [from, to]: [f64; 2]) -> ArrayVec<Root, 2> {
        let mut roots = ArrayVec::new();
        let (Some(low), Some(high)) = (self.at(from), self.at(to)) else { return roots };
        // A branch that bends towards zero: only then can it reach it in between.
        if low.value * low.slope >= 0.0 || high.value * high.slope <= 0.0 {
            return roots;
        }
        let Some((extremum, at)) = self.extremum([from, to], low.slope) else { return roots };
        if at.value.abs() <= at.rounding {
            roots.extend(self.root(extremum, true));
        } else if low.value * at.value < 0.0 {
            roots.extend(self.bracketed([from, extremum]));
            roots.extend(self.bracketed([extremum, to]));
        }
        roots
    }

    /// The extremum on an interval over which the slope changes sign.
    fn extremum(&self, [mut low, mut high]: [f64; 2], first: f64) -> Option<(f64, BranchPoint)> {
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if (self.at(middle)?.slope < 0.0) == (first < 0.0) { low = middle } else { high = middle }
        }
        let extremum = 0.5 * (low + high);
        Some((extremum, self.at(extremum)?))
    }
}
