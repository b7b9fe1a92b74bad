//! The errors at one point of a workspace.

use super::request::ErrorMapRequest;
use crate::clearance::Clearance;
use crate::error_budget::{ErrorBudget, Tolerances};
use crate::inverse::platform_working;
use crate::machine::Machine;
use crate::parameter::{Parameter, ToolFrame};
use crate::pose::Point;
use crate::posture::{Posture, Postures};
use crate::table::table_angles;
use crate::workspace::contains::{every_working, margins};
use crate::workspace::request::{Kind, Request};

/// An error of the tool, to the first order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ErrorKind {
    /// Root of the mean square displacement of the tool's end, mm.
    TipRms,
    /// Greatest displacement of the tool's end, mm.
    TipWorst,
    /// Root of the mean square angle of the tool's axis, rad.
    AxisRms,
    /// Greatest angle of the tool's axis, rad.
    AxisWorst,
}

impl ErrorKind {
    /// All of them, in the order of [`PointErrors`].
    pub const ALL: [Self; 4] = [Self::TipRms, Self::TipWorst, Self::AxisRms, Self::AxisWorst];
}

/// The errors at a point, by [`ErrorKind`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointErrors(pub [f64; 4]);

impl PointErrors {
    /// One of the errors.
    ///
    /// # Units
    ///
    /// Millimetres or radians, by the kind.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::workspace::error_map::{ErrorKind, PointErrors};
    ///
    /// assert_eq!(PointErrors([0.01, 0.03, 1e-5, 2e-5]).of(ErrorKind::TipWorst), 0.03);
    /// ```
    pub fn of(&self, kind: ErrorKind) -> f64 {
        self.0[kind as usize]
    }

    /// The greater of both, each figure by itself.
    fn greater(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i].max(other.0[i])))
    }
}

/// Computes the errors at a point, in the frame of the workspace's kind. If several solutions keep every limit there,
/// each figure is the greatest of them. The answer is `None` outside the workspace, and at a parallel singularity,
/// where errors have no bound.
///
/// # Units
///
/// Millimetres and radians.
///
/// # Examples
///
/// ```
/// use verne_solver::Machine;
/// use verne_solver::error_budget::{ToleranceError, Tolerances};
/// use verne_solver::parameter::Parameter;
/// use verne_solver::workspace::error_map::{ErrorKind, ErrorMapRequest, errors_at};
/// use verne_solver::workspace::{Kind, Request};
///
/// let tolerances = Tolerances::new([(Parameter::da, 0.25)])?;
/// let workspace = Request { tool_length: 50.0, ..Request::new(Kind::Part, 5.0) };
/// let request = ErrorMapRequest { workspace, tolerances, cell: 50.0 };
/// let errors = errors_at(&Machine::verne(), &request, [0.0, 0.0, 400.0]).expect("inside");
/// assert!((errors.of(ErrorKind::TipWorst) - 0.25).abs() < 1e-12, "the table is off by as much");
/// assert_eq!(errors_at(&Machine::verne(), &request, [0.0, 0.0, 9000.0]), None);
/// # Ok::<(), ToleranceError>(())
/// ```
pub fn errors_at(machine: &Machine, request: &ErrorMapRequest, point: Point) -> Option<PointErrors> {
    Evaluation::new(machine, request).inside(point)
}

/// What all points of a map share.
pub(super) struct Evaluation<'a> {
    machine: &'a Machine,
    request: Request,
    tolerances: Tolerances,
    clearance: Option<Clearance>,
}

impl<'a> Evaluation<'a> {
    pub(super) fn new(machine: &'a Machine, request: &ErrorMapRequest) -> Self {
        let ErrorMapRequest { mut workspace, mut tolerances, .. } = *request;
        if workspace.kind == Kind::Platform {
            workspace.tool_length = 0.0;
            tolerances = tolerances.without(Parameter::ToolLength);
        }
        Self { machine, request: workspace, tolerances, clearance: workspace.clearance(machine) }
    }

    /// The errors at a point of the workspace; `None` outside.
    pub(super) fn inside(&self, point: Point) -> Option<PointErrors> {
        let postures = self.postures(point);
        let feasible = postures.iter().filter(|posture| self.least_fraction(posture) >= 0.0);
        feasible.filter_map(|posture| self.errors(posture)).reduce(PointErrors::greater)
    }

    /// The errors at a point on the boundary of the workspace, which rounding may put outside: those of the solution
    /// with the best margin.
    pub(super) fn on_boundary(&self, point: Point) -> Option<PointErrors> {
        let postures = self.postures(point);
        let fractions = postures.iter().map(|posture| (posture, self.least_fraction(posture)));
        let (best, _) = fractions.max_by(|(_, a), (_, b)| a.total_cmp(b))?;
        self.errors(best)
    }

    fn postures(&self, point: Point) -> Postures {
        match self.request.kind {
            Kind::Platform => platform_working(self.machine, point).ok().into_iter().collect(),
            Kind::Tool | Kind::Part => every_working(self.machine, &self.request, point),
        }
    }

    /// The worst margin as a fraction of its range.
    fn least_fraction(&self, posture: &Posture) -> f64 {
        let margins = margins(self.machine, &self.request, self.clearance.as_ref(), posture);
        margins.worst_with_fraction(self.machine).1
    }

    fn errors(&self, posture: &Posture) -> Option<PointErrors> {
        let Request { kind, tool_length, phi1, phi2, .. } = self.request;
        let frame = match kind {
            Kind::Platform | Kind::Tool => ToolFrame::Machine,
            Kind::Part => ToolFrame::Part(table_angles(self.machine, posture.pose.alpha, phi1, phi2)),
        };
        let budget = ErrorBudget::of(self.machine, posture, tool_length, frame, &self.tolerances)?;
        Some(PointErrors([budget.tip.rms, budget.tip.worst, budget.axis.rms, budget.axis.worst]))
    }
}
