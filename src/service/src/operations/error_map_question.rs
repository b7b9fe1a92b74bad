//! A checked question about the errors of the tool over a workspace.

use std::sync::Arc;

use verne_solver::workspace::error_map::ErrorMapRequest;
use verne_solver::workspace::{Observer, Request};

use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::operations::workspace_question::{WorkspaceQuestion, check_triangles, workspace_cost};
use crate::wire::error::OperationError;
use crate::wire::error_map::{CanonicalErrorMap, ErrorMapBody};
use crate::wire::field_errors::FieldErrors;
use crate::wire::result_id::ResultId;
use crate::wire::sweep::Sweep;
use crate::wire::workspace::WorkspaceRequest;

/// About the seconds that the budget of a point takes.
const POINT_COST: f64 = 2e-4;

/// About the part of the box over the machine's width and stroke that a workspace fills.
const FILLED: f64 = 0.3;

/// Vertices for each triangle of a closed mesh.
const VERTICES: f64 = 0.5;

/// Begins the hash of every map. It changes when the bytes of the answer to the same question change.
const HASH_PREFIX: &[u8] = b"verne error map 1";

/// A question about errors over a workspace that has an answer.
#[derive(Clone, Debug)]
pub(crate) struct ErrorMapQuestion {
    /// The machine.
    pub machine: Arc<IdentifiedMachine>,
    /// The request with its default values.
    pub request: CanonicalErrorMap,
    /// The id of the answer.
    pub id: ResultId,
}

impl ErrorMapQuestion {
    /// Checks a request.
    pub(crate) fn new(request: &ErrorMapBody, machines: &MachineRegistry) -> Result<Self, OperationError> {
        let mut faults = FieldErrors::default();
        faults.cell(request.cell);
        request.parameter_tolerances.check("/parameter_tolerances", &mut faults);
        let workspace = match WorkspaceQuestion::new(&workspace(request), machines) {
            Ok(workspace) => {
                faults.into_result()?;
                workspace
            }
            Err(OperationError::Fields(others)) => {
                for fault in others {
                    faults.add(fault.pointer, fault.detail);
                }
                return Err(faults.into_result().err().unwrap_or(OperationError::Internal));
            }
            Err(error) => return Err(error),
        };
        let request = CanonicalErrorMap {
            workspace: workspace.request,
            parameter_tolerances: request.parameter_tolerances.canonical(),
            cell: request.cell,
        };
        Ok(Self::of(workspace.machine, &request))
    }

    /// The question of a checked request.
    pub(crate) fn of(machine: Arc<IdentifiedMachine>, request: &CanonicalErrorMap) -> Self {
        // The workspace's own id stands for its numbers and the machine.
        let workspace = WorkspaceQuestion::of(Arc::clone(&machine), request.workspace).id;
        let mut hasher = ResultId::hasher(HASH_PREFIX);
        hasher.update(workspace.job().as_bytes()).update(&request.cell.to_le_bytes());
        for (parameter, tolerance) in request.parameter_tolerances.each() {
            hasher.update(blake3::hash(parameter.name().as_bytes()).as_bytes());
            hasher.update(&tolerance.to_le_bytes());
        }
        Self { machine, request: *request, id: hasher.finalize().into() }
    }

    /// The request for the solver.
    pub(crate) fn solver_request(&self) -> Result<ErrorMapRequest, OperationError> {
        Ok(ErrorMapRequest {
            workspace: Request::from(&self.request.workspace),
            tolerances: self.request.parameter_tolerances.to_solver()?,
            cell: self.request.cell,
        })
    }

    /// Estimated work, seconds of one core. It takes some milliseconds: call it on the compute pool.
    ///
    /// # Errors
    ///
    /// The mesh is likely to have more than `max_triangles` triangles.
    pub(crate) fn cost(&self, max_triangles: u64, observer: &dyn Observer) -> Result<f64, OperationError> {
        let workspace = WorkspaceQuestion::of(Arc::clone(&self.machine), self.request.workspace);
        let triangles = workspace.triangles(observer)?;
        check_triangles(triangles, max_triangles)?;
        Ok(self.grid_cost() + workspace_cost(triangles) + POINT_COST * VERTICES * triangles)
    }

    /// Estimated work for the points of the grid, seconds of one core.
    pub(crate) fn grid_cost(&self) -> f64 {
        let strokes = self.machine.data().limits.stroke;
        let stroke = strokes.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
        let wide = self.machine.longest();
        POINT_COST * FILLED * wide * wide * stroke / self.request.cell.powi(3)
    }
}

/// The request for the workspace.
fn workspace(request: &ErrorMapBody) -> WorkspaceRequest {
    WorkspaceRequest {
        machine: request.machine.clone(),
        kind: request.kind,
        tool_length: Sweep::One(request.tool_length),
        table_clearance: request.table_clearance,
        tool_radius: request.tool_radius,
        phi1: Sweep::One(request.phi1),
        phi2: Sweep::One(request.phi2),
        tolerance: request.tolerance,
    }
}
