//! A checked question about a family of workspaces.

use std::sync::Arc;

use verne_solver::workspace::Observer;

use crate::operations::machine_registry::{IdentifiedMachine, MachineRegistry};
use crate::operations::workspace_question::{WorkspaceQuestion, check_workspaces};
use crate::wire::error::OperationError;
use crate::wire::family::CanonicalFamily;
use crate::wire::result_id::ResultId;
use crate::wire::workspace::WorkspaceRequest;

/// About how many members of a family are estimated.
const SAMPLES: usize = 4;

/// Begins the hash of every family. It changes when the bytes of the answer to the same question change.
const HASH_PREFIX: &[u8] = b"verne family 1";

/// A question about a family that has an answer.
#[derive(Clone, Debug)]
pub(crate) struct FamilyQuestion {
    /// The machine.
    pub machine: Arc<IdentifiedMachine>,
    /// The request with its default values.
    pub request: CanonicalFamily,
    /// The questions about its members.
    pub members: Vec<WorkspaceQuestion>,
    /// The id of the answer.
    pub id: ResultId,
}

impl FamilyQuestion {
    /// Checks a request.
    pub(crate) fn new(
        request: &WorkspaceRequest,
        machines: &MachineRegistry,
    ) -> Result<Self, OperationError> {
        check_workspaces(request, machines).map(|(machine, family)| Self::of(machine, family))
    }

    /// The question of a checked request.
    pub(crate) fn of(machine: Arc<IdentifiedMachine>, request: CanonicalFamily) -> Self {
        let members: Vec<WorkspaceQuestion> =
            request.members().map(|member| WorkspaceQuestion::of(Arc::clone(&machine), member)).collect();
        let mut hasher = blake3::Hasher::new();
        hasher.update(HASH_PREFIX);
        // The table shows the lists: [5, 5] by [0] is not [5] by [0, 0], though the workspaces are the same.
        for numbers in [&request.tool_length, &request.phi1, &request.phi2] {
            hasher.update(&(numbers.len() as u64).to_le_bytes());
            for number in numbers {
                hasher.update(&number.to_le_bytes());
            }
        }
        for member in &members {
            hasher.update(member.id.job().as_bytes());
        }
        Self { machine, request, members, id: hasher.finalize().into() }
    }

    /// The number of workspaces.
    pub(crate) fn count(&self) -> u32 {
        u32::try_from(self.members.len()).unwrap_or(u32::MAX)
    }

    /// Estimates the triangles of the largest mesh, from some of the members. One of them has the longest tool, which
    /// makes the mesh larger; the others differ in the inclination, which cuts the workspace of a part.
    pub(crate) fn triangles(&self, observer: &dyn Observer) -> Result<f64, OperationError> {
        let tool = |member: &&WorkspaceQuestion| member.request.tool_length.unwrap_or_default().abs();
        let longest = self.members.iter().max_by(|a, b| tool(a).total_cmp(&tool(b)));
        let samples = self.members.iter().step_by(self.members.len().div_ceil(SAMPLES).max(1));
        let mut most: f64 = 0.0;
        for member in samples.chain(longest) {
            most = most.max(member.triangles(observer)?);
        }
        Ok(most)
    }
}
