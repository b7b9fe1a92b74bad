//! A checked question about a workspace, and the checks of the requests for workspaces.

use std::sync::Arc;

use verne_solver::workspace::{Observer, Request, expected_triangles};

use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::operations::solver_errors::workspace_error;
use crate::wire::error::{FieldError, OperationError};
use crate::wire::family::CanonicalFamily;
use crate::wire::field_errors::{FieldErrors, is_angle, is_tool_length};
use crate::wire::result_id::ResultId;
use crate::wire::sweep::Sweep;
use crate::wire::workspace::{CanonicalWorkspace, KindName, WorkspaceRequest};

/// Finest and coarsest tolerance, mm. At the finest, the reference machine's mesh has some 350,000 triangles.
const TOLERANCES: [f64; 2] = [0.01, 1000.0];

/// Finest tolerance as a fraction of the machine's longest dimension. It limits any machine's mesh to a few million
/// triangles.
const FINEST_FRACTION: f64 = 1e-6;

/// Most workspaces in a family.
const MAX_MEMBERS: usize = 1000;

/// About the seconds of one core that a volume takes.
const VOLUME_COST: f64 = 0.015;

/// About the seconds of one core that a triangle takes.
const TRIANGLE_COST: f64 = 4e-6;

/// Begins the hash of every workspace. It changes when the bytes of the answer to the same question change.
const HASH_PREFIX: &[u8] = b"verne workspace 3";

/// A question about a workspace that has an answer.
#[derive(Clone, Debug)]
pub(crate) struct WorkspaceQuestion {
    /// The machine.
    pub machine: Arc<IdentifiedMachine>,
    /// The request with its default values.
    pub request: CanonicalWorkspace,
    /// The id of the answer.
    pub id: ResultId,
}

/// Checks a request for one workspace or a family.
///
/// # Errors
///
/// All fields that cannot be used.
pub(crate) fn check_workspaces(
    request: &WorkspaceRequest,
    machines: &MachineRegistry,
) -> Result<(Arc<IdentifiedMachine>, CanonicalFamily), OperationError> {
    let kind = request.kind;
    let (tool, part) = (kind != KindName::Platform, kind == KindName::Part);
    let mut faults = FieldErrors::default();
    let mut numbers = |pointer, sweep, effective| sweep_numbers(pointer, sweep, effective, kind, &mut faults);
    let tool_length = numbers("/tool_length", &request.tool_length, tool);
    let phi1 = numbers("/phi1", &request.phi1, part);
    let phi2 = numbers("/phi2", &request.phi2, part);
    if let Some(&length) = tool_length.iter().find(|length| !is_tool_length(**length)) {
        faults.tool_length(length);
    }
    faults.clearance(request.table_clearance, request.tool_radius, kind.without_tilt());
    for (pointer, angles) in [("/phi1", &phi1), ("/phi2", &phi2)] {
        faults.angle(pointer, angles.iter().copied().find(|angle| !is_angle(*angle)));
    }
    let machine = machines.resolve(&request.machine);
    check_tolerance(request.tolerance, machine.as_deref().ok(), &mut faults);
    let count = tool_length.len().saturating_mul(phi1.len()).saturating_mul(phi2.len());
    if count > MAX_MEMBERS {
        faults.add("", format!("makes {count} workspaces; the limit is {MAX_MEMBERS}"));
    }
    faults.into_result()?;
    let machine = machine?;
    let [table_clearance, tool_radius] = if part {
        machine.canonical_clearance(request.table_clearance, request.tool_radius)
    } else {
        [None, None]
    };
    let tolerance = request.tolerance;
    let family = CanonicalFamily { kind, tool_length, table_clearance, tool_radius, phi1, phi2, tolerance };
    Ok((machine, family))
}

/// The numbers of a sweep, without -0. A sweep that has no effect on the kind must be one number.
fn sweep_numbers(
    pointer: &str,
    sweep: &Sweep,
    effective: bool,
    kind: KindName,
    faults: &mut FieldErrors,
) -> Vec<f64> {
    let numbers = sweep.numbers(MAX_MEMBERS).unwrap_or_else(|fault| {
        faults.add(pointer, fault);
        Vec::new()
    });
    if !effective && numbers.len() > 1 {
        faults.add(pointer, format!("has no effect on {}: give one number", kind.name()));
    }
    numbers.into_iter().map(|number| number + 0.0).collect()
}

impl WorkspaceQuestion {
    /// Checks a request for one workspace.
    pub(crate) fn new(
        request: &WorkspaceRequest,
        machines: &MachineRegistry,
    ) -> Result<Self, OperationError> {
        let (machine, family) = check_workspaces(request, machines)?;
        // A request for a family has no answer here; the caller tells them apart.
        family.members().next().map(|member| Self::of(machine, member)).ok_or(OperationError::Internal)
    }

    /// The question of a checked request.
    pub(crate) fn of(machine: Arc<IdentifiedMachine>, request: CanonicalWorkspace) -> Self {
        let kind = match request.kind {
            KindName::Platform => 0.0,
            KindName::Tool => 1.0,
            KindName::Part => 2.0,
        };
        let numbers = [Some(kind), request.tool_length, request.phi1, request.phi2, Some(request.tolerance)];
        let numbers = numbers.into_iter().map(Option::unwrap_or_default);
        let numbers = numbers.chain(request.table_clearance).chain(request.tool_radius);
        Self { id: machine.result_id(HASH_PREFIX, numbers), machine, request }
    }

    /// Estimates the triangles of the mesh. It takes some milliseconds: call it on the compute pool.
    pub(crate) fn triangles(&self, observer: &dyn Observer) -> Result<f64, OperationError> {
        expected_triangles(&self.machine, &Request::from(&self.request), observer).map_err(workspace_error)
    }
}

/// Refuses a mesh that is estimated at more than `most` triangles.
pub(crate) fn check_triangles(triangles: f64, most: u64) -> Result<(), OperationError> {
    #[expect(clippy::cast_precision_loss, reason = "the estimate is less precise")]
    let most = most as f64;
    if triangles <= most {
        return Ok(());
    }
    let detail = format!("would make about {} triangles; the limit is {}", rounded(triangles), rounded(most));
    Err(OperationError::Fields(vec![FieldError::new("/tolerance", detail)]))
}

/// Estimated work, seconds of one core, of a workspace with this number of triangles.
pub(crate) fn workspace_cost(triangles: f64) -> f64 {
    VOLUME_COST + TRIANGLE_COST * triangles
}

/// Refuses a tolerance that is too fine for the machine, or out of range.
fn check_tolerance(tolerance: f64, machine: Option<&IdentifiedMachine>, faults: &mut FieldErrors) {
    let [mut finest, coarsest] = TOLERANCES;
    if let Some(machine) = machine {
        finest = finest.max(FINEST_FRACTION * machine.longest());
    }
    if !(finest..=coarsest).contains(&tolerance) {
        faults.add("/tolerance", format!("must be a number from {finest} to {coarsest} mm"));
    }
}

/// A number with two significant digits, in millions if it is large enough.
fn rounded(number: f64) -> String {
    let unit = 10_f64.powf(number.log10().floor() - 1.0).max(1.0);
    let number = (number / unit).round() * unit;
    if number < 1e6 { format!("{number}") } else { format!("{} million", number / 1e6) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use serde_json::json;
    use verne_solver::workspace::Unobserved;

    use super::{WorkspaceQuestion, rounded};
    use crate::operations::machine_registry::MachineRegistry;
    use crate::operations::workspace::compute_workspace;
    use crate::wire::error::{FieldError, OperationError};
    use crate::wire::workspace::KindName;

    fn question(kind: KindName, tool_length: f64, tolerance: f64) -> WorkspaceQuestion {
        let request = json!({"kind": kind, "tool_length": tool_length, "tolerance": tolerance});
        let request = serde_json::from_value(request).unwrap();
        WorkspaceQuestion::new(&request, &MachineRegistry::default()).unwrap()
    }

    #[test]
    fn the_estimated_triangles_are_near_the_computed_ones() {
        for kind in [KindName::Platform, KindName::Tool, KindName::Part] {
            for tolerance in [1.0, 0.3, 0.1] {
                let question = question(kind, 300.0, tolerance);
                let mesh = compute_workspace(&question, usize::MAX, &Unobserved).unwrap().mesh;
                let computed = u32::try_from(mesh.triangles().len()).unwrap();
                let ratio = question.triangles(&Unobserved).unwrap() / f64::from(computed);
                assert!((0.8..1.5).contains(&ratio), "{kind:?} {tolerance}: {computed}, {ratio} of them");
            }
        }
    }

    #[test]
    fn a_mesh_with_more_triangles_than_the_limit_is_refused() {
        let question = question(KindName::Platform, 0.0, 1.0);
        let refused = compute_workspace(&question, 1_000, &Unobserved).map(drop).unwrap_err();
        let detail = "makes more triangles than the limit of 1000";
        assert_eq!(refused, OperationError::Fields(vec![FieldError::new("/tolerance", detail)]));
    }

    #[test]
    fn numbers_are_rounded_to_two_digits() {
        for (number, rounded_to) in [
            (41_234_567.0, "41 million"),
            (1_260_000.0, "1.3 million"),
            (5e6, "5 million"),
            (999_999.0, "1 million"),
            (350_400.0, "350000"),
            (7.0, "7"),
        ] {
            assert_eq!(rounded(number), rounded_to);
        }
    }
}
