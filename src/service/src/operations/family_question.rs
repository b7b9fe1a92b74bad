//! A checked question about a family of workspaces.

use std::sync::Arc;

use verne_solver::workspace::Observer;

use crate::operations::registry::{Published, Registry};
use crate::operations::workspace_question::{WorkspaceQuestion, check_tolerance};
use crate::wire::error::OperationError;
use crate::wire::family::{FamilyRequest, WorkspaceBody};
use crate::wire::field_errors::{FieldErrors, is_angle, is_tool_length};
use crate::wire::machine_ref::MachineRef;
use crate::wire::result_id::ResultId;
use crate::wire::sweep::Span;
use crate::wire::workspace::{CanonicalRequest, KindName, WorkspaceRequest, over_table};

/// Most workspaces in a family.
const MEMBERS: usize = 1000;

/// About how many members of a family are estimated.
const PROBES: usize = 4;

/// Changes when the bytes do that the same question is answered with.
const LAYOUT: &[u8] = b"verne family 1";

/// A family that has an answer.
#[derive(Clone, Debug)]
pub(crate) struct FamilyQuestion {
    /// The machine.
    pub published: Arc<Published>,
    /// What is asked.
    pub request: FamilyRequest,
    /// Each workspace.
    pub members: Vec<WorkspaceQuestion>,
    /// The answer's id.
    pub id: ResultId,
}

impl FamilyQuestion {
    /// Checks a request.
    pub(crate) fn new(asked: &WorkspaceBody, machines: &Registry) -> Result<Self, OperationError> {
        let mut faults = FieldErrors::default();
        let resolved = machines.resolve(&asked.machine);
        let (tool, part) = (asked.kind != KindName::Platform, asked.kind == KindName::Part);
        let mut written = |pointer: &str, span: &Span, effective: bool| {
            let numbers: Vec<f64> = span.numbers(MEMBERS).unwrap_or_else(|fault| {
                faults.add(pointer, fault);
                Vec::new()
            });
            if !effective && numbers.len() > 1 {
                faults.add(pointer, format!("has no effect on {}: give one number", asked.kind.name()));
            }
            numbers.into_iter().map(|number| number + 0.0).collect::<Vec<f64>>()
        };
        let tool_length = written("/tool_length", &asked.tool_length, tool);
        let [phi1, phi2] = [("/phi1", &asked.phi1), ("/phi2", &asked.phi2)]
            .map(|(pointer, span)| written(pointer, span, part));
        let extremes = |numbers: &[f64]| {
            let (least, greatest) = (f64::INFINITY, f64::NEG_INFINITY);
            numbers.iter().fold([least, greatest], |[low, high], &n| [low.min(n), high.max(n)])
        };
        if !tool_length.is_empty() {
            // Where both ends are allowed, so is what lies between.
            let outside = extremes(&tool_length).into_iter().find(|length| !is_tool_length(*length));
            if let Some(length) = outside {
                faults.tool_length(length);
            }
        }
        for (pointer, numbers) in [("/phi1", &phi1), ("/phi2", &phi2)] {
            let outside =
                extremes(numbers).into_iter().find(|angle| !numbers.is_empty() && !is_angle(*angle));
            faults.angle(pointer, outside);
        }
        faults.clearance(asked.table_clearance, asked.tool_radius, asked.kind.without_tilt());
        check_tolerance(asked.tolerance, resolved.as_deref().ok(), &mut faults);
        let count = tool_length.len().saturating_mul(phi1.len()).saturating_mul(phi2.len());
        if count > MEMBERS {
            faults.add("", format!("makes {count} workspaces; the limit is {MEMBERS}"));
        }
        faults.into_result()?;
        let published = resolved?;
        let own = published.machine.data().limits.table_clearance;
        let clearance = asked.table_clearance.or(own).filter(|_| part);
        let [table_clearance, tool_radius] = over_table(clearance, asked.tool_radius);
        let request = FamilyRequest {
            kind: asked.kind,
            tool_length,
            table_clearance,
            tool_radius,
            phi1,
            phi2,
            tolerance: asked.tolerance,
        };
        Ok(Self::of(&published, request))
    }

    /// A question that was checked before.
    pub(crate) fn of(published: &Arc<Published>, request: FamilyRequest) -> Self {
        let members: Vec<WorkspaceQuestion> = request
            .members()
            .map(|member| WorkspaceQuestion::of(Arc::clone(published), CanonicalRequest::from(&member)))
            .collect();
        let mut hasher = blake3::Hasher::new();
        hasher.update(LAYOUT);
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
        Self { published: Arc::clone(published), request, members, id: hasher.finalize().into() }
    }
}

impl FamilyQuestion {
    /// How many workspaces there are.
    pub(crate) fn count(&self) -> u32 {
        u32::try_from(self.members.len()).unwrap_or(u32::MAX)
    }

    /// About how many triangles the largest mesh will have. A tool's length makes it larger, and the tool's inclination cuts
    /// the workspace of a part: the longest tool is looked at, and some of the members.
    pub(crate) fn triangles(&self, observer: &dyn Observer) -> Result<f64, OperationError> {
        let tool = |member: &&WorkspaceQuestion| member.request.tool_length.unwrap_or_default().abs();
        let longest = self.members.iter().max_by(|a, b| tool(a).total_cmp(&tool(b)));
        let some = self.members.iter().step_by(self.members.len().div_ceil(PROBES).max(1));
        let mut most: f64 = 0.0;
        for member in some.chain(longest) {
            most = most.max(member.triangles(observer)?);
        }
        Ok(most)
    }
}

impl FamilyRequest {
    /// Every combination, phi2 running fastest.
    fn members(&self) -> impl Iterator<Item = WorkspaceRequest> {
        let lengths = self.tool_length.iter();
        lengths.flat_map(move |&tool_length| {
            self.phi1.iter().flat_map(move |&phi1| {
                self.phi2.iter().map(move |&phi2| WorkspaceRequest {
                    machine: MachineRef::default(),
                    kind: self.kind,
                    tool_length,
                    table_clearance: self.table_clearance,
                    tool_radius: self.tool_radius.unwrap_or_default(),
                    phi1,
                    phi2,
                    tolerance: self.tolerance,
                })
            })
        })
    }
}
