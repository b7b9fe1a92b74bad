//! The worst margins of many postures, at a fraction of the cost of one after the other.

use arrayvec::ArrayVec;

use super::worst::Worst;
use super::{Margins, between, cone, det, interference};
use crate::angle::sin_cos_of_turn;
use crate::clearance::Clearance;
use crate::limit::Margin;
use crate::machine::Machine;
use crate::pose::{PlatformPose, TableAngles};
use crate::posture::Posture;
use crate::residual::{greater, lesser};
use crate::rods::Rods;

/// Number of postures that are examined together.
pub(crate) const TOGETHER: usize = 32;
/// Upper bound of the rounding error of a fraction of a range.
const ROUNDING: f64 = 1e-12;

/// Poses and sliders by coordinate. So the processor computes several postures at a time.
pub(crate) struct Together {
    /// The caller's numbers of the postures.
    places: ArrayVec<usize, TOGETHER>,
    x: [f64; TOGETHER],
    y: [f64; TOGETHER],
    z: [f64; TOGETHER],
    alpha: [f64; TOGETHER],
    rho: [[f64; TOGETHER]; 3],
}

impl Together {
    pub(crate) fn new() -> Self {
        let zero = [0.0; TOGETHER];
        Self { places: ArrayVec::new(), x: zero, y: zero, z: zero, alpha: zero, rho: [zero; 3] }
    }

    pub(crate) fn clear(&mut self) {
        self.places.clear();
    }

    /// Adds a posture. The caller adds at most [`TOGETHER`].
    #[inline]
    pub(crate) fn push(&mut self, place: usize, posture: &Posture) {
        let i = self.places.len();
        if self.places.try_push(place).is_ok() {
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
        mut found: impl FnMut(usize, Margin),
    ) {
        let (crossing, clear) = self.glances(machine);
        for (i, &place) in self.places.iter().enumerate() {
            let (pose, rho) = self.posture(i);
            let table = table(pose.alpha);
            let worst = if clear[i] > 0.0 {
                Worst::of_strokes(machine, crossing[i], rho, table)
            } else {
                of_all(machine, &pose, rho, table)
            };
            let above =
                table.zip(clearance).map(|(table, clearance)| clearance.margin(machine, &pose, table));
            found(place, worst.with_clearance(machine, above).margin);
        }
    }

    #[inline]
    fn posture(&self, i: usize) -> (PlatformPose, [f64; 3]) {
        let pose = PlatformPose { x: self.x[i], y: self.y[i], z: self.z[i], alpha: self.alpha[i] };
        (pose, [self.rho[0][i], self.rho[1][i], self.rho[2][i]])
    }

    /// Applies [`glance`] to each posture.
    fn glances(&self, machine: &Machine) -> ([f64; TOGETHER], [f64; TOGETHER]) {
        let (mut crossing, mut clear) = ([0.0; TOGETHER], [0.0; TOGETHER]);
        for i in 0..TOGETHER {
            let (pose, rho) = self.posture(i);
            (crossing[i], clear[i]) = glance(machine, &pose, rho);
        }
        (crossing, clear)
    }
}

#[cold]
fn of_all(machine: &Machine, pose: &PlatformPose, rho: [f64; 3], table: Option<TableAngles>) -> Worst {
    Worst::of(machine, &Margins::of_solution(machine, pose, rho, table))
}

/// The margin of crossed rods, and a number that is positive only if that margin or a stroke's is certainly the worst
/// of the parallel module. The computation has no branch.
#[inline]
fn glance(machine: &Machine, pose: &PlatformPose, rho: [f64; 3]) -> (f64, f64) {
    let (g, limits, derived) = (machine.geometry(), machine.limits(), &machine.derived);
    let weights = &derived.weights;
    let rods = Rods::towards(machine, pose, rho, sin_cos_of_turn(pose.alpha));
    let crossing = g.R1 * rods.c - g.r1;
    let stroke = |i: usize| {
        let [low, high] = between(limits.stroke[i], rho[i]);
        lesser(low, high) * weights.stroke[i]
    };
    let strokes = lesser(lesser(stroke(0), stroke(1)), stroke(2));
    let part = lesser(crossing * weights.rod_crossing, strokes);
    // A leg's drop over its length is its rod's cosine, or the mean of those of its two rods. The cosine's own margin
    // is less.
    let [a, b, c, d] = rods.directions.map(|direction| direction[2]);
    let serial = lesser(lesser(a, b), lesser(c, d)) - limits.serial_margin - part - ROUNDING;
    let parallel = det(machine, &rods) * weights.parallel_singularity - part - ROUNDING;
    let free = 1.0 - part;
    let slider = cone::room(&derived.slider_axes, &rods, limits.slider_cone * free);
    let platform = cone::room_on_platform(&derived.platform_axes, &rods, limits.platform_cone * free);
    let distance = greater(part * derived.home_distance + 2.0 * g.rod_radius, 0.0);
    let apart = interference::room(g, pose, &rods, distance);
    (crossing, lesser(lesser(lesser(serial, parallel), lesser(slider, platform)), apart))
}
