//! The request of a workspace: which positions, of which tool, within which tolerance; and the errors.

use std::fmt;

use crate::clearance::Clearance;
use crate::machine::Machine;
use crate::request_range::MAX_INPUT;

/// The reference point and the frame of a workspace.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// The platform's reference point P in the base frame (Fig. 7).
    Platform,
    /// The tool centre point U in the base frame (Eq (27)).
    Tool,
    /// The tool centre point U in the part frame, for a fixed tool orientation (Eq (26)). With phi1 = phi2 = 0 it is
    /// the paper's manufacturing workspace (Fig. 8).
    Part,
}

/// The request of one workspace. Lengths are millimetres, angles radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// The reference point and the frame.
    pub kind: Kind,
    /// Tool length, measured from P. It does not affect [`Kind::Platform`].
    pub tool_length: f64,
    /// Inclination of the tool in the part frame. It affects only [`Kind::Part`].
    pub phi1: f64,
    /// Azimuth of the tool in the part frame. It affects only [`Kind::Part`].
    pub phi2: f64,
    /// Least height of the tool's end and of the platform's joints over the table's plane. `None` means the machine's
    /// own value, if it has one. It affects only [`Kind::Part`]: the height depends on theta1, which the other kinds
    /// leave open.
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, for the height over the table's plane.
    pub tool_radius: f64,
    /// Greatest distance between a surface or a slice and the true boundary, in both directions.
    pub tolerance: f64,
}

/// Least tolerance, mm. Below it vertices are no longer distinct in single-precision files.
pub(super) const FINEST: f64 = 1e-3;

/// The reason why a workspace was not computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WorkspaceError {
    /// A number is not finite, is beyond [`MAX_INPUT`] or, if it is the tolerance, is below 0.001 mm.
    OutOfDomain {
        /// The request's field.
        field: &'static str,
    },
    /// The observer asked the computation to stop.
    Cancelled,
    /// The tolerance needs more vertices than 32 bits can number.
    TooFine,
    /// The surface has more triangles than the caller allows.
    TooManyTriangles {
        /// The number that the caller allows.
        most: usize,
    },
    /// A grid would have more nodes than [`MOST_NODES`](super::dexterity::MOST_NODES).
    TooManyNodes {
        /// Their number.
        nodes: f64,
    },
    /// A node of a grid is reached in more than 255 intervals of phi1.
    TooManyIntervals {
        /// Their number.
        intervals: usize,
    },
    /// The volume and the surface of a workspace differ by more than their errors: one computation is wrong.
    Disagreement,
    /// The surface or the slice could not be closed. The function does not return a mesh with a gap.
    Open,
}

impl fmt::Display for WorkspaceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfDomain { field } => write!(f, "{field} is out of range"),
            Self::Cancelled => write!(f, "cancelled"),
            Self::TooFine => write!(f, "the tolerance needs more vertices than can be numbered"),
            Self::TooManyTriangles { most } => write!(f, "the surface has more than {most} triangles"),
            Self::TooManyNodes { nodes } => write!(f, "the grid would have {nodes} nodes"),
            Self::TooManyIntervals { intervals } => {
                write!(f, "a node of the grid is reached in {intervals} intervals of phi1, more than 255")
            }
            Self::Disagreement => write!(f, "the volume and the surface disagree"),
            Self::Open => write!(f, "the surface could not be closed at this tolerance"),
        }
    }
}

impl std::error::Error for WorkspaceError {}

impl Request {
    /// A request without a tool: its length, its radius and the angles phi1 and phi2 are zero.
    ///
    /// # Units
    ///
    /// The tolerance is in mm.
    ///
    /// # Examples
    ///
    /// ```
    /// use verne_solver::workspace::{Kind, Request};
    ///
    /// let request = Request { tool_length: 150.0, ..Request::new(Kind::Tool, 0.5) };
    /// assert_eq!((request.phi1, request.table_clearance), (0.0, None));
    /// ```
    pub const fn new(kind: Kind, tolerance: f64) -> Self {
        let (tool_length, phi1, phi2, tool_radius) = (0.0, 0.0, 0.0, 0.0);
        Self { kind, tool_length, phi1, phi2, table_clearance: None, tool_radius, tolerance }
    }

    /// The least height over the table's plane, if it is a limit of this request.
    pub(super) fn clearance(&self, machine: &Machine) -> Option<Clearance> {
        let part = self.kind == Kind::Part;
        Clearance::of(machine, self.table_clearance, self.tool_length, self.tool_radius).filter(|_| part)
    }

    pub(super) fn check(&self) -> Result<(), WorkspaceError> {
        let numbers = [
            ("tool_length", self.tool_length),
            ("phi1", self.phi1),
            ("phi2", self.phi2),
            ("table_clearance", self.table_clearance.unwrap_or_default()),
            ("tool_radius", self.tool_radius),
        ];
        for (field, number) in numbers {
            if number.is_nan() || number.abs() > MAX_INPUT {
                return Err(WorkspaceError::OutOfDomain { field });
            }
        }
        if (FINEST..=MAX_INPUT).contains(&self.tolerance) {
            Ok(())
        } else {
            Err(WorkspaceError::OutOfDomain { field: "tolerance" })
        }
    }
}
