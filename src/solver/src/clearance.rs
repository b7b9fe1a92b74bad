//! The table as a limit: the tool's end and the platform's joints stay above its plane.
//!
//! The plane is Z = 0 of the part frame. By Eqs (7) and (26) a point (x, y, z) of the base frame is at
//! the height
//!
//! ```text
//! Z = dt + y sin theta1 - (z - da) cos theta1
//! ```
//!
//! over it. A platform joint at (X, Y, 0) of the platform frame is therefore Y sin phi1 lower than P,
//! where phi1 = a - theta1, and P is `tool_length` cos phi1 higher than the tool centre point. The tool's
//! end is a circle perpendicular to its axis; its lowest point is `tool_radius` |sin phi1| lower than the
//! centre. All these differences depend on phi1 alone: for a fixed orientation of the tool, the limit
//! is one plane Z = const for the tool centre point.

use crate::fast_math::sin_cos;
use crate::limit::{Constraint, Element, Margin};
use crate::machine::Machine;
use crate::pose::{PlatformPose, TableAngles};
use crate::table::part_pose;

/// A tool, and the least height of its end and of the platform's joints over the table's plane. Lengths are
/// millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// The least height.
    pub least: f64,
    /// Length of the tool, from P to the centre of its end.
    pub tool_length: f64,
    /// Radius of the tool's end.
    pub tool_radius: f64,
}

impl Clearance {
    /// Takes the least height `requested` by the caller, or else the machine's. The answer is `None` if neither is
    /// given: the table is then no limit.
    ///
    /// # Units
    ///
    /// Millimetres.
    ///
    /// # References
    ///
    /// Kanaan, Wenger, Chablat 2007, [arXiv:0707.3507](https://arxiv.org/abs/0707.3507): the height follows from Eqs
    /// (7) and (26); the limit itself is not in the paper.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::{Clearance, Machine};
    ///
    /// let machine = Machine::verne();
    /// assert!(Clearance::of(&machine, None, 150.0, 5.0).is_none());
    /// let clearance = Clearance::of(&machine, Some(2.0), 150.0, 5.0);
    /// assert_eq!(clearance.map(|clearance| clearance.least), Some(2.0));
    /// ```
    pub fn of(machine: &Machine, requested: Option<f64>, tool_length: f64, tool_radius: f64) -> Option<Self> {
        let least = requested.or(machine.limits().table_clearance)?;
        Some(Self { least, tool_length, tool_radius })
    }

    /// The margin of the lowest point.
    #[inline]
    pub(crate) fn margin(&self, machine: &Machine, pose: &PlatformPose, table: TableAngles) -> Margin {
        let tool = part_pose(machine, pose, table, self.tool_length);
        let (depth, element) = self.depth(machine, tool.phi1);
        Margin { constraint: Constraint::TableClearance, element, value: tool.z - depth - self.least }
    }

    /// The distance of the lowest of tool and joints below the tool centre point at an inclination, mm, and which of
    /// them it is. The two joints of a parallelogram are equally high; the first represents both.
    #[inline]
    pub(crate) fn depth(&self, machine: &Machine, phi1: f64) -> (f64, Element) {
        let g = machine.geometry();
        let (s, c) = sin_cos(phi1);
        let to_platform = self.tool_length * c;
        let joints = [(11, g.R1 * s), (12, -g.R1 * s), (21, -g.R2 * s), (31, g.R2 * s)];
        let mut lowest = (self.tool_radius * s.abs(), Element::Tool);
        for (rod, below_platform) in joints {
            let depth = below_platform - to_platform;
            if depth > lowest.0 {
                lowest = (depth, Element::Joint(rod));
            }
        }
        lowest
    }
}
