//! The error budget of one posture.

use nalgebra::Vector3;

use super::farthest_vertex::farthest_vertex;
use super::tolerances::Tolerances;
use crate::machine::Machine;
use crate::parameter::{ActualMachine, PARAMETERS, Parameter, Tool, ToolFrame};
use crate::posture::Posture;

/// The error of the tool's end, mm, or of its axis, rad, to the first order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorFigure {
    /// Standard deviations of the coordinates in the budget's frame, for independent parameters whose standard
    /// deviations are the tolerances.
    pub standard_deviations: [f64; 3],
    /// The root of the mean square of the error's magnitude, for the same parameters.
    pub rms: f64,
    /// The greatest magnitude with every parameter within its tolerance.
    pub worst: f64,
    /// Changes of the parameters with which it is attained, in the order of [`Parameter::ALL`]. The opposite changes
    /// are as bad.
    pub worst_changes: [f64; PARAMETERS],
    /// The magnitude with each parameter alone off by its tolerance, in the order of [`Parameter::ALL`].
    pub contributions: [f64; PARAMETERS],
}

/// The displacement of a tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Displacement {
    /// Distance of the tool's end, mm.
    pub tip: f64,
    /// Angle of the tool's axis, rad.
    pub axis: f64,
}

/// The error budget of a posture with a tool.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorBudget {
    nominal: ActualMachine,
    posture: Posture,
    frame: ToolFrame,
    /// The error of the tool's end, mm.
    pub tip: ErrorFigure,
    /// The error of the tool's axis, rad.
    pub axis: ErrorFigure,
}

impl ErrorFigure {
    /// The figures of these derivatives by each parameter.
    fn new(rates: &[[f64; 3]; PARAMETERS], tolerances: &Tolerances) -> Self {
        let each = tolerances.values();
        let segments: [Vector3<f64>; PARAMETERS] = std::array::from_fn(|i| Vector3::from(rates[i]) * each[i]);
        let signs = farthest_vertex(&segments);
        let worst: Vector3<f64> = segments.iter().zip(signs).map(|(segment, sign)| segment * sign).sum();
        let root = |squares: f64| squares.sqrt();
        Self {
            standard_deviations: std::array::from_fn(|axis| {
                root(segments.iter().map(|segment| segment[axis] * segment[axis]).sum())
            }),
            rms: root(segments.iter().map(Vector3::norm_squared).sum()),
            worst: worst.norm(),
            worst_changes: std::array::from_fn(|i| signs[i] * each[i]),
            contributions: segments.map(|segment| segment.norm()),
        }
    }
}

impl ErrorBudget {
    /// Computes the budget of a posture, for a tool of length `tool_length` from P, in the machine's or the part frame.
    /// The answer is `None` at a parallel singularity, where errors have no bound.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): Eqs (3)-(7), (27),
    /// differentiated.
    /// Ziegler, Lectures on Polytopes,
    /// [doi:10.1007/978-1-4613-8431-1](https://doi.org/10.1007/978-1-4613-8431-1): section 7.3, zonotopes.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::error_budget::{ErrorBudget, Tolerances};
    /// use verne_solver::parameter::{Parameter, ToolFrame};
    /// use verne_solver::{Machine, forward_working};
    ///
    /// let machine = Machine::verne();
    /// let posture = forward_working(&machine, [600.0, 500.0, 500.0])?;
    /// let tolerances = Tolerances::new([Parameter::o1, Parameter::o2, Parameter::o3].map(|p| (p, 0.01)))?;
    /// let frame = ToolFrame::Machine;
    /// let budget = ErrorBudget::of(&machine, &posture, 50.0, frame, &tolerances).expect("not singular");
    /// assert!(budget.tip.worst >= 0.01, "equal offsets alone move the tool by 0.01 mm");
    /// assert!(budget.tip.rms <= budget.tip.worst);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(
        machine: &Machine,
        posture: &Posture,
        tool_length: f64,
        frame: ToolFrame,
        tolerances: &Tolerances,
    ) -> Option<Self> {
        let nominal = ActualMachine::new(machine, tool_length);
        let rates = nominal.tool_rates(&posture.pose, posture.rho, frame)?;
        let [tip, axis] = [&rates.tip, &rates.axis].map(|rates| ErrorFigure::new(rates, tolerances));
        Some(Self { nominal, posture: *posture, frame, tip, axis })
    }

    /// Computes the displacement of the tool by these changes of the parameters in the exact model, while the joints
    /// stand still; of them and the opposite changes the greater displacement of the end, and the greater of the axis.
    /// The answer is `None` if no posture is near with the changes.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::error_budget::{ErrorBudget, Tolerances};
    /// use verne_solver::parameter::{Parameter, ToolFrame};
    /// use verne_solver::{Machine, forward_working};
    ///
    /// let machine = Machine::verne();
    /// let posture = forward_working(&machine, [600.0, 500.0, 500.0])?;
    /// let tolerances = Tolerances::new([(Parameter::L1, 0.01), (Parameter::r4, 0.02)])?;
    /// let frame = ToolFrame::Machine;
    /// let budget = ErrorBudget::of(&machine, &posture, 50.0, frame, &tolerances).expect("not singular");
    /// let exact = budget.exact(&budget.tip.worst_changes).expect("small changes");
    /// assert!((exact.tip / budget.tip.worst - 1.0).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn exact(&self, changes: &[f64; PARAMETERS]) -> Option<Displacement> {
        let nominal = self.nominal.tool(&self.posture.pose, self.frame);
        let displaced = |sense: f64| {
            let changes = Parameter::ALL.into_iter().zip(changes.map(|change| sense * change));
            let machine = self.nominal.with(changes);
            let pose = machine.platform_near(&self.posture.pose, self.posture.rho)?;
            Some(displacement(&nominal, &machine.tool(&pose, self.frame)))
        };
        let (one, other) = (displaced(1.0)?, displaced(-1.0)?);
        Some(Displacement { tip: one.tip.max(other.tip), axis: one.axis.max(other.axis) })
    }
}

fn displacement(from: &Tool, to: &Tool) -> Displacement {
    let [a, b] = [from.axis, to.axis].map(Vector3::from);
    Displacement {
        tip: (Vector3::from(to.tip) - Vector3::from(from.tip)).norm(),
        axis: a.cross(&b).norm().atan2(a.dot(&b)),
    }
}
