//! All margins of many postures.

use super::interference::{least_distance, nearest_within_legs, rods_of_leg};
use super::margin_block::MarginBlock;
use super::posture_columns::{PostureBlock, PostureColumns};
use super::posture_margins::Margins;
use super::worst_rows::WorstBlock;
use crate::clearance::Clearance;
use crate::fast_math::{MAX_ANGLE, sin_cos_of_turn};
use crate::limit::Margin;
use crate::machine::Machine;
use crate::registers::{Kernel, ROWS, Registers};
use crate::rods::Rods;

/// Postures and their margins.
struct MarginRows {
    postures: PostureBlock,
    margins: MarginBlock,
    /// 1 for a row whose margins the kernel computes completely.
    usual: [u64; ROWS],
}

/// The same, and the worst margins.
struct WorstRows {
    all: MarginRows,
    worst: WorstBlock,
}

/// Computes the margins, except that of the height over the table's plane.
impl Kernel for MarginRows {
    #[inline(always)]
    fn run(&mut self, machine: &Machine) {
        // Without a range the margin means nothing. A branch in the loop would end its vectorisation.
        let ranges = [machine.limits().tilt, machine.limits().rotary.unwrap_or([0.0; 2])];
        let is_delta = machine.mechanism.is_delta();
        for i in 0..ROWS {
            let (pose, rho) = (self.postures.pose(i), self.postures.rho(i));
            let rods = Rods::with_angle(&machine.mechanism, &pose, rho, sin_cos_of_turn(pose.alpha));
            let nearest = nearest_within_legs(&machine.mechanism, &rods);
            let of_module =
                Margins::of_parallel_module(machine, &pose, rho, &rods, (nearest.distance, rods_of_leg(0)));
            self.margins.set_parallel_module(i, &of_module, nearest.leg);
            self.margins.set_crossing_limit(i, !is_delta | (pose.alpha != 0.0));
            self.margins.set_table(i, &ranges, self.postures.angles(i));
            self.usual[i] = u64::from(nearest.others_are_farther & (pose.alpha.abs() < MAX_ANGLE));
        }
    }
}

/// Finds the worst of all margins.
impl Kernel for WorstRows {
    #[inline(always)]
    fn run(&mut self, machine: &Machine) {
        let Self { all, worst } = self;
        for i in 0..ROWS {
            worst.set(i, machine, &all.margins);
        }
    }
}

impl MarginRows {
    fn new() -> Self {
        Self { postures: PostureBlock::new(), margins: MarginBlock::new(), usual: [0; ROWS] }
    }

    /// Computes the margins of a block.
    fn solve(
        &mut self,
        machine: &Machine,
        (rows, postures): (usize, &PostureBlock),
        clearance: Option<&Clearance>,
        registers: Registers,
    ) {
        self.postures.clone_from(postures);
        registers.run(self, machine);
        self.margins.begin(rows, machine, &postures.has_table);
        for i in 0..rows {
            if self.usual[i] == 0 {
                self.complete(i, machine);
            }
        }
        let Some(clearance) = clearance else { return };
        for i in 0..rows {
            if let Some(table) = postures.table(i) {
                self.margins.set_clearance(i, clearance.margin(machine, &postures.pose(i), table));
            }
        }
    }

    /// Computes the margins of an unusual row: its angle has many turns, or rods of different legs may be the nearest.
    #[cold]
    fn complete(&mut self, i: usize, machine: &Machine) {
        let (pose, rho) = (self.postures.pose(i), self.postures.rho(i));
        let g = machine.geometry();
        let rods = Rods::of(&machine.mechanism, &pose, rho);
        let nearest = least_distance(&machine.mechanism, &rods);
        if pose.alpha.abs() >= MAX_ANGLE {
            let of_module = Margins::of_parallel_module(machine, &pose, rho, &rods, nearest);
            self.margins.set_parallel_module(i, &of_module, 0);
        }
        self.margins.set_interference(i, nearest.0 - 2.0 * g.rod_radius, nearest.1);
    }
}

/// Calls `found` for each block of the postures in turn with the index of its first posture and its margins. Those of
/// each posture are the answer of [`Margins::above_table`], the same to the last bit.
///
/// # Units
///
/// Each field of [`Margins`] states its unit: mm, rad, or none.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): section IV.A.
///
/// # Examples
///
/// ```
/// use verne_solver::{KinematicsError, Machine, Margins, PostureColumns, Registers, margin_rows, platform_working};
///
/// let machine = Machine::verne();
/// let posture = platform_working(&machine, [0.0, 0.0, 1200.0])?;
/// let mut postures = PostureColumns::new();
/// postures.push(&posture, None);
/// margin_rows(&machine, &postures, None, Registers::Widest, |first, margins| {
///     assert_eq!((first, margins.len()), (0, 1));
///     assert_eq!(margins.row(0), Margins::of(&machine, &posture, None));
/// });
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn margin_rows(
    machine: &Machine,
    postures: &PostureColumns,
    clearance: Option<&Clearance>,
    registers: Registers,
    mut found: impl FnMut(usize, &MarginBlock),
) {
    let mut kernel = MarginRows::new();
    for (first, rows, block) in postures.blocks() {
        kernel.solve(machine, (rows, block), clearance, registers);
        found(first, &kernel.margins);
    }
}

/// Calls `found` for each posture in turn with its index, the answer of [`Margins::worst`], and that of
/// [`Margins::feasible`].
///
/// # Units
///
/// The margin has the unit of its constraint: mm, rad, or none.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): section IV.A; the comparison is
/// ours.
///
/// # Examples
///
/// ```
/// use verne_solver::{Constraint, KinematicsError, Machine, PostureColumns, Registers};
/// use verne_solver::{platform_working, worst_margin_rows};
///
/// let machine = Machine::verne();
/// let mut postures = PostureColumns::new();
/// postures.push(&platform_working(&machine, [0.0, 0.0, 600.0])?, None);
/// worst_margin_rows(&machine, &postures, None, Registers::Widest, |_, worst, feasible| {
///     assert_eq!(worst.constraint, Constraint::Stroke);
///     assert!(worst.value < 0.0 && !feasible);
/// });
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn worst_margin_rows(
    machine: &Machine,
    postures: &PostureColumns,
    clearance: Option<&Clearance>,
    registers: Registers,
    mut found: impl FnMut(usize, Margin, bool),
) {
    let mut kernel = WorstRows { all: MarginRows::new(), worst: WorstBlock::new() };
    for (first, rows, block) in postures.blocks() {
        kernel.all.solve(machine, (rows, block), clearance, registers);
        registers.run(&mut kernel, machine);
        for i in 0..rows {
            let (worst, feasible) = kernel.worst.of(i, &kernel.all.margins);
            found(first + i, worst, feasible);
        }
    }
}
