//! The worst margins of a batch of postures, at a fraction of the cost of one after the other.

use arrayvec::ArrayVec;

use super::posture_margins::{Margins, det_margin, limited_crossing, range_margins};
use super::worst::WorstMargin;
use super::{cone, interference};
use crate::clearance::Clearance;
use crate::fast_math::{greater, lesser, sin_cos_of_turn};
use crate::limit::Margin;
use crate::machine::Machine;
use crate::pose::{PlatformPose, TableAngles};
use crate::posture::Posture;
use crate::registers::{Kernel, ROWS, Registers};
use crate::rods::Rods;

/// Upper bound of the rounding error of a fraction of a range.
const ROUNDING: f64 = 1e-12;

/// Poses and sliders by coordinate, so that the processor computes several postures at a time.
pub(crate) struct MarginBatch {
    /// The caller's indices of the postures.
    indices: ArrayVec<usize, ROWS>,
    x: [f64; ROWS],
    y: [f64; ROWS],
    z: [f64; ROWS],
    alpha: [f64; ROWS],
    rho: [[f64; ROWS]; 3],
}

impl MarginBatch {
    pub(crate) fn new() -> Self {
        let zero = [0.0; ROWS];
        Self { indices: ArrayVec::new(), x: zero, y: zero, z: zero, alpha: zero, rho: [zero; 3] }
    }

    pub(crate) fn clear(&mut self) {
        self.indices.clear();
    }

    /// Adds a posture. The caller adds at most [`ROWS`].
    #[inline]
    pub(crate) fn push(&mut self, index: usize, posture: &Posture) {
        let i = self.indices.len();
        if self.indices.try_push(index).is_ok() {
            let PlatformPose { x, y, z, alpha } = posture.pose;
            (self.x[i], self.y[i], self.z[i], self.alpha[i]) = (x, y, z, alpha);
            for (column, rho) in self.rho.iter_mut().zip(posture.rho) {
                column[i] = rho;
            }
        }
    }

    /// Computes [`Margins::worst`] of [`Margins::of`] for each posture, the same to the last bit. A stroke is usually
    /// the worst, and often that can be decided without the other margins. If the table takes part, its angles are
    /// those of alpha. The height over the table's plane is checked if there is a clearance.
    #[inline]
    pub(crate) fn worst(
        &self,
        machine: &Machine,
        table: impl Fn(f64) -> Option<TableAngles>,
        clearance: Option<&Clearance>,
        mut report: impl FnMut(usize, Margin),
    ) {
        let mut bounds = QuickBounds { batch: self, crossing: [0.0; ROWS], strokes_decide: [0.0; ROWS] };
        Registers::Widest.run(&mut bounds, machine);
        for (i, &index) in self.indices.iter().enumerate() {
            let (pose, rho) = self.posture(i);
            let table = table(pose.alpha);
            let worst = if bounds.strokes_decide[i] > 0.0 {
                WorstMargin::of_strokes(
                    machine,
                    limited_crossing(machine, pose.alpha, bounds.crossing[i]),
                    rho,
                    table,
                )
            } else {
                of_all_margins(machine, &pose, rho, table)
            };
            let above =
                table.zip(clearance).map(|(table, clearance)| clearance.margin(machine, &pose, table));
            report(index, worst.with_clearance(machine, above).margin);
        }
    }

    #[inline(always)]
    fn posture(&self, i: usize) -> (PlatformPose, [f64; 3]) {
        let pose = PlatformPose { x: self.x[i], y: self.y[i], z: self.z[i], alpha: self.alpha[i] };
        (pose, [self.rho[0][i], self.rho[1][i], self.rho[2][i]])
    }
}

/// The answers of [`quick_bound`] for a batch.
struct QuickBounds<'a> {
    batch: &'a MarginBatch,
    crossing: [f64; ROWS],
    strokes_decide: [f64; ROWS],
}

impl Kernel for QuickBounds<'_> {
    #[inline(always)]
    fn run(&mut self, machine: &Machine) {
        for i in 0..ROWS {
            let (pose, rho) = self.batch.posture(i);
            (self.crossing[i], self.strokes_decide[i]) = quick_bound(machine, &pose, rho);
        }
    }
}

#[cold]
fn of_all_margins(
    machine: &Machine,
    pose: &PlatformPose,
    rho: [f64; 3],
    table: Option<TableAngles>,
) -> WorstMargin {
    WorstMargin::of(machine, &Margins::of_solution(machine, pose, rho, table))
}

/// The margin of crossed rods, and a number that is positive only if that margin or a stroke's is certainly the worst
/// of the parallel module. The computation has no branch.
#[inline(always)]
fn quick_bound(machine: &Machine, pose: &PlatformPose, rho: [f64; 3]) -> (f64, f64) {
    let (g, limits, home) = (machine.geometry(), machine.limits(), &machine.home);
    let factors = &machine.normalization;
    let rods = Rods::with_angle(&machine.mechanism, pose, rho, sin_cos_of_turn(pose.alpha));
    let crossing = g.R1 * rods.c - g.r1 + machine.mechanism.crossing_reserve;
    let stroke = |i: usize| {
        let [low, high] = range_margins(limits.stroke[i], rho[i]);
        lesser(low, high) * factors.stroke[i]
    };
    let strokes = lesser(lesser(stroke(0), stroke(1)), stroke(2));
    let fraction = lesser(crossing * factors.rod_crossing, strokes);
    // A leg's height over its length is its rod's cosine, or the mean of those of its two rods. The cosine's own margin
    // is less.
    let [a, b, c, d] = rods.directions.map(|direction| direction[2]);
    let serial = lesser(lesser(a, b), lesser(c, d)) - limits.serial_margin - fraction - ROUNDING;
    let parallel = det_margin(machine, &rods) * factors.parallel_singularity - fraction - ROUNDING;
    let free = 1.0 - fraction;
    let slider = cone::bound(&home.slider_axes, |rod| rods.directions[rod], limits.slider_cone * free);
    let in_platform = |rod| cone::direction_in_platform(&rods, rod);
    let platform = cone::bound(&home.platform_axes, in_platform, limits.platform_cone * free);
    let distance = greater(fraction * home.rod_distance + 2.0 * g.rod_radius, 0.0);
    let apart = interference::separation_bound(&machine.mechanism, pose, &rods, distance);
    (crossing, lesser(lesser(lesser(serial, parallel), lesser(slider, platform)), apart))
}
