//! Where the machine stands before a program.

use std::f64::consts::TAU;

use super::azimuth::to_nearest;
use super::motion::{Motion, MotionKind, Motions, Standstill, ToolPosition, Turning};
use super::node::Node;
use crate::error::KinematicsError;
use crate::forward::forward_working;
use crate::machine::Machine;
use crate::pose::TableAngles;

/// Where the machine stands before a program: its joints, in the working mode.
#[derive(Clone, Copy, Debug)]
pub struct Start(Node);

impl PartialEq for Start {
    fn eq(&self, other: &Self) -> bool {
        (self.0.rho, self.0.table) == (other.0.rho, other.0.table)
    }
}

impl Start {
    /// The start with these sliders and this table. Limits are not checked: [`plan`](super::plan) does so.
    ///
    /// # Units
    ///
    /// Millimetres and radians.
    ///
    /// # Errors
    ///
    /// Those of [`forward_working`]: the sliders leave the platform no place in the working mode.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::toolpath::Start;
    /// use verne_solver::{Machine, TableAngles};
    ///
    /// let table = TableAngles { theta1: 0.0, theta2: 1.0 };
    /// assert!(Start::new(&Machine::verne(), [600.0, 500.0, 500.0], table).is_ok());
    /// assert!(Start::new(&Machine::verne(), [1500.0, 0.0, 0.0], table).is_err());
    /// ```
    pub fn new(machine: &Machine, rho: [f64; 3], table: TableAngles) -> Result<Self, KinematicsError> {
        let posture = forward_working(machine, rho)?;
        Ok(Self(Node::new(posture.pose, rho, table)))
    }

    pub(super) fn node(&self) -> Node {
        self.0
    }

    pub(super) fn position(&self, machine: &Machine, tool_length: f64) -> ToolPosition {
        let [tip, axis] = self.0.tool(machine, tool_length).position();
        ToolPosition { tip: tip.into(), axis: axis.into() }
    }
}

/// A program whose first motion begins where the machine stands, as a rapid, if this is known.
pub(super) struct Started<'a, M: ?Sized> {
    motions: &'a M,
    start: Option<Start>,
}

impl<'a, M: Motions + ?Sized> Started<'a, M> {
    pub(super) fn new(motions: &'a M, start: Option<Start>) -> Self {
        Self { motions, start: start.filter(|_| motions.count() > 0) }
    }

    /// Where the machine stands before the first motion, with its tool, and phi2 there.
    pub(super) fn standstill(&self, machine: &Machine) -> (Standstill, Option<f64>) {
        let Some(start) = self.start else { return Default::default() };
        let tool_length = self.motions.motion(0).tool_length;
        let at = start.position(machine, tool_length);
        (Standstill(Some((at, tool_length))), Some(-start.0.table.theta2))
    }
}

impl<M: Motions + ?Sized> Motions for Started<'_, M> {
    fn count(&self) -> usize {
        self.motions.count()
    }

    fn motion(&self, index: usize) -> Motion {
        let motion = self.motions.motion(index);
        match self.start {
            Some(start) if index == 0 => begun(&motion, &start.0),
            _ => motion,
        }
    }
}

/// The first motion as a rapid from the machine's joints.
fn begun(motion: &Motion, from: &Node) -> Motion {
    let turning = match motion.turning {
        Turning::Held { end, .. } => {
            let start = [from.pose.alpha - from.table.theta1, -from.table.theta2];
            let nearest = |i: usize| start[i] + to_nearest(end[i] - start[i], TAU);
            Turning::Held { start, end: [nearest(0), nearest(1)] }
        }
        Turning::GreatCircle | Turning::Angles { .. } => Turning::GreatCircle,
    };
    Motion { kind: MotionKind::Rapid, turning, ..*motion }
}
