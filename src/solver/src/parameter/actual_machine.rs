//! A machine whose parameters deviate from the nominal ones, and where its tool is.

use super::table_axes::PartFrame;
use super::tool::{Tool, ToolFrame, tip_and_axis};
use super::{ActualPoseError, PARAMETERS, Parameter};
use crate::forward::forward_working;
use crate::machine::{Machine, MachineError};
use crate::mechanism::{Geometry, Mechanism};
use crate::parallel_matrix::{determinant, matrix};
use crate::pose::{PlatformPose, TableAngles};
use crate::residual::{RESIDUAL_TOLERANCE, closed, magnitude};
use crate::rods::Rods;

/// A machine with a tool whose parameters differ from those of a nominal machine by small changes.
///
/// Its geometry need not be that of a valid [`Machine`]: R1 may be less than r1 by the change of either.
#[derive(Clone, Debug, PartialEq)]
pub struct ActualMachine {
    nominal: Machine,
    tool_length: f64,
    /// What each parameter exceeds its nominal value by.
    changes: [f64; PARAMETERS],
    /// The parallel module with the changes.
    mechanism: Mechanism,
}

impl ActualMachine {
    /// The machine without a change, and a tool of length `tool_length` from P.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::parameter::{ActualMachine, Parameter};
    ///
    /// let machine = ActualMachine::new(&Machine::verne(), 50.0);
    /// assert_eq!(machine.value(Parameter::e1), -500.0, "D1 = 100 and d1 = 600");
    /// assert_eq!(machine.machine(), Ok(Machine::verne()));
    /// ```
    pub fn new(nominal: &Machine, tool_length: f64) -> Self {
        let mechanism = nominal.mechanism;
        Self { nominal: nominal.clone(), tool_length, changes: [0.0; PARAMETERS], mechanism }
    }

    /// The same machine with further changes of parameters; those of the same parameter add up.
    ///
    /// # Units
    ///
    /// Millimetres and radians, by [`Parameter::unit`].
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::parameter::{ActualMachine, Parameter};
    ///
    /// let machine = ActualMachine::new(&Machine::verne(), 50.0);
    /// let longer = machine.with([(Parameter::L1, 0.5), (Parameter::L1, 0.25)]);
    /// assert_eq!(longer.value(Parameter::L1), 1050.75);
    /// ```
    #[must_use]
    pub fn with(&self, changes: impl IntoIterator<Item = (Parameter, f64)>) -> Self {
        let mut changed = self.clone();
        for (parameter, change) in changes {
            changed.changes[parameter.index()] += change;
        }
        changed.mechanism = Mechanism::new(changed.geometry());
        changed
    }

    /// The value of a parameter. It is zero for what a nominal machine has no field for, unless it was changed.
    ///
    /// # Units
    ///
    /// Millimetres and radians, by [`Parameter::unit`].
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::parameter::{ActualMachine, Parameter};
    ///
    /// let machine = ActualMachine::new(&Machine::verne(), 50.0);
    /// assert_eq!([Parameter::R1, Parameter::ToolLength, Parameter::o3].map(|p| machine.value(p)), [275.0, 50.0, 0.0]);
    /// ```
    pub fn value(&self, parameter: Parameter) -> f64 {
        use Parameter as P;
        let (g, table) = (self.nominal.geometry(), self.nominal.table());
        let nominal = match parameter {
            P::e1 => g.D1 - g.d1,
            P::e2 => g.D2 - g.d2,
            P::R1 => g.R1,
            P::r1 => g.r1,
            P::R2 => g.R2,
            P::r4 => g.r4,
            P::L1 => g.L1,
            P::L2 => g.L2,
            P::L3 => g.L3,
            P::ToolLength => self.tool_length,
            P::da => table.da,
            P::dt => table.dt,
            // A machine has no field for the others.
            _ => 0.0,
        };
        nominal + self.changes[parameter.index()]
    }

    /// What a parameter exceeds its nominal value by.
    ///
    /// # Units
    ///
    /// Millimetres and radians, by [`Parameter::unit`].
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::parameter::{ActualMachine, Parameter};
    ///
    /// let machine = ActualMachine::new(&Machine::verne(), 50.0).with([(Parameter::da, -0.1)]);
    /// assert_eq!(machine.change(Parameter::da), -0.1);
    /// ```
    pub fn change(&self, parameter: Parameter) -> f64 {
        self.changes[parameter.index()]
    }

    /// The machine with the changed geometry, da and dt. A change of e1 is one of D1, a change of e2 one of D2. Zero
    /// offsets, the table's other parameters and the tool's length have no field in a machine.
    ///
    /// # Errors
    ///
    /// What [`Machine::new`] refuses.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::parameter::{ActualMachine, Parameter};
    ///
    /// let machine = ActualMachine::new(&Machine::verne(), 50.0).with([(Parameter::e1, 0.5)]).machine()?;
    /// assert_eq!(machine.data().geometry.D1, 100.5);
    /// # Ok::<(), Vec<verne_solver::MachineError>>(())
    /// ```
    pub fn machine(&self) -> Result<Machine, Vec<MachineError>> {
        let mut data = self.nominal.data().clone();
        data.geometry = self.mechanism.geometry;
        data.table.da = self.value(Parameter::da);
        data.table.dt = self.value(Parameter::dt);
        Machine::new(data)
    }

    /// Finds the platform's pose in the working mode for the positions that the control indicates: the solution that
    /// continues the nominal machine's while the parameters change.
    ///
    /// # Units
    ///
    /// Millimetres and radians; base frame.
    ///
    /// # Errors
    ///
    /// - [`ActualPoseError::Nominal`]: the nominal machine has no posture there.
    /// - [`ActualPoseError::TooFar`]: Newton's method finds none near it.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(6).
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::Machine;
    /// use verne_solver::parameter::{ActualMachine, ActualPoseError, Parameter};
    ///
    /// let machine = ActualMachine::new(&Machine::verne(), 50.0);
    /// let offsets = [Parameter::o1, Parameter::o2, Parameter::o3].map(|offset| (offset, 0.25));
    /// let rho = [674.0, 685.0, 250.0];
    /// let (nominal, actual) = (machine.platform(rho)?, machine.with(offsets).platform(rho)?);
    /// assert!((actual.z - nominal.z - 0.25).abs() < 1e-9);
    /// # Ok::<(), ActualPoseError>(())
    /// ```
    pub fn platform(&self, rho: [f64; 3]) -> Result<PlatformPose, ActualPoseError> {
        let nominal = forward_working(&self.nominal, self.slider_positions(rho))?;
        self.platform_near(&nominal.pose, rho).ok_or(ActualPoseError::TooFar)
    }

    /// Finds the platform's pose for the positions that the control indicates, by Newton's method from a pose near it.
    /// The answer is `None` if it does not converge, or converges beyond a parallel singularity.
    ///
    /// # Units
    ///
    /// Millimetres and radians; base frame.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::parameter::{ActualMachine, Parameter};
    /// use verne_solver::{KinematicsError, Machine, forward_working};
    ///
    /// let rho = [674.0, 685.0, 250.0];
    /// let nominal = forward_working(&Machine::verne(), rho)?.pose;
    /// let machine = ActualMachine::new(&Machine::verne(), 50.0).with([(Parameter::L2, 0.1)]);
    /// let actual = machine.platform_near(&nominal, rho).expect("a tenth of a millimetre");
    /// assert!(actual.x != nominal.x && (actual.x - nominal.x).abs() < 1.0);
    /// # Ok::<(), KinematicsError>(())
    /// ```
    pub fn platform_near(&self, start: &PlatformPose, rho: [f64; 3]) -> Option<PlatformPose> {
        let rho = self.slider_positions(rho);
        let found = closed(&self.mechanism, *start, rho)?;
        let det =
            |pose| determinant(&matrix(&self.mechanism.geometry, &Rods::of(&self.mechanism, pose, rho)));
        let is_solution = found.residual <= RESIDUAL_TOLERANCE * magnitude(&self.mechanism, found.pose.z);
        (is_solution && det(&found.pose) * det(start) > 0.0).then_some(found.pose)
    }

    /// The tool in a frame, for a pose of the platform.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (7), (27).
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::parameter::{ActualMachine, ToolFrame};
    /// use verne_solver::{Machine, PlatformPose};
    ///
    /// let machine = ActualMachine::new(&Machine::verne(), 50.0);
    /// let tool = machine.tool(&PlatformPose { x: 1.0, y: 2.0, z: 1000.0, alpha: 0.0 }, ToolFrame::Machine);
    /// assert_eq!((tool.tip, tool.axis), ([1.0, 2.0, 1050.0], [0.0, 0.0, -1.0]));
    /// ```
    pub fn tool(&self, pose: &PlatformPose, frame: ToolFrame) -> Tool {
        let [tip, axis] = tip_and_axis(pose, self.value(Parameter::ToolLength));
        match frame {
            ToolFrame::Machine => Tool { tip: tip.into(), axis: axis.into() },
            ToolFrame::Part(table) => {
                let frame = self.part_frame(table);
                Tool { tip: frame.point(tip).into(), axis: frame.direction(axis).into() }
            }
        }
    }

    pub(super) fn mechanism(&self) -> &Mechanism {
        &self.mechanism
    }

    pub(super) fn part_frame(&self, table: TableAngles) -> PartFrame {
        PartFrame::new(|parameter| self.value(parameter), table)
    }

    /// z of the sliders for the positions that the control indicates.
    pub(crate) fn slider_positions(&self, [a, b, c]: [f64; 3]) -> [f64; 3] {
        [a + self.value(Parameter::o1), b + self.value(Parameter::o2), c + self.value(Parameter::o3)]
    }

    #[allow(non_snake_case, reason = "the paper's symbols")]
    fn geometry(&self) -> Geometry {
        use Parameter as P;
        let nominal = *self.nominal.geometry();
        let [R1, r1, R2, r4] = [P::R1, P::r1, P::R2, P::r4].map(|parameter| self.value(parameter));
        let [L1, L2, L3] = [P::L1, P::L2, P::L3].map(|parameter| self.value(parameter));
        let (D1, D2) = (nominal.D1 + self.change(P::e1), nominal.D2 + self.change(P::e2));
        Geometry { D1, D2, R1, r1, R2, r4, L1, L2, L3, ..nominal }
    }
}
