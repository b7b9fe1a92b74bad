//! The working mode for many rows of slider positions.

use super::elimination::AssemblyClosureRows;
use super::{forward_working, on_home_side};
use crate::error::KinematicsError;
use crate::loop_closure::RootRows;
use crate::machine::Machine;
use crate::posture::Posture;
use crate::posture_rows::PostureRows;
use crate::registers::{Kernel, ROWS, Registers, set_columns};
use crate::request_range::are_accepted;

struct ForwardRows {
    rho: [[f64; ROWS]; 3],
    closures: AssemblyClosureRows,
    roots: RootRows,
    postures: PostureRows,
}

impl Kernel for ForwardRows {
    #[inline(always)]
    fn run(&mut self, machine: &Machine) {
        let Self { rho, closures, roots, postures } = self;
        let mechanism = &machine.mechanism;
        for i in 0..ROWS {
            closures.set(i, mechanism, rho.each_ref().map(|row| row[i]));
        }
        roots.iterate_from_level_platform(|i| closures.closure(mechanism, i));
        for i in 0..ROWS {
            let rho = rho.each_ref().map(|row| row[i]);
            let (closure, root) = (closures.closure(mechanism, i), roots.root(i));
            let (posture, is_exact) = closure.uncorrected_posture(mechanism, rho, &root);
            let accepted = are_accepted(mechanism, &rho, &[]) & !closure.has_self_motion(mechanism.longest);
            // The code for a single row answers for machines with R1 = r1 or e1 = e2, or nearly so.
            let accepted = accepted & !mechanism.at_family_edge;
            let right = roots.is_found(i) & on_home_side(machine, &closure, &root) & posture.working;
            postures.set(i, &posture, accepted & right & is_exact);
        }
    }
}

/// Calls `found` for each row of slider positions `rho` in turn with its index and the answer of [`forward_working`],
/// the same to the last bit.
///
/// # Units
///
/// `rho` are the sliders' z in the base frame, mm; z points down. The poses are in millimetres and radians.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), section III.D.
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, Registers, forward_working, forward_working_rows};
///
/// let machine = Machine::verne();
/// let rows = [660.0, 670.0, 680.0].map(|rho1| [rho1, 685.0, 250.0]);
/// let mut all = Vec::new();
/// forward_working_rows(&machine, &rows, Registers::Widest, |_, answer| all.push(answer));
/// assert_eq!(all[2], forward_working(&machine, rows[2]));
/// ```
pub fn forward_working_rows(
    machine: &Machine,
    rho: &[[f64; 3]],
    registers: Registers,
    mut found: impl FnMut(usize, Result<Posture, KinematicsError>),
) {
    let mut kernel = ForwardRows {
        rho: [[0.0; ROWS]; 3],
        closures: AssemblyClosureRows::new(),
        roots: RootRows::new(),
        postures: PostureRows::new(),
    };
    for (first, block) in (0..).step_by(ROWS).zip(rho.chunks(ROWS)) {
        set_columns(&mut kernel.rho, block.iter().copied());
        registers.run(&mut kernel, machine);
        for (i, &rho) in (0..ROWS).zip(block) {
            let posture = kernel.postures.posture(i);
            found(first + i, posture.map_or_else(|| forward_working(machine, rho), Ok));
        }
    }
}
