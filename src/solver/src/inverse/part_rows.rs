//! The working mode for many rows in the part frame.

use super::locus_rows::LocusRows;
use super::part::{part_working, table_locus};
use crate::error::KinematicsError;
use crate::fast_math::{MAX_ANGLE, sin_cos_of_turn};
use crate::machine::Machine;
use crate::pose::PartPose;
use crate::posture::Posture;
use crate::registers::{Kernel, ROWS, Registers, set_columns};
use crate::request_range::{are_accepted, is_in_proportion};

struct PartRows {
    tool_length: f64,
    /// x, y, z, phi1, phi2.
    targets: [[f64; ROWS]; 5],
    loci: LocusRows,
}

impl Kernel for PartRows {
    #[inline(always)]
    fn run(&mut self, machine: &Machine) {
        let Self { tool_length, targets, loci } = self;
        let mechanism = &machine.mechanism;
        for i in 0..ROWS {
            let [x, y, z, phi1, phi2] = targets.each_ref().map(|row| row[i]);
            let ((s1, c1), (s2, c2)) = (sin_cos_of_turn(phi1), sin_cos_of_turn(phi2));
            let target = PartPose { x, y, z, phi1, phi2 };
            let locus = table_locus(machine, &target, [[s1, c1], [s2, c2]], *tool_length);
            let accepted = are_accepted(mechanism, &[x, y, z, *tool_length], &[phi1, phi2])
                & is_in_proportion(mechanism, &locus.y[1..]);
            let few_turns = (phi1.abs() < MAX_ANGLE) & (phi2.abs() < MAX_ANGLE);
            loci.set(i, mechanism, &locus, accepted & few_turns);
        }
        loci.solve(mechanism);
    }
}

/// Calls `found` for each of the `targets` in turn with its index and the answer of [`part_working`], the same to the
/// last bit.
///
/// # Units
///
/// The targets' positions, `tool_length` and the sliders `rho` are millimetres; Z of the part frame points up from the
/// table. The targets' phi1 and phi2 and the postures' alpha are radians.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (9), (14), (26), with (15) as
/// an equation of degree three on the circle; section III.C.
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, PartPose, Registers, part_working, part_working_rows};
///
/// let machine = Machine::verne();
/// let targets = [0.0, 10.0, 20.0].map(|x| PartPose { x, y: 50.0, z: 300.0, phi1: 0.35, phi2: 0.5 });
/// let mut all = Vec::new();
/// part_working_rows(&machine, &targets, 150.0, Registers::Widest, |_, answer| all.push(answer));
/// assert_eq!(all[2], part_working(&machine, &targets[2], 150.0));
/// ```
pub fn part_working_rows(
    machine: &Machine,
    targets: &[PartPose],
    tool_length: f64,
    registers: Registers,
    mut found: impl FnMut(usize, Result<Posture, KinematicsError>),
) {
    let mut kernel = PartRows { tool_length, targets: [[0.0; ROWS]; 5], loci: LocusRows::new() };
    for (first, block) in (0..).step_by(ROWS).zip(targets.chunks(ROWS)) {
        let numbers = |&PartPose { x, y, z, phi1, phi2 }: &PartPose| [x, y, z, phi1, phi2];
        set_columns(&mut kernel.targets, block.iter().map(numbers));
        registers.run(&mut kernel, machine);
        for (i, target) in (0..ROWS).zip(block) {
            let posture = kernel.loci.postures.posture(i);
            found(first + i, posture.map_or_else(|| part_working(machine, target, tool_length), Ok));
        }
    }
}
