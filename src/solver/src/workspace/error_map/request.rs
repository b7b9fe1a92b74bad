//! The request of an error map.

use crate::error_budget::Tolerances;
use crate::request_range::MAX_INPUT;
use crate::workspace::request::{Request, WorkspaceError};

/// Least step of a grid, mm.
const FINEST_CELL: f64 = 0.1;

/// The request of an error map. Lengths are millimetres, angles radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorMapRequest {
    /// The workspace, and the tolerance of its surface.
    pub workspace: Request,
    /// The tolerances of the machine's parameters. That of the tool's length does not affect
    /// [`Kind::Platform`](crate::workspace::Kind::Platform).
    pub tolerances: Tolerances,
    /// Step of the grid.
    pub cell: f64,
}

impl ErrorMapRequest {
    pub(super) fn check(&self) -> Result<(), WorkspaceError> {
        self.workspace.check()?;
        if (FINEST_CELL..=MAX_INPUT).contains(&self.cell) {
            Ok(())
        } else {
            Err(WorkspaceError::OutOfDomain { field: "cell" })
        }
    }
}
