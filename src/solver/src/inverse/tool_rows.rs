//! The working mode for many tool centre points in the base frame.

use super::locus_rows::LocusRows;
use super::tool::{tool_locus, tool_working};
use crate::error::KinematicsError;
use crate::machine::Machine;
use crate::pose::Point;
use crate::posture::Posture;
use crate::registers::{Kernel, ROWS, Registers, set_columns};
use crate::request_range::are_accepted;

struct ToolRows {
    tool_length: f64,
    points: [[f64; ROWS]; 3],
    loci: LocusRows,
}

impl Kernel for ToolRows {
    #[inline(always)]
    fn run(&mut self, machine: &Machine) {
        let Self { tool_length, points, loci } = self;
        let mechanism = &machine.mechanism;
        for i in 0..ROWS {
            let [x, y, z] = points.each_ref().map(|row| row[i]);
            let accepted = are_accepted(mechanism, &[x, y, z, *tool_length], &[]);
            loci.set(i, mechanism, &tool_locus([x, y, z], *tool_length), accepted);
        }
        loci.solve(mechanism);
    }
}

/// Calls `found` for each of the `points` in turn with its index and the answer of [`tool_working`], the same to the
/// last bit.
///
/// # Units
///
/// The points, `tool_length` and the sliders `rho` are millimetres; z points down. alpha is in radians.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eq (27), with (15) as an equation
/// of degree three on the circle.
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, Registers, tool_working, tool_working_rows};
///
/// let machine = Machine::verne();
/// let points = [0.0, 10.0, 20.0].map(|x| [x, 120.0, 1300.0]);
/// let mut all = Vec::new();
/// tool_working_rows(&machine, &points, 150.0, Registers::Widest, |_, answer| all.push(answer));
/// assert_eq!(all[2], tool_working(&machine, points[2], 150.0));
/// ```
pub fn tool_working_rows(
    machine: &Machine,
    points: &[Point],
    tool_length: f64,
    registers: Registers,
    mut found: impl FnMut(usize, Result<Posture, KinematicsError>),
) {
    let mut kernel = ToolRows { tool_length, points: [[0.0; ROWS]; 3], loci: LocusRows::new() };
    for (first, block) in (0..).step_by(ROWS).zip(points.chunks(ROWS)) {
        set_columns(&mut kernel.points, block.iter().copied());
        registers.run(&mut kernel, machine);
        for (i, &point) in (0..ROWS).zip(block) {
            let posture = kernel.loci.postures.posture(i);
            found(first + i, posture.map_or_else(|| tool_working(machine, point, tool_length), Ok));
        }
    }
}
