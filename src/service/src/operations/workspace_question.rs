//! A checked question about a workspace, and the id of its answer.

use std::sync::Arc;

use verne_solver::MachineData;
use verne_solver::workspace::{Observer, Request, WorkspaceError, expected_triangles};

use crate::operations::dexterity::too_many_points;
use crate::operations::registry::{Published, Registry};
use crate::wire::error::{FieldError, OperationError};
use crate::wire::field_errors::FieldErrors;
use crate::wire::result_id::ResultId;
use crate::wire::workspace::{CanonicalRequest, KindName, WorkspaceRequest};

/// Finest and coarsest tolerance, mm: at the finest the reference machine's mesh has some 350,000 triangles.
const TOLERANCES: [f64; 2] = [0.01, 1000.0];

/// Finest tolerance as a part of the machine's longest dimension: it keeps any machine's mesh to a few million
/// triangles.
const FINEST: f64 = 1e-6;

/// About the seconds that a volume takes, and a triangle.
const VOLUME_COST: f64 = 0.015;
const TRIANGLE_COST: f64 = 4e-6;

/// Changes when the bytes do that the same question is answered with.
const LAYOUT: &[u8] = b"verne workspace 3";

/// A question that has an answer.
#[derive(Clone, Debug)]
pub(crate) struct WorkspaceQuestion {
    /// The machine.
    pub published: Arc<Published>,
    /// What is asked.
    pub request: CanonicalRequest,
    /// The answer's id.
    pub id: ResultId,
}

impl WorkspaceQuestion {
    /// Checks a request.
    pub(crate) fn new(asked: &WorkspaceRequest, machines: &Registry) -> Result<Self, OperationError> {
        let mut faults = FieldErrors::default();
        faults.tool_length(asked.tool_length);
        faults.clearance(asked.table_clearance, asked.tool_radius, asked.kind.without_tilt());
        faults.angle("/phi1", Some(asked.phi1));
        faults.angle("/phi2", Some(asked.phi2));
        let resolved = machines.resolve(&asked.machine);
        check_tolerance(asked.tolerance, resolved.as_deref().ok(), &mut faults);
        faults.into_result()?;
        let published = resolved?;
        let table_clearance = asked.table_clearance.or(published.machine.data().limits.table_clearance);
        let request = CanonicalRequest::from(&WorkspaceRequest { table_clearance, ..asked.clone() });
        Ok(Self::of(published, request))
    }

    /// A question that was checked before.
    pub(crate) fn of(published: Arc<Published>, request: CanonicalRequest) -> Self {
        let kind = match request.kind {
            KindName::Platform => 0.0,
            KindName::Tool => 1.0,
            KindName::Part => 2.0,
        };
        let numbers = [Some(kind), request.tool_length, request.phi1, request.phi2, Some(request.tolerance)];
        let numbers = numbers.into_iter().map(Option::unwrap_or_default);
        // Questions without them keep the ids that they had before there were such fields.
        let numbers = numbers.chain(request.table_clearance).chain(request.tool_radius);
        Self { id: published.result_id(LAYOUT, numbers), published, request }
    }

    /// About how many triangles the mesh will have. It takes some milliseconds: to be called on the worker threads.
    pub(crate) fn triangles(&self, observer: &dyn Observer) -> Result<f64, OperationError> {
        expected_triangles(&self.published.machine, &Request::from(&self.request), observer)
            .map_err(workspace_error)
    }
}

/// Refuses a mesh of so many triangles if they are more than this.
pub(crate) fn check_triangles(triangles: f64, most: u64) -> Result<(), OperationError> {
    let most = count(most);
    if triangles <= most {
        return Ok(());
    }
    let detail = format!("would make about {} triangles; the limit is {}", rounded(triangles), rounded(most));
    Err(OperationError::Fields(vec![FieldError::new("/tolerance", detail)]))
}

/// Estimated work, seconds of one core, of a workspace with so many triangles.
pub(crate) fn cost(triangles: f64) -> f64 {
    VOLUME_COST + TRIANGLE_COST * triangles
}

/// Refuses a tolerance that is too fine for the machine, or no tolerance.
pub(crate) fn check_tolerance(tolerance: f64, published: Option<&Published>, faults: &mut FieldErrors) {
    let [mut finest, coarsest] = TOLERANCES;
    if let Some(published) = published {
        finest = finest.max(FINEST * longest(published.machine.data()));
    }
    if !(finest..=coarsest).contains(&tolerance) {
        faults.add("/tolerance", format!("must be a number from {finest} to {coarsest} mm"));
    }
}

#[expect(clippy::cast_precision_loss, reason = "an estimate is compared with it")]
fn count(n: u64) -> f64 {
    n as f64
}

/// A number as people say it: two digits of it, in millions where it has any.
fn rounded(number: f64) -> String {
    let unit = 10_f64.powf(number.log10().floor() - 1.0).max(1.0);
    let number = (number / unit).round() * unit;
    if number < 1e6 { format!("{number}") } else { format!("{} million", number / 1e6) }
}

/// A machine's longest dimension, mm.
pub(crate) fn longest(machine: &MachineData) -> f64 {
    let g = &machine.geometry;
    [g.L1, g.L2, g.L3, g.R1, g.R2, g.r1, g.r4].into_iter().fold(0.0, f64::max)
}

/// What the solver refuses, in the words of the request.
pub(crate) fn workspace_error(error: WorkspaceError) -> OperationError {
    match error {
        WorkspaceError::OutOfDomain { field } => {
            OperationError::Fields(vec![FieldError::new(format!("/{field}"), "is out of range")])
        }
        WorkspaceError::TooFine => OperationError::Fields(vec![FieldError::new(
            "/tolerance",
            "would need more vertices than a mesh can index",
        )]),
        WorkspaceError::TooManyTriangles { most } => {
            let detail = format!("makes more triangles than the limit of {most}");
            OperationError::Fields(vec![FieldError::new("/tolerance", detail)])
        }
        WorkspaceError::TooManyNodes { nodes } => too_many_points(nodes),
        WorkspaceError::Open => OperationError::Fields(vec![FieldError::new(
            "/tolerance",
            "gives a surface that the service cannot close for this machine; try a finer or coarser tolerance",
        )]),
        WorkspaceError::Disagreement => OperationError::Internal,
        WorkspaceError::Cancelled => OperationError::Cancelled,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]
mod tests {
    use verne_solver::workspace::Unobserved;

    use super::{WorkspaceQuestion, rounded};
    use crate::operations::registry::Registry;
    use crate::operations::workspace::compute_workspace;
    use crate::wire::error::{FieldError, OperationError};
    use crate::wire::machine_ref::MachineRef;
    use crate::wire::workspace::{KindName, WorkspaceRequest};

    #[test]
    fn the_estimate_is_near_what_is_made() {
        for kind in [KindName::Platform, KindName::Tool, KindName::Part] {
            for tolerance in [1.0, 0.3, 0.1] {
                let request = WorkspaceRequest {
                    machine: MachineRef::default(),
                    kind,
                    tool_length: 300.0,
                    table_clearance: None,
                    tool_radius: 0.0,
                    phi1: 0.0,
                    phi2: 0.0,
                    tolerance,
                };
                let question = WorkspaceQuestion::new(&request, &Registry::default()).unwrap();
                let made =
                    compute_workspace(&question, usize::MAX, &Unobserved).unwrap().mesh.triangles().len();
                let estimate =
                    question.triangles(&Unobserved).unwrap() / f64::from(u32::try_from(made).unwrap());
                assert!((0.8..1.5).contains(&estimate), "{kind:?} {tolerance}: {made}, {estimate} of them");
            }
        }
    }

    #[test]
    fn a_mesh_that_turns_out_too_large_is_refused() {
        let request = WorkspaceRequest {
            machine: MachineRef::default(),
            kind: KindName::Platform,
            tool_length: 0.0,
            table_clearance: None,
            tool_radius: 0.0,
            phi1: 0.0,
            phi2: 0.0,
            tolerance: 1.0,
        };
        let question = WorkspaceQuestion::new(&request, &Registry::default()).unwrap();
        let refused = compute_workspace(&question, 1_000, &Unobserved).map(drop).unwrap_err();
        let detail = "makes more triangles than the limit of 1000";
        assert_eq!(refused, OperationError::Fields(vec![FieldError::new("/tolerance", detail)]));
    }

    #[test]
    fn numbers_are_said_with_two_digits() {
        for (number, said) in [
            (41_234_567.0, "41 million"),
            (1_260_000.0, "1.3 million"),
            (5e6, "5 million"),
            (999_999.0, "1 million"),
            (350_400.0, "350000"),
            (7.0, "7"),
        ] {
            assert_eq!(rounded(number), said);
        }
    }
}
