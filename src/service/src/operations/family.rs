//! The table of a family of workspaces.

use crate::operations::family_question::FamilyQuestion;
use crate::operations::workspace_question::WorkspaceQuestion;
use crate::wire::error::OperationError;
use crate::wire::family::{FamilyLinks, FamilyMember, FamilySummary, Figures};
use crate::wire::json::write_json;
use crate::wire::limit::Unchecked;

/// About the bytes of a member.
const MEMBER_BYTES: usize = 512;

/// A table that is being filled.
pub(crate) struct FamilyTable(Vec<FamilyMember>);

impl FamilyTable {
    /// Room for so many members.
    pub(crate) fn with_room(members: usize) -> Self {
        Self(Vec::with_capacity(members))
    }

    /// Adds a member by its summary, or why it has none: one that cannot be computed spoils no other.
    pub(crate) fn add(
        &mut self,
        question: &WorkspaceQuestion,
        summary: Result<&[u8], OperationError>,
    ) -> Result<(), OperationError> {
        let (figures, failure) = match summary {
            Ok(summary) => {
                (Some(serde_json::from_slice(summary).map_err(|_| OperationError::Internal)?), None)
            }
            Err(OperationError::Fields(faults)) => {
                let words = faults.into_iter().map(|fault| format!("{} {}", fault.pointer, fault.detail));
                (None, Some(words.collect::<Vec<_>>().join("; ")))
            }
            Err(error) => return Err(error),
        };
        let figures: Option<Figures> = figures;
        let member =
            FamilyMember { id: question.id.to_string(), request: question.request, figures, failure };
        self.0.push(member);
        Ok(())
    }

    /// The table, as it is sent.
    pub(crate) fn written(self, question: &FamilyQuestion) -> Result<Vec<u8>, OperationError> {
        let bytes = MEMBER_BYTES * (1 + self.0.len());
        let summary = FamilySummary {
            id: question.id.to_string(),
            request: question.request.clone(),
            machine: question.published.id.clone(),
            members: self.0,
            not_checked: Unchecked::beside(question.request.table_clearance.is_some()),
            links: FamilyLinks { itself: question.id.path() },
        };
        write_json(&summary, bytes)
    }
}
