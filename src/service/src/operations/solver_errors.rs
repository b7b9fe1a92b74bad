//! The solver's errors in the terms of a request: which field is wrong, and what is accepted.

use verne_solver::toolpath::PlanError;
use verne_solver::workspace::WorkspaceError;

use crate::wire::error::{FieldError, OperationError};

/// Most points of a map's grid: the intervals of a dexterity map are a file of some 50 MB then.
pub(crate) const MAX_GRID_POINTS: usize = 2_000_000;

/// Maps an error of the solver's workspace functions to the field that caused it.
pub(crate) fn workspace_error(error: WorkspaceError) -> OperationError {
    let (pointer, detail) = match error {
        WorkspaceError::OutOfDomain { field } => (format!("/{field}"), "is out of range".to_owned()),
        WorkspaceError::TooFine => tolerance("would need more vertices than a mesh can index"),
        WorkspaceError::TooManyTriangles { most } => {
            tolerance(format!("makes more triangles than the limit of {most}"))
        }
        WorkspaceError::TooManyNodes { nodes } => return too_many_grid_points(nodes),
        WorkspaceError::TooManyIntervals { .. } => {
            let detail = "reaches a point in more than 255 intervals; state a narrower range";
            ("/phi1".to_owned(), detail.to_owned())
        }
        WorkspaceError::Open => tolerance(
            "gives a surface that the service cannot close for this machine; try a finer or coarser tolerance",
        ),
        WorkspaceError::Disagreement => return OperationError::Internal,
        WorkspaceError::Cancelled => return OperationError::Cancelled,
    };
    OperationError::Fields(vec![FieldError::new(pointer, detail)])
}

/// Maps an error of the planner to the field that caused it.
pub(crate) fn plan_error(error: PlanError) -> OperationError {
    match error {
        PlanError::Cancelled => OperationError::Cancelled,
        PlanError::TooManyRows => {
            OperationError::Fields(vec![FieldError::new("/tolerance", error.to_string())])
        }
    }
}

fn tolerance(detail: impl Into<String>) -> (String, String) {
    ("/tolerance".to_owned(), detail.into())
}

/// The error for a map whose grid has too many points.
pub(crate) fn too_many_grid_points(points: impl std::fmt::Display) -> OperationError {
    let detail = format!("makes a grid of {points} points; the limit is {MAX_GRID_POINTS}");
    OperationError::Fields(vec![FieldError::new("/cell", detail)])
}
