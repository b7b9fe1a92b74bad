//! The job of an error map, which merges the results of its parts.

use bytes::Bytes;
use verne_solver::workspace::Observer;

use crate::operations::blocking_results::BlockingResults;
use crate::operations::error_map::merge_error_map;
use crate::operations::error_map_question::ErrorMapQuestion;
use crate::operations::question::Question;
use crate::operations::results::{CELLS, pack_mesh};
use crate::wire::error::OperationError;
use crate::wire::error_map::ErrorName;

/// The blobs of an error map.
pub(crate) const ERROR_MAP: [&str; 5] = [
    ErrorName::TipRms.name(),
    ErrorName::TipWorst.name(),
    ErrorName::AxisRms.name(),
    ErrorName::AxisWorst.name(),
    CELLS,
];

/// Merges a map from its parts, of which the surface is the last, and stores it. The record is stored last: a process
/// that finds it expects the meshes.
pub(crate) fn merge_and_store(
    store: &BlockingResults,
    question: &ErrorMapQuestion,
    parts: &[Bytes],
    observer: &dyn Observer,
) -> Result<(), OperationError> {
    let Some((surface, slabs)) = parts.split_last() else { return Err(OperationError::Internal) };
    let merged = merge_error_map(question, slabs, surface, observer)?;
    for (error, mesh) in ErrorName::ALL.into_iter().zip(&merged.meshes) {
        store.put_blob(question.id, error.name(), pack_mesh(mesh)?)?;
    }
    store.put_blob(question.id, CELLS, merged.cells)?;
    store.put_record(&Question::ErrorMap(Box::new(question.clone())), &merged.summary, None)
}
