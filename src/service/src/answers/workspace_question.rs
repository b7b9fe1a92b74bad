//! A checked question about a workspace, and the id of its answer.

use std::sync::Arc;

use verne_solver::MachineData;
use verne_solver::workspace::WorkspaceError;

use super::dexterity::too_many_points;
use crate::error::{Error, Fault};
use crate::faults::Faults;
use crate::registry::{Published, Registry};
use crate::result_id::ResultId;
use crate::wire::workspace::{CanonicalRequest, KindName, WorkspaceRequest};

/// Finest and coarsest tolerance, mm: at the finest the reference machine's mesh has some 350,000 triangles.
const TOLERANCES: [f64; 2] = [0.01, 1000.0];

/// Finest tolerance as a part of the machine's longest dimension: it keeps any machine's mesh to a few million
/// triangles.
const FINEST: f64 = 1e-6;

/// About the seconds that a volume takes.
const VOLUME_COST: f64 = 0.015;

/// About the seconds that a surface takes, times its tolerance as a part of the machine's longest dimension.
const SURFACE_COST: f64 = 1e-5;

/// Changes when the bytes do that the same question is answered with.
const LAYOUT: &[u8] = b"verne workspace 2";

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
    pub(crate) fn new(asked: &WorkspaceRequest, machines: &Registry) -> Result<Self, Error> {
        let mut faults = Faults::default();
        faults.tool_length(asked.tool_length);
        faults.angle("/phi1", Some(asked.phi1));
        faults.angle("/phi2", Some(asked.phi2));
        let resolved = machines.resolve(&asked.machine);
        check_tolerance(asked.tolerance, resolved.as_deref().ok(), &mut faults);
        faults.into_result()?;
        Ok(Self::of(resolved?, CanonicalRequest::from(asked)))
    }

    /// A question that was checked before.
    pub(crate) fn of(published: Arc<Published>, request: CanonicalRequest) -> Self {
        let kind = match request.kind {
            KindName::Platform => 0.0,
            KindName::Tool => 1.0,
            KindName::Part => 2.0,
        };
        let numbers = [Some(kind), request.tool_length, request.phi1, request.phi2, Some(request.tolerance)];
        let numbers = numbers.map(Option::unwrap_or_default);
        Self { id: ResultId::of(LAYOUT, &published, numbers), published, request }
    }

    /// Estimated work, seconds of one core: what the reference machine's mesh takes at the same fraction of its size.
    pub(crate) fn cost(&self) -> f64 {
        VOLUME_COST + SURFACE_COST * longest(self.published.machine.data()) / self.request.tolerance
    }
}

/// Refuses a tolerance that is too fine for the machine, or no tolerance.
pub(super) fn check_tolerance(tolerance: f64, published: Option<&Published>, faults: &mut Faults) {
    let [mut finest, coarsest] = TOLERANCES;
    if let Some(published) = published {
        finest = finest.max(FINEST * longest(published.machine.data()));
    }
    if !(finest..=coarsest).contains(&tolerance) {
        faults.add("/tolerance", format!("must be a number from {finest} to {coarsest} mm"));
    }
}

/// A machine's longest dimension, mm.
pub(super) fn longest(machine: &MachineData) -> f64 {
    let g = &machine.geometry;
    [g.L1, g.L2, g.L3, g.R1, g.R2, g.r1, g.r4].into_iter().fold(0.0, f64::max)
}

/// What the solver refuses, in the words of the request.
pub(crate) fn workspace_error(error: WorkspaceError) -> Error {
    match error {
        WorkspaceError::OutOfDomain { field } => {
            Error::Fields(vec![Fault::new(format!("/{field}"), "is out of range")])
        }
        WorkspaceError::TooFine => {
            Error::Fields(vec![Fault::new("/tolerance", "asks for more vertices than can be numbered")])
        }
        WorkspaceError::TooManyNodes { nodes } => too_many_points(nodes),
        WorkspaceError::Open => Error::Fields(vec![Fault::new(
            "/tolerance",
            "gives a surface that cannot be closed on this machine; a finer or coarser one may do",
        )]),
        WorkspaceError::Cancelled => Error::Cancelled,
    }
}
