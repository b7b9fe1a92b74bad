//! The table of a family of workspaces.

use bytes::Bytes;

use crate::operations::family_question::FamilyQuestion;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::wire::error::OperationError;
use crate::wire::family::{FamilyLinks, FamilyMember, FamilySummary, Figures};
use crate::wire::json::write_json;
use crate::wire::limit::Unchecked;

/// About the bytes of a member.
const MEMBER_BYTES: usize = 512;

/// A table to which members are added.
pub(crate) struct FamilyTable(Vec<FamilyMember>);

impl FamilyTable {
    /// An empty table for this number of members.
    pub(crate) fn with_capacity(members: usize) -> Self {
        Self(Vec::with_capacity(members))
    }

    /// Adds a member with its summary. A member whose fields cannot be used gets the reason instead, and the others
    /// stay unaffected.
    pub(crate) fn add(
        &mut self,
        question: &WorkspaceQuestion,
        summary: Result<Bytes, OperationError>,
    ) -> Result<(), OperationError> {
        let (figures, failure): (Option<Figures>, _) = match summary {
            Ok(summary) => {
                (Some(serde_json::from_slice(&summary).map_err(|_| OperationError::Internal)?), None)
            }
            Err(OperationError::Fields(faults)) => {
                let reasons = faults.into_iter().map(|fault| format!("{} {}", fault.pointer, fault.detail));
                (None, Some(reasons.collect::<Vec<_>>().join("; ")))
            }
            Err(error) => return Err(error),
        };
        let member = FamilyMember { id: question.id, request: question.request, figures, failure };
        self.0.push(member);
        Ok(())
    }

    /// The summary of the family, as it is sent.
    pub(crate) fn write(self, question: &FamilyQuestion) -> Result<Vec<u8>, OperationError> {
        let bytes = MEMBER_BYTES * (1 + self.0.len());
        let summary = FamilySummary {
            id: question.id,
            request: question.request.clone(),
            machine: question.machine.id.clone(),
            members: self.0,
            not_checked: Unchecked::beside(question.request.table_clearance.is_some()),
            links: FamilyLinks { itself: question.id.path() },
        };
        write_json(&summary, bytes)
    }
}
