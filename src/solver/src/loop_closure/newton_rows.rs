//! Newton's method on the loop closures of many rows.

use super::equations::{LoopClosure, Root};
use super::newton::{LEVEL, STEPS, converged, moved, step, with_angle};
use crate::registers::ROWS;

/// A solution for each row, by coordinate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RootRows {
    a: [f64; ROWS],
    c: [f64; ROWS],
    s: [f64; ROWS],
    w: [f64; ROWS],
    /// 1 for a row in which the iteration has not ended.
    open: [u64; ROWS],
    /// 1 for a row in which the iteration has converged.
    found: [u64; ROWS],
}

impl RootRows {
    pub(crate) fn new() -> Self {
        let zero = [0.0; ROWS];
        Self { a: zero, c: zero, s: zero, w: zero, open: [0; ROWS], found: [0; ROWS] }
    }

    /// The row's solution; anything if none is found.
    #[inline(always)]
    pub(crate) fn root(&self, i: usize) -> Root {
        Root::at(self.a[i], [self.c[i], self.s[i]], self.w[i])
    }

    /// Whether the iteration has converged.
    #[inline(always)]
    pub(crate) fn is_found(&self, i: usize) -> bool {
        self.found[i] == 1
    }

    /// Does what [`from_level_platform`](super::from_level_platform) does, with the closure of each row.
    #[inline(always)]
    pub(crate) fn iterate_from_level_platform<const M: usize, C: LoopClosure<M>>(
        &mut self,
        closure: impl Fn(usize) -> C,
    ) {
        for i in 0..ROWS {
            let branches = closure(i).branches(LEVEL.c, LEVEL.s);
            (self.a[i], self.c[i], self.s[i]) = (LEVEL.a, LEVEL.c, LEVEL.s);
            self.w[i] = branches.map_or(0.0, |[above, _]| above);
            self.open[i] = u64::from(branches.is_some());
            self.found[i] = 0;
        }
        for _ in 0..STEPS {
            let mut open = 0;
            for i in 0..ROWS {
                open |= self.step(i, &closure(i));
            }
            if open == 0 {
                break;
            }
        }
        for i in 0..ROWS {
            self.a[i] = with_angle(&LEVEL, self.root(i)).a;
        }
    }

    /// One step of a row that is open. Returns 1 if it stays open.
    #[inline(always)]
    fn step<const M: usize, C: LoopClosure<M>>(&mut self, i: usize, closure: &C) -> u64 {
        let before = self.root(i);
        let step = step(closure, &before);
        let moved = moved(&before, step);
        let is_open = self.open[i] == 1;
        let inside = is_open & moved.is_some();
        let after = moved.unwrap_or(before);
        let found = inside & converged(closure, &after, step);
        self.c[i] = if is_open { after.c } else { before.c };
        self.s[i] = if is_open { after.s } else { before.s };
        self.w[i] = if is_open { after.w } else { before.w };
        self.found[i] |= u64::from(found);
        self.open[i] = u64::from(inside & !found);
        self.open[i]
    }
}
