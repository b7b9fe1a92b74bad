//! The job of a region of origins, which merges the results of its parts.

use bytes::Bytes;
use verne_solver::toolpath::OriginSurvey;
use verne_solver::workspace::Observer;

use crate::operations::blocking_results::BlockingResults;
use crate::operations::observers::section;
use crate::operations::origins::{OriginsPart, compute_part, merge_parts, pack_extent, survey};
use crate::operations::origins_question::OriginsQuestion;
use crate::operations::programs::load_program_in_job;
use crate::operations::question::Question;
use crate::operations::results::{MESH, pack_mesh};
use crate::wire::error::OperationError;

/// The blob of a region's extent, which every part of it needs.
const EXTENT: &str = "extent";

/// Fractions of a part's work, and of the merging, that the survey takes.
const SURVEYED: f64 = 0.2;

/// Computes a part of a region, whose program it loads.
pub(crate) fn answer_part(
    store: &BlockingResults,
    question: &OriginsQuestion,
    part: OriginsPart,
    observer: &dyn Observer,
) -> Result<Vec<u8>, OperationError> {
    let survey = survey_once(store, question, &section(observer, 0.0, SURVEYED))?;
    compute_part(question, &survey, part, &section(observer, SURVEYED, 1.0))
}

/// Merges a region from its parts and stores it. The record is stored last: a process that finds it expects the mesh.
pub(crate) fn merge_region(
    store: &BlockingResults,
    question: &OriginsQuestion,
    parts: &[Bytes],
    observer: &dyn Observer,
) -> Result<(), OperationError> {
    let survey = survey_once(store, question, &section(observer, 0.0, SURVEYED))?;
    let merged = merge_parts(question, &survey, parts, &section(observer, SURVEYED, 1.0))?;
    store.put_blob(question.id, MESH, pack_mesh(&merged.mesh)?)?;
    store.put_record(&Question::Origins(Box::new(question.clone())), &merged.summary, None)
}

/// The survey of the program, of which another part of the computation may have stored what takes long.
fn survey_once(
    store: &BlockingResults,
    question: &OriginsQuestion,
    observer: &dyn Observer,
) -> Result<OriginSurvey, OperationError> {
    let program = load_program_in_job(store, question.toolpath.request.program)?;
    let stored = store.blob(question.id, EXTENT);
    let survey = survey(question, &program, stored.as_deref(), observer)?;
    if stored.is_none() {
        store.put_blob(question.id, EXTENT, pack_extent(&survey)?)?;
    }
    Ok(survey)
}
