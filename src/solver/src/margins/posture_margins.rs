//! The margins of one posture.

use super::{cone, interference};
use crate::clearance::Clearance;
use crate::limit::Margin;
use crate::machine::Machine;
use crate::mechanism::Geometry;
use crate::parallel_matrix::{determinant, matrix};
use crate::pose::{PlatformPose, TableAngles};
use crate::posture::Posture;
use crate::rods::Rods;

/// All margins of one posture. Arrays of four are for rod 11, rod 12, the rods of leg II, the rods of leg III (the
/// two rods of a parallelogram are parallel).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margins {
    /// `[rho - min, max - rho]` of each slider, mm.
    pub stroke: [[f64; 2]; 3],
    /// The height of each leg along z, mm: what its length leaves for it.
    pub leg_length: [f64; 3],
    /// Cosine between rod and guideway less the limit.
    pub serial_singularity: [f64; 4],
    /// `det_P` in the sign of home less the limit.
    pub parallel_singularity: f64,
    /// Cone half-angle less the rod's angle from its axis at the slider, rad.
    pub slider_joint: [f64; 4],
    /// Cone half-angle less the rod's angle from its axis at the platform, rad.
    pub platform_joint: [f64; 4],
    /// R1 cos alpha - r1, mm. `None` where R1 = r1 and the platform does not turn: the rods of leg I stay parallel.
    pub rod_crossing: Option<f64>,
    /// Least distance between the axes of two rods less twice the rod radius, mm.
    pub rod_interference: f64,
    /// The two rods that are nearest to each other.
    pub nearest_rods: [u8; 2],
    /// `[theta1 - min, max - theta1]`, rad. `None` if the table takes no part.
    pub tilt: Option<[f64; 2]>,
    /// `[theta2 - min, max - theta2]`, rad. `None` if the table takes no part.
    pub rotary: Option<[f64; 2]>,
    /// Height of the lowest point (the tool's end or a joint of the platform) over the table's plane, less the least
    /// height. `None` if it is not checked.
    pub table_clearance: Option<Margin>,
}

impl Margins {
    /// Computes the margins of a posture. With `table` they include the ranges of theta1 and theta2. The height over
    /// the table's plane is not among them: see [`Self::above_table`].
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
    /// use verne_solver::{KinematicsError, Machine, Margins, platform_working};
    ///
    /// let machine = Machine::verne();
    /// let posture = platform_working(&machine, [0.0, 0.0, 1200.0])?;
    /// let margins = Margins::of(&machine, &posture, None);
    /// assert_eq!(margins.stroke[0][0], posture.rho[0], "the first slider's stroke begins at 0");
    /// assert!(margins.feasible() && margins.tilt.is_none());
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn of(machine: &Machine, posture: &Posture, table: Option<TableAngles>) -> Self {
        Self::of_solution(machine, &posture.pose, posture.rho, table)
    }

    /// Computes the margins from a posture's pose and sliders.
    #[inline]
    pub(crate) fn of_solution(
        machine: &Machine,
        pose: &PlatformPose,
        rho: [f64; 3],
        table: Option<TableAngles>,
    ) -> Self {
        Self::of_closed(machine, pose, rho, &Rods::of(&machine.mechanism, pose, rho), table)
    }

    #[inline]
    fn of_closed(
        machine: &Machine,
        pose: &PlatformPose,
        rho: [f64; 3],
        rods: &Rods,
        table: Option<TableAngles>,
    ) -> Self {
        let nearest = interference::least_distance(&machine.mechanism, rods);
        let limits = machine.limits();
        let mut margins = Self {
            tilt: table.map(|table| range_margins(limits.tilt, table.theta1)),
            rotary: table.zip(limits.rotary).map(|(table, range)| range_margins(range, table.theta2)),
            ..Self::of_parallel_module(machine, pose, rho, rods, nearest)
        };
        if machine.mechanism.is_delta() && pose.alpha == 0.0 {
            margins.rod_crossing = None;
        }
        margins
    }

    /// The margins of the sliders' strokes.
    #[inline(always)]
    pub(super) fn of_strokes(machine: &Machine, rho: [f64; 3]) -> [[f64; 2]; 3] {
        let stroke = &machine.limits().stroke;
        [0, 1, 2].map(|i: usize| range_margins(stroke[i], rho[i]))
    }

    /// The margins without the table's, from the least distance between two rods' axes and the two rods.
    #[inline(always)]
    pub(super) fn of_parallel_module(
        machine: &Machine,
        pose: &PlatformPose,
        rho: [f64; 3],
        rods: &Rods,
        (distance, nearest_rods): (f64, [u8; 2]),
    ) -> Self {
        let (g, limits, home) = (machine.geometry(), machine.limits(), &machine.home);
        let directions = cone::columns(&rods.directions);
        Self {
            stroke: Self::of_strokes(machine, rho),
            leg_length: heights(g, pose, rho, rods),
            serial_singularity: rods.directions.map(|direction| direction[2] - limits.serial_margin),
            parallel_singularity: det_margin(machine, rods),
            slider_joint: cone::margins(limits.slider_cone, &home.slider_axes, &directions),
            platform_joint: cone::margins(
                limits.platform_cone,
                &home.platform_axes,
                &cone::in_platform(rods, &directions),
            ),
            rod_crossing: Some(g.R1 * rods.c - g.r1),
            rod_interference: distance - 2.0 * g.rod_radius,
            nearest_rods,
            tilt: None,
            rotary: None,
            table_clearance: None,
        }
    }

    /// Computes the same margins and, if `table` and `clearance` are given, that of the height over the table's plane.
    ///
    /// # Units
    ///
    /// Each field of [`Margins`] states its unit: mm, rad, or none.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): section IV.A and Eq (26); the
    /// paper has no limit for the table's plane.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::{Clearance, KinematicsError, Machine, Margins, platform_working, table_angles};
    ///
    /// let machine = Machine::verne();
    /// let posture = platform_working(&machine, [0.0, 0.0, 1200.0])?;
    /// let table = table_angles(&machine, posture.pose.alpha, 0.0, 0.0);
    /// let clearance = Clearance::of(&machine, Some(2.0), 150.0, 5.0);
    /// let margins = Margins::above_table(&machine, &posture, Some(table), clearance.as_ref());
    /// // P is 1500 - 1200 + 200 over the plane, the tool's end 150 lower, and the least height is 2.
    /// assert_eq!(margins.table_clearance.map(|margin| margin.value.round()), Some(348.0));
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn above_table(
        machine: &Machine,
        posture: &Posture,
        table: Option<TableAngles>,
        clearance: Option<&Clearance>,
    ) -> Self {
        let above = table.zip(clearance);
        let above = above.map(|(table, clearance)| clearance.margin(machine, &posture.pose, table));
        Self { table_clearance: above, ..Self::of(machine, posture, table) }
    }

    /// [`Self::above_table`] from the platform's pose, the sliders, the rods and the table's angles.
    #[inline]
    pub(crate) fn of_rods(
        machine: &Machine,
        pose: &PlatformPose,
        rho: [f64; 3],
        rods: &Rods,
        table: TableAngles,
        clearance: Option<&Clearance>,
    ) -> Self {
        let above = clearance.map(|clearance| clearance.margin(machine, pose, table));
        Self { table_clearance: above, ..Self::of_closed(machine, pose, rho, rods, Some(table)) }
    }

    /// Whether every margin is at least zero.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): section IV.A.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::{KinematicsError, Machine, Margins, platform_working};
    ///
    /// let machine = Machine::verne();
    /// let posture = platform_working(&machine, [0.0, 0.0, 600.0])?;
    /// assert!(!Margins::of(&machine, &posture, None).feasible(), "the sliders would be above their strokes");
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn feasible(&self) -> bool {
        let inside = |ends: &[f64; 2]| ends[0] >= 0.0 && ends[1] >= 0.0;
        let all = |margins: &[f64]| margins.iter().all(|margin| *margin >= 0.0);
        self.stroke.iter().all(inside)
            && all(&self.leg_length)
            && all(&self.serial_singularity)
            && all(&self.slider_joint)
            && all(&self.platform_joint)
            && all(&[self.parallel_singularity, self.rod_crossing.unwrap_or(0.0), self.rod_interference])
            && self.tilt.iter().chain(&self.rotary).all(inside)
            && self.table_clearance.is_none_or(|margin| margin.value >= 0.0)
    }
}

/// The height of each leg along z, mm: what its length leaves for it.
#[inline(always)]
pub(super) fn heights(g: &Geometry, pose: &PlatformPose, rho: [f64; 3], rods: &Rods) -> [f64; 3] {
    let (z, q) = (pose.z, g.R2 * rods.s);
    let [rho1, rho2, rho3] = rho;
    [z - rho1, z - q - rho2, z + q - rho3].map(f64::abs)
}

/// The margin of crossed rods, if it is a limit at this angle.
#[inline]
pub(super) fn limited_crossing(machine: &Machine, alpha: f64, margin: f64) -> Option<f64> {
    (!machine.mechanism.is_delta() || alpha != 0.0).then_some(margin)
}

/// `det_P` in the sign of home less the limit.
#[inline(always)]
pub(super) fn det_margin(machine: &Machine, rods: &Rods) -> f64 {
    margin_of_det(machine, determinant(&matrix(machine.geometry(), rods)))
}

/// The same from the determinant.
#[inline(always)]
pub(super) fn margin_of_det(machine: &Machine, det: f64) -> f64 {
    det * machine.home.det.signum() - machine.limits().parallel_margin
}

/// The margins of a value in a range.
#[inline(always)]
pub(super) fn range_margins([low, high]: [f64; 2], value: f64) -> [f64; 2] {
    [value - low, high - value]
}
