//! Derivatives of the platform's pose and of the tool by every parameter.

use nalgebra::Vector3;

use super::actual_machine::ActualMachine;
use super::tool::{ToolFrame, tip_and_axis};
use super::{MACHINE_FRAME_PARAMETERS, PARAMETERS, Parameter};
use crate::jacobian::is_singular;
use crate::parallel_matrix::{inverse, matrix};
use crate::pose::PlatformPose;
use crate::rods::Rods;

/// Derivatives of (x, y, z, alpha) of the platform by each parameter, in the order of [`Parameter::ALL`].
///
/// # Units
///
/// mm for x, y, z and rad for alpha, per mm or rad of the parameter; base frame.
pub type PlatformRates = [[f64; 4]; PARAMETERS];

/// Derivatives of the tool's end and of its axis by each parameter, in the order of [`Parameter::ALL`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolRates {
    /// Of the tool's end: mm per mm or rad.
    pub tip: [[f64; 3]; PARAMETERS],
    /// Of the tool's axis, a unit vector from the tool's end to its holder: rad per mm or rad.
    pub axis: [[f64; 3]; PARAMETERS],
}

/// The right-hand sides of the linear equations for rods 11, 12, II, III: the table in the module's documentation.
fn right_hand_sides(rods: &Rods) -> [(Parameter, [f64; 4]); 12] {
    use Parameter as P;
    let [x, y, z] = [0, 1, 2].map(|axis: usize| rods.directions.map(|direction| direction[axis]));
    let m = [0, 1, 2, 3].map(|rod: usize| y[rod] * rods.c + z[rod] * rods.s);
    [
        (P::e1, [-x[0], -x[1], 0.0, 0.0]),
        (P::e2, [0.0, 0.0, -x[2], -x[3]]),
        (P::R1, [-m[0], m[1], 0.0, 0.0]),
        (P::r1, [y[0], -y[1], 0.0, 0.0]),
        (P::R2, [0.0, 0.0, m[2], -m[3]]),
        (P::r4, [0.0, 0.0, -y[2], y[3]]),
        (P::L1, [1.0, 1.0, 0.0, 0.0]),
        (P::L2, [0.0, 0.0, 1.0, 0.0]),
        (P::L3, [0.0, 0.0, 0.0, 1.0]),
        (P::o1, [z[0], z[1], 0.0, 0.0]),
        (P::o2, [0.0, 0.0, z[2], 0.0]),
        (P::o3, [0.0, 0.0, 0.0, z[3]]),
    ]
}

impl ActualMachine {
    /// Computes the derivatives of the platform's pose by every parameter while the sliders stand still. `rho` is what
    /// the control indicates, and `pose` the platform's pose there. The answer is `None` at a parallel singularity.
    ///
    /// # Units
    ///
    /// Millimetres and radians; base frame.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6), differentiated.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::parameter::{ActualMachine, ActualPoseError, Parameter};
    /// use verne_solver::Machine;
    ///
    /// let machine = ActualMachine::new(&Machine::verne(), 50.0);
    /// let rho = [674.0, 685.0, 250.0];
    /// let rates = machine.platform_rates(&machine.platform(rho)?, rho).expect("not singular");
    /// let [_, _, z, _] = [0, 1, 2, 3].map(|i| {
    ///     [Parameter::o1, Parameter::o2, Parameter::o3].map(|offset| rates[offset.index()][i]).iter().sum::<f64>()
    /// });
    /// assert!((z - 1.0).abs() < 1e-9, "equal zero offsets carry the platform along");
    /// # Ok::<(), ActualPoseError>(())
    /// ```
    pub fn platform_rates(&self, pose: &PlatformPose, rho: [f64; 3]) -> Option<PlatformRates> {
        let mechanism = self.mechanism();
        let rods = Rods::of(mechanism, pose, self.slider_positions(rho));
        let rows = matrix(&mechanism.geometry, &rods);
        if is_singular(&rows) {
            return None;
        }
        let (_, inverse) = inverse(&rows)?;
        let units = [1.0, 1.0, 1.0, 1.0 / mechanism.geometry.R1];
        let mut rates = [[0.0; 4]; PARAMETERS];
        for (parameter, side) in right_hand_sides(&rods) {
            rates[parameter.index()] = std::array::from_fn(|row| {
                units[row] * inverse[row].iter().zip(side).map(|(a, b)| a * b).sum::<f64>()
            });
        }
        Some(rates)
    }

    /// Computes the derivatives of the tool's end and axis by every parameter while the joints stand still, in the
    /// machine's or the part frame. The table's parameters have no influence in the machine's frame. The answer is
    /// `None` at a parallel singularity.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(7), (27),
    /// differentiated.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::parameter::{ActualMachine, ActualPoseError, Parameter, ToolFrame};
    /// use verne_solver::{Machine, TableAngles};
    ///
    /// let machine = ActualMachine::new(&Machine::verne(), 50.0);
    /// let rho = [600.0, 500.0, 500.0];
    /// let level = ToolFrame::Part(TableAngles { theta1: 0.0, theta2: 0.0 });
    /// let rates = machine.tool_rates(&machine.platform(rho)?, rho, level).expect("not singular");
    /// let [x, y, z] = rates.tip[Parameter::da.index()];
    /// assert!(x == 0.0 && y.abs() < 1e-15 && (z - 1.0).abs() < 1e-15, "a lower table is farther from the tool");
    /// # Ok::<(), ActualPoseError>(())
    /// ```
    pub fn tool_rates(&self, pose: &PlatformPose, rho: [f64; 3], frame: ToolFrame) -> Option<ToolRates> {
        let (tip, axis) = self.machine_frame_rates(pose, &self.platform_rates(pose, rho)?);
        let ToolFrame::Part(table) = frame else {
            return Some(ToolRates { tip: tip.map(Into::into), axis: axis.map(Into::into) });
        };
        let frame = self.part_frame(table);
        let [end, direction] = tip_and_axis(pose, self.value(Parameter::ToolLength));
        let (mut tip, mut axis) =
            (tip.map(|rate| frame.direction(rate)), axis.map(|rate| frame.direction(rate)));
        tip[MACHINE_FRAME_PARAMETERS..].copy_from_slice(&frame.point_rates(end));
        axis[MACHINE_FRAME_PARAMETERS..].copy_from_slice(&frame.direction_rates(direction));
        Some(ToolRates { tip: tip.map(Into::into), axis: axis.map(Into::into) })
    }

    /// Derivatives of the tool's end and axis in the base frame.
    fn machine_frame_rates(
        &self,
        pose: &PlatformPose,
        platform: &PlatformRates,
    ) -> ([Vector3<f64>; PARAMETERS], [Vector3<f64>; PARAMETERS]) {
        let (s, c) = pose.alpha.sin_cos();
        let length = self.value(Parameter::ToolLength);
        let mut tip =
            platform.map(|[x, y, z, alpha]| Vector3::new(x, y - length * c * alpha, z - length * s * alpha));
        tip[Parameter::ToolLength.index()] = Vector3::new(0.0, -s, c);
        (tip, platform.map(|[_, _, _, alpha]| Vector3::new(0.0, c * alpha, s * alpha)))
    }
}
