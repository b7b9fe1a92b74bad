//! The job of a region of origins, which merges the results of its parts.

use bytes::Bytes;
use verne_solver::workspace::Observer;

use crate::operations::blocking_results::BlockingResults;
use crate::operations::origins::{OriginsPart, compute_part, merge_parts};
use crate::operations::origins_question::OriginsQuestion;
use crate::operations::programs::load_program_in_job;
use crate::operations::question::Question;
use crate::operations::results::{MESH, pack_mesh};
use crate::wire::error::OperationError;

/// Computes a part of a region, whose program it loads.
pub(crate) fn answer_part(
    store: &BlockingResults,
    question: &OriginsQuestion,
    part: OriginsPart,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let program = load_program_in_job(store, question.toolpath.request.program)?;
    compute_part(question, &program, part, observer)
}

/// Merges a region from its parts, of which the coarse grid is the last, and stores it. The record is stored last: a
/// process that finds it expects the mesh.
pub(crate) fn merge_region(
    store: &BlockingResults,
    question: &OriginsQuestion,
    parts: &[Bytes],
    observer: &dyn Observer,
) -> Result<(), OperationError> {
    let Some((coarse, slabs)) = parts.split_last() else { return Err(OperationError::Internal) };
    let program = load_program_in_job(store, question.toolpath.request.program)?;
    let merged = merge_parts(question, &program, slabs, coarse, observer)?;
    store.put_blob(question.id, MESH, pack_mesh(&merged.mesh)?)?;
    store.put_record(&Question::Origins(Box::new(question.clone())), &merged.summary, None)
}
