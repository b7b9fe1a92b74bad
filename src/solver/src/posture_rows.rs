//! Postures in the working mode of many rows.

use crate::pose::PlatformPose;
use crate::posture::{Mode, Posture, Side};
use crate::registers::ROWS;

/// The answers of a kernel, by coordinate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PostureRows {
    /// x, y, z, alpha, rho1, rho2, rho3, residual.
    numbers: [[f64; ROWS]; 8],
    /// 1 for a row that has a posture here, 0 for one that is left to the code for a single row.
    usual: [u64; ROWS],
}

impl PostureRows {
    pub(crate) fn new() -> Self {
        Self { numbers: [[0.0; ROWS]; 8], usual: [0; ROWS] }
    }

    /// Writes a row. A usual row's posture is in the working mode, and its solutions have not merged.
    #[inline(always)]
    pub(crate) fn set(&mut self, i: usize, posture: &Posture, usual: bool) {
        let PlatformPose { x, y, z, alpha } = posture.pose;
        let [rho1, rho2, rho3] = posture.rho;
        let numbers = [x, y, z, alpha, rho1, rho2, rho3, posture.residual];
        for (row, number) in self.numbers.iter_mut().zip(numbers) {
            row[i] = number;
        }
        self.usual[i] = u64::from(usual);
    }

    /// The posture of a usual row.
    #[inline]
    pub(crate) fn posture(&self, i: usize) -> Option<Posture> {
        let [x, y, z, alpha, rho1, rho2, rho3, residual] = self.numbers.each_ref().map(|row| row[i]);
        (self.usual[i] == 1).then_some(Posture {
            pose: PlatformPose { x, y, z, alpha },
            rho: [rho1, rho2, rho3],
            mode: Mode { legs: [Side::Above; 3], crossed: false },
            working: true,
            merged: false,
            residual,
        })
    }
}
