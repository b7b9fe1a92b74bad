//! The working mode for many positions of P.

use super::leg_one_cubic::CubicRows;
use super::platform::{platform_working, pose_at};
use super::solutions::posture_above;
use crate::error::KinematicsError;
use crate::machine::Machine;
use crate::pose::Point;
use crate::posture::Posture;
use crate::posture_rows::PostureRows;
use crate::registers::{Kernel, ROWS, Registers, set_columns};
use crate::request_range::are_accepted;

struct PlatformRows {
    points: [[f64; ROWS]; 3],
    cubics: CubicRows,
    postures: PostureRows,
}

impl Kernel for PlatformRows {
    #[inline(always)]
    fn run(&mut self, machine: &Machine) {
        let Self { points, cubics, postures } = self;
        let mechanism = &machine.mechanism;
        cubics.find_nearest(mechanism, &points[0], &points[1]);
        for i in 0..ROWS {
            let p = points.each_ref().map(|row| row[i]);
            let (angle, is_found) = cubics.angle(mechanism, p, i);
            let pose = pose_at(mechanism, p, &angle);
            let (posture, is_solution) = posture_above(mechanism, &pose);
            let accepted = are_accepted(mechanism, &p, &[]);
            postures.set(i, &posture, accepted & is_found & pose.is_precise() & is_solution);
        }
    }
}

/// Calls `found` for each of the `points` in turn with its index and the answer of [`platform_working`], the same to
/// the last bit.
///
/// # Units
///
/// The points and the sliders `rho` are millimetres; z points down. alpha is in radians.
///
/// # References
///
/// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), (15), section III.C.
///
/// # Examples
///
/// ```
/// use verne_solver::{Machine, Registers, platform_working, platform_working_rows};
///
/// let machine = Machine::verne();
/// let points = [0.0, 10.0, 20.0].map(|x| [x, -86.0, 1000.0]);
/// let mut all = Vec::new();
/// platform_working_rows(&machine, &points, Registers::Widest, |_, answer| all.push(answer));
/// assert_eq!(all[2], platform_working(&machine, points[2]));
/// ```
pub fn platform_working_rows(
    machine: &Machine,
    points: &[Point],
    registers: Registers,
    mut found: impl FnMut(usize, Result<Posture, KinematicsError>),
) {
    let (cubics, postures) = (CubicRows::new(), PostureRows::new());
    let mut kernel = PlatformRows { points: [[0.0; ROWS]; 3], cubics, postures };
    for (first, block) in (0..).step_by(ROWS).zip(points.chunks(ROWS)) {
        set_columns(&mut kernel.points, block.iter().copied());
        registers.run(&mut kernel, machine);
        for (i, &point) in (0..ROWS).zip(block) {
            let posture = kernel.postures.posture(i);
            found(first + i, posture.map_or_else(|| platform_working(machine, point), Ok));
        }
    }
}
