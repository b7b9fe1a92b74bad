//! The working mode along the loci of many rows.

use super::leg_one_closure::LegOneClosureRows;
use super::platform_locus::PlatformLocus;
use super::solutions::posture_above;
use crate::loop_closure::RootRows;
use crate::mechanism::Mechanism;
use crate::posture_rows::PostureRows;
use crate::registers::ROWS;

/// Loci by coordinate, and the postures on them.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocusRows {
    x: [f64; ROWS],
    y: [[f64; ROWS]; 3],
    z: [[f64; ROWS]; 3],
    usual: [u64; ROWS],
    closures: LegOneClosureRows,
    roots: RootRows,
    pub(super) postures: PostureRows,
}

impl LocusRows {
    pub(super) fn new() -> Self {
        let zero = [0.0; ROWS];
        Self {
            x: zero,
            y: [zero; 3],
            z: [zero; 3],
            usual: [0; ROWS],
            closures: LegOneClosureRows::new(),
            roots: RootRows::new(),
            postures: PostureRows::new(),
        }
    }

    /// Sets a row's locus. `accepted` is whether its numbers are within the range of requests.
    #[inline(always)]
    pub(super) fn set(&mut self, i: usize, mechanism: &Mechanism, locus: &PlatformLocus, accepted: bool) {
        self.x[i] = locus.x;
        for k in 0..3 {
            self.y[k][i] = locus.y[k];
            self.z[k][i] = locus.z[k];
        }
        let not_level = self.closures.set(i, mechanism, locus);
        self.usual[i] = u64::from(accepted & locus.moves() & not_level);
    }

    /// Finds the postures, as [`working`](super::locus_solver::working) does.
    #[inline(always)]
    pub(super) fn solve(&mut self, mechanism: &Mechanism) {
        let Self { x, y, z, usual, closures, roots, postures } = self;
        roots.iterate_from_level_platform(|i| closures.closure(mechanism, i));
        for i in 0..ROWS {
            let locus = PlatformLocus {
                x: x[i],
                y: y.each_ref().map(|row| row[i]),
                z: z.each_ref().map(|row| row[i]),
            };
            let (posture, is_solution) = posture_above(mechanism, &locus.pose(mechanism, &roots.root(i)));
            postures.set(i, &posture, is_solution & roots.is_found(i) & (usual[i] == 1));
        }
    }
}
