//! The question: which workspace, of which tool, how exactly.

use std::fmt;

use crate::clearance::Clearance;
use crate::limit::DOMAIN;
use crate::machine::Machine;

/// Whose positions the workspace is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// The platform's origin P in the base frame (Fig. 7).
    Platform,
    /// The tool centre point U in the base frame (Eq (27)).
    Tool,
    /// The tool centre point U in the table frame, for a fixed tool orientation (Eq (26)); with
    /// phi1 = phi2 = 0 the manufacturing workspace (Fig. 8).
    Part,
}

/// One workspace. Lengths in mm, angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// Whose positions.
    pub kind: Kind,
    /// Tool length from P; without effect on [`Kind::Platform`].
    pub tool_length: f64,
    /// Inclination of the tool in the table frame; only [`Kind::Part`] depends on it.
    pub phi1: f64,
    /// Azimuth of the tool in the table frame; only [`Kind::Part`] depends on it.
    pub phi2: f64,
    /// Least height of the tool's end and the platform's joints over the table's plane; `None`: the
    /// machine's own, if it has one. Only [`Kind::Part`] depends on it: the height depends on theta1,
    /// which the other kinds leave open.
    pub table_clearance: Option<f64>,
    /// Radius of the tool's end, for the height over the table.
    pub tool_radius: f64,
    /// Greatest distance between a mesh or a slice and the true surface, both ways.
    pub tolerance: f64,
}

/// Finest tolerance, mm: below it vertices are no longer distinct in single precision files.
pub(super) const FINEST: f64 = 1e-3;

/// Why a workspace was not computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WorkspaceError {
    /// A number is not finite, beyond [`DOMAIN`] or, for the tolerance, below 0.001 mm.
    OutOfDomain {
        /// The request's field.
        field: &'static str,
    },
    /// The observer asked for the end.
    Cancelled,
    /// The tolerance asks for more vertices than 32 bits can number.
    TooFine,
    /// The surface has more triangles than it may.
    TooManyTriangles {
        /// How many it may have.
        most: usize,
    },
    /// A grid would have more nodes than [`MOST_NODES`](super::dexterity::MOST_NODES).
    TooManyNodes {
        /// Their number.
        nodes: f64,
    },
    /// The volume and the surface of one workspace disagree by more than their errors: a fault of
    /// the computation.
    Disagreement,
    /// The surface or the slice could not be closed: nothing is answered rather than a mesh with
    /// a gap.
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
            Self::Disagreement => write!(f, "the volume and the surface disagree"),
            Self::Open => write!(f, "the surface could not be closed at this tolerance"),
        }
    }
}

impl std::error::Error for WorkspaceError {}

impl Request {
    /// The clearance over the table that is checked.
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
            if number.is_nan() || number.abs() > DOMAIN {
                return Err(WorkspaceError::OutOfDomain { field });
            }
        }
        if (FINEST..=DOMAIN).contains(&self.tolerance) {
            Ok(())
        } else {
            Err(WorkspaceError::OutOfDomain { field: "tolerance" })
        }
    }
}
