//! The nearest zeros of the cubics of many rows.

use super::cubic::{Cubic, STEPS};
use super::{LegOneAngle, LegOneCubic};
use crate::inverse::leg_one_height::is_nearly_level;
use crate::mechanism::Mechanism;
use crate::pose::Point;
use crate::registers::ROWS;

/// The cubics of many rows, by coefficient, and their nearest zeros.
#[derive(Clone, Copy, Debug)]
pub(in crate::inverse) struct CubicRows {
    a: [[f64; ROWS]; 3],
    t: [f64; ROWS],
    /// 1 for a row in which the iteration has not ended.
    open: [u64; ROWS],
    /// 1 for a row in which the iteration has converged.
    found: [u64; ROWS],
}

impl CubicRows {
    pub(in crate::inverse) fn new() -> Self {
        Self { a: [[0.0; ROWS]; 3], t: [0.0; ROWS], open: [0; ROWS], found: [0; ROWS] }
    }

    /// Does what [`LegOneCubic::nearest`] does where leg I is not nearly level.
    #[inline(always)]
    pub(in crate::inverse) fn find_nearest(
        &mut self,
        mechanism: &Mechanism,
        x: &[f64; ROWS],
        y: &[f64; ROWS],
    ) {
        for i in 0..ROWS {
            let leg = LegOneCubic::rounded(mechanism, x[i], y[i]);
            let cubic = leg.cubic(1.0);
            for (row, number) in self.a.iter_mut().zip(cubic.0) {
                row[i] = number;
            }
            self.t[i] = cubic.start();
            self.open[i] = u64::from(!is_nearly_level(mechanism, leg.at_zero));
            self.found[i] = 0;
        }
        for _ in 0..STEPS {
            let mut open = 0;
            for i in 0..ROWS {
                open |= self.step(mechanism, i);
            }
            if open == 0 {
                break;
            }
        }
    }

    /// One step of a row that is open. Returns 1 if it stays open.
    #[inline(always)]
    fn step(&mut self, mechanism: &Mechanism, i: usize) -> u64 {
        let [a0, a1, a2] = self.a.each_ref().map(|row| row[i]);
        let step = Cubic([a0, a1, a2, mechanism.k]).step(self.t[i]);
        let goes_on = (self.open[i] == 1) & step.is_before_maximum;
        self.t[i] = if goes_on { step.t } else { self.t[i] };
        let found = goes_on & step.has_converged;
        self.found[i] |= u64::from(found);
        self.open[i] = u64::from(goes_on & !found);
        self.open[i]
    }

    /// The angle of a row with P at `p`, and whether it is that of [`LegOneCubic::nearest`].
    #[inline(always)]
    pub(in crate::inverse) fn angle(
        &self,
        mechanism: &Mechanism,
        [x, y, _]: Point,
        i: usize,
    ) -> (LegOneAngle, bool) {
        let t = self.t[i];
        let angle = LegOneCubic::rounded(mechanism, x, y).angle(1.0, t, false);
        (angle, (self.found[i] == 1) & (0.0..=2.0).contains(&t))
    }
}
