//! The margins of some postures by coordinate.

use super::posture_margins::{Margins, range_margins};
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::pose::TableAngles;
use crate::registers::{BLOCK_ROWS, ROWS};

/// A number of each row.
pub(super) type Column = [f64; ROWS];

/// The margins of at most [`BLOCK_ROWS`] postures. The numbers lie by coordinate: each field of [`Margins`] is a
/// column, or several. The last numbers of a column mean nothing if there are fewer postures.
#[derive(Clone, Debug)]
pub struct MarginBlock {
    rows: usize,
    /// `[rho - min, max - rho]` of each slider, mm.
    pub stroke: [[[f64; BLOCK_ROWS]; 2]; 3],
    /// [`Margins::leg_length`].
    pub leg_length: [[f64; BLOCK_ROWS]; 3],
    /// [`Margins::serial_singularity`].
    pub serial_singularity: [[f64; BLOCK_ROWS]; 4],
    /// [`Margins::parallel_singularity`].
    pub parallel_singularity: [f64; BLOCK_ROWS],
    /// [`Margins::slider_joint`].
    pub slider_joint: [[f64; BLOCK_ROWS]; 4],
    /// [`Margins::platform_joint`].
    pub platform_joint: [[f64; BLOCK_ROWS]; 4],
    /// [`Margins::rod_crossing`]; it means nothing in rows in which that is `None`.
    pub rod_crossing: [f64; BLOCK_ROWS],
    /// 1 for rows in which crossed rods are a limit.
    pub(super) has_crossing: [u64; ROWS],
    /// [`Margins::rod_interference`].
    pub rod_interference: [f64; BLOCK_ROWS],
    /// The nearest rods' numbers: 256 times the one plus the other.
    pub(super) nearest_rods: [u64; ROWS],
    /// `[theta1 - min, max - theta1]`, rad, of rows in which the table takes part.
    pub(super) tilt: [Column; 2],
    /// The same of theta2.
    pub(super) rotary: [Column; 2],
    /// 1 for rows in which the table takes part.
    pub(super) has_table: [u64; ROWS],
    /// 1 if theta2 has a range.
    pub(super) has_rotary: u64,
    /// Heights over the table's plane, mm, of rows for which they are checked.
    pub(super) table_clearance: Column,
    /// 1 for these rows.
    pub(super) has_clearance: [u64; ROWS],
    /// The lowest part of each.
    lowest: [Element; ROWS],
}

impl MarginBlock {
    pub(super) fn new() -> Self {
        let zero = [0.0; ROWS];
        Self {
            rows: 0,
            stroke: [[zero; 2]; 3],
            leg_length: [zero; 3],
            serial_singularity: [zero; 4],
            parallel_singularity: zero,
            slider_joint: [zero; 4],
            platform_joint: [zero; 4],
            rod_crossing: zero,
            has_crossing: [0; ROWS],
            rod_interference: zero,
            nearest_rods: [0; ROWS],
            tilt: [zero; 2],
            rotary: [zero; 2],
            has_table: [0; ROWS],
            has_rotary: 0,
            table_clearance: zero,
            has_clearance: [0; ROWS],
            lowest: [Element::Tool; ROWS],
        }
    }

    /// The number of postures.
    #[expect(clippy::len_without_is_empty, reason = "no block is empty")]
    pub fn len(&self) -> usize {
        self.rows
    }

    /// The margins of a row.
    ///
    /// # Panics
    ///
    /// `i` is not below [`len`](Self::len).
    pub fn row(&self, i: usize) -> Margins {
        assert!(i < self.rows, "the block has {} rows", self.rows);
        let has_table = self.has_table[i] == 1;
        Margins {
            stroke: self.stroke.each_ref().map(|ends| row(ends, i)),
            leg_length: row(&self.leg_length, i),
            serial_singularity: row(&self.serial_singularity, i),
            parallel_singularity: self.parallel_singularity[i],
            slider_joint: row(&self.slider_joint, i),
            platform_joint: row(&self.platform_joint, i),
            rod_crossing: (self.has_crossing[i] == 1).then_some(self.rod_crossing[i]),
            rod_interference: self.rod_interference[i],
            nearest_rods: self.nearest_rods(i),
            tilt: has_table.then(|| row(&self.tilt, i)),
            rotary: (has_table && self.has_rotary == 1).then(|| row(&self.rotary, i)),
            table_clearance: (self.has_clearance[i] == 1).then(|| self.clearance(i)),
        }
    }

    /// The two rods of a row that are nearest to each other.
    #[inline]
    pub(super) fn nearest_rods(&self, i: usize) -> [u8; 2] {
        let [.., a, b] = self.nearest_rods[i].to_be_bytes();
        [a, b]
    }

    /// The margin of the height over the table's plane, in a row that has it.
    #[inline]
    pub(super) fn clearance(&self, i: usize) -> Margin {
        let (element, value) = (self.lowest[i], self.table_clearance[i]);
        Margin { constraint: Constraint::TableClearance, element, value }
    }

    /// Sets what all rows share.
    pub(super) fn begin(&mut self, rows: usize, machine: &Machine, has_table: &[u64; ROWS]) {
        self.rows = rows;
        self.has_table = *has_table;
        self.has_rotary = u64::from(machine.limits().rotary.is_some());
        self.has_clearance = [0; ROWS];
    }

    /// Sets the margins of the parallel module; `leg` is 0, 1 or 2 for the leg whose rods are the nearest.
    #[inline(always)]
    pub(super) fn set_parallel_module(&mut self, i: usize, margins: &Margins, leg: u64) {
        let [first, second, third] = margins.stroke;
        set(&mut self.stroke[0], i, first);
        set(&mut self.stroke[1], i, second);
        set(&mut self.stroke[2], i, third);
        set(&mut self.leg_length, i, margins.leg_length);
        set(&mut self.serial_singularity, i, margins.serial_singularity);
        set(&mut self.slider_joint, i, margins.slider_joint);
        set(&mut self.platform_joint, i, margins.platform_joint);
        self.parallel_singularity[i] = margins.parallel_singularity;
        self.rod_crossing[i] = margins.rod_crossing.unwrap_or(0.0);
        self.rod_interference[i] = margins.rod_interference;
        let others = if leg == 1 { pair(21) } else { pair(31) };
        self.nearest_rods[i] = if leg == 0 { pair(11) } else { others };
    }

    /// Sets the margin of rod interference, and the nearest rods.
    pub(super) fn set_interference(&mut self, i: usize, margin: f64, [a, b]: [u8; 2]) {
        self.rod_interference[i] = margin;
        self.nearest_rods[i] = u64::from(u16::from_be_bytes([a, b]));
    }

    /// Sets whether crossed rods are a limit.
    #[inline(always)]
    pub(super) fn set_crossing_limit(&mut self, i: usize, is_limit: bool) {
        self.has_crossing[i] = u64::from(is_limit);
    }

    /// Sets the margins of the table's angles in their ranges.
    #[inline(always)]
    pub(super) fn set_table(&mut self, i: usize, [tilt, rotary]: &[[f64; 2]; 2], angles: TableAngles) {
        set(&mut self.tilt, i, range_margins(*tilt, angles.theta1));
        set(&mut self.rotary, i, range_margins(*rotary, angles.theta2));
    }

    /// Sets the margin of the height over the table's plane.
    #[inline]
    pub(super) fn set_clearance(&mut self, i: usize, Margin { element, value, .. }: Margin) {
        self.has_clearance[i] = 1;
        (self.lowest[i], self.table_clearance[i]) = (element, value);
    }
}

/// A rod and the other one of its leg.
const fn pair(rod: u64) -> u64 {
    256 * rod + rod + 1
}

#[inline]
fn row<const N: usize>(columns: &[Column; N], i: usize) -> [f64; N] {
    columns.each_ref().map(|column| column[i])
}

#[inline(always)]
fn set<const N: usize>(columns: &mut [Column; N], i: usize, row: [f64; N]) {
    for (column, number) in columns.iter_mut().zip(row) {
        column[i] = number;
    }
}
