//! All margins of many postures.

use super::interference::{least_distance, nearest_within_legs, rods_of_leg};
use super::posture_margins::{Margins, limited_crossing, range_margins};
use crate::clearance::Clearance;
use crate::fast_math::{MAX_ANGLE, sin_cos_of_turn};
use crate::machine::Machine;
use crate::pose::{PlatformPose, TableAngles};
use crate::posture::Posture;
use crate::registers::{Kernel, ROWS, Registers, set_columns};
use crate::rods::Rods;

/// A posture, and the table's angles if the table takes part.
type Row = (Posture, Option<TableAngles>);

/// Postures and their margins by coordinate.
struct MarginRows {
    /// x, y, z, alpha, rho1, rho2, rho3.
    postures: [[f64; ROWS]; 7],
    leg_length: [[f64; ROWS]; 3],
    serial_singularity: [[f64; ROWS]; 4],
    parallel_singularity: [f64; ROWS],
    slider_joint: [[f64; ROWS]; 4],
    platform_joint: [[f64; ROWS]; 4],
    rod_crossing: [f64; ROWS],
    rod_interference: [f64; ROWS],
    /// 0, 1 or 2 for the leg whose two rods are the nearest.
    nearest_leg: [u64; ROWS],
    /// 1 for a row whose nearest rods are certainly those of one leg.
    others_are_farther: [u64; ROWS],
}

impl Kernel for MarginRows {
    #[inline(always)]
    fn run(&mut self, machine: &Machine) {
        for i in 0..ROWS {
            let [x, y, z, alpha, rho1, rho2, rho3] = self.postures.each_ref().map(|row| row[i]);
            let (pose, rho) = (PlatformPose { x, y, z, alpha }, [rho1, rho2, rho3]);
            let rods = Rods::with_angle(&machine.mechanism, &pose, rho, sin_cos_of_turn(alpha));
            let nearest = nearest_within_legs(&machine.mechanism, &rods);
            let margins =
                Margins::of_parallel_module(machine, &pose, rho, &rods, (nearest.distance, rods_of_leg(0)));
            self.set(i, &margins);
            self.nearest_leg[i] = nearest.leg;
            self.others_are_farther[i] = u64::from(nearest.others_are_farther);
        }
    }
}

impl MarginRows {
    #[inline(always)]
    fn set(&mut self, i: usize, margins: &Margins) {
        set(&mut self.leg_length, i, margins.leg_length);
        set(&mut self.serial_singularity, i, margins.serial_singularity);
        set(&mut self.slider_joint, i, margins.slider_joint);
        set(&mut self.platform_joint, i, margins.platform_joint);
        self.parallel_singularity[i] = margins.parallel_singularity;
        self.rod_crossing[i] = margins.rod_crossing.unwrap_or(0.0);
        self.rod_interference[i] = margins.rod_interference;
    }

    /// Computes the margins of at most [`ROWS`] postures.
    fn solve(&mut self, machine: &Machine, rows: &[Row], registers: Registers) {
        let numbers = |(posture, _): &Row| {
            let (PlatformPose { x, y, z, alpha }, [rho1, rho2, rho3]) = (posture.pose, posture.rho);
            [x, y, z, alpha, rho1, rho2, rho3]
        };
        set_columns(&mut self.postures, rows.iter().map(numbers));
        registers.run(self, machine);
    }

    /// The margins of a row, as [`Margins::above_table`] computes them. All fields are written once, for moving them
    /// takes time.
    #[inline]
    fn margins(&self, i: usize, machine: &Machine, row: &Row, clearance: Option<&Clearance>) -> Margins {
        let (posture, table) = row;
        if posture.pose.alpha.abs() >= MAX_ANGLE {
            return Margins::above_table(machine, posture, *table, clearance);
        }
        let (rod_interference, nearest_rods) = if self.others_are_farther[i] == 1 {
            (self.rod_interference[i], rods_of_leg(self.nearest_leg[i]))
        } else {
            interference_of(machine, posture)
        };
        let limits = machine.limits();
        let above = table.zip(clearance);
        Margins {
            stroke: Margins::of_strokes(machine, posture.rho),
            leg_length: self.leg_length.each_ref().map(|row| row[i]),
            serial_singularity: self.serial_singularity.each_ref().map(|row| row[i]),
            parallel_singularity: self.parallel_singularity[i],
            slider_joint: self.slider_joint.each_ref().map(|row| row[i]),
            platform_joint: self.platform_joint.each_ref().map(|row| row[i]),
            rod_crossing: limited_crossing(machine, posture.pose.alpha, self.rod_crossing[i]),
            rod_interference,
            nearest_rods,
            tilt: table.map(|table| range_margins(limits.tilt, table.theta1)),
            rotary: table.zip(limits.rotary).map(|(table, range)| range_margins(range, table.theta2)),
            table_clearance: above.map(|(table, clearance)| clearance.margin(machine, &posture.pose, table)),
        }
    }
}

/// The margin of rod interference and the nearest rods of a posture, of which rods of different legs may be nearest.
fn interference_of(machine: &Machine, posture: &Posture) -> (f64, [u8; 2]) {
    let g = machine.geometry();
    let rods = Rods::of(&machine.mechanism, &posture.pose, posture.rho);
    let (distance, nearest_rods) = least_distance(&machine.mechanism, &rods);
    (distance - 2.0 * g.rod_radius, nearest_rods)
}

/// Writes a row.
#[inline(always)]
fn set<const N: usize>(columns: &mut [[f64; ROWS]; N], i: usize, row: [f64; N]) {
    for (column, number) in columns.iter_mut().zip(row) {
        column[i] = number;
    }
}

/// Calls `found` for each posture in turn with its index and the answer of [`Margins::above_table`], the same to the
/// last bit.
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
/// use verne_solver::{KinematicsError, Machine, Margins, Registers, margin_rows, platform_working};
///
/// let machine = Machine::verne();
/// let rows = [(platform_working(&machine, [0.0, 0.0, 1200.0])?, None)];
/// let mut all = Vec::new();
/// margin_rows(&machine, &rows, None, Registers::Widest, |_, margins| all.push(margins));
/// assert_eq!(all, [Margins::of(&machine, &rows[0].0, None)]);
/// # Ok::<(), KinematicsError>(())
/// ```
pub fn margin_rows(
    machine: &Machine,
    rows: &[(Posture, Option<TableAngles>)],
    clearance: Option<&Clearance>,
    registers: Registers,
    mut found: impl FnMut(usize, Margins),
) {
    let mut kernel = new();
    for (first, block) in (0..).step_by(ROWS).zip(rows.chunks(ROWS)) {
        kernel.solve(machine, block, registers);
        for (i, row) in (0..ROWS).zip(block) {
            found(first + i, kernel.margins(i, machine, row, clearance));
        }
    }
}

fn new() -> MarginRows {
    let zero = [0.0; ROWS];
    MarginRows {
        postures: [zero; 7],
        leg_length: [zero; 3],
        serial_singularity: [zero; 4],
        parallel_singularity: zero,
        slider_joint: [zero; 4],
        platform_joint: [zero; 4],
        rod_crossing: zero,
        rod_interference: zero,
        nearest_leg: [0; ROWS],
        others_are_farther: [0; ROWS],
    }
}
