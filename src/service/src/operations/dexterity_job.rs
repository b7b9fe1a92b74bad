//! The job of a dexterity map, which merges the results of its parts.

use bytes::Bytes;
use verne_solver::workspace::Observer;

use crate::operations::blocking_results::BlockingResults;
use crate::operations::dexterity_map::merge_map;
use crate::operations::dexterity_question::DexterityQuestion;
use crate::operations::question::Question;
use crate::operations::results::{CELLS, pack_mesh};
use crate::wire::dexterity::SetName;
use crate::wire::error::OperationError;

/// The blobs of a dexterity map.
pub(crate) const DEXTERITY_MAP: [&str; 3] = [SetName::Reachable.name(), SetName::Dexterous.name(), CELLS];

/// Merges a map from its parts, of which the volumes are the last, and stores it. The record is stored last: a process
/// that finds it expects the meshes.
pub(crate) fn merge_and_store(
    store: &BlockingResults,
    map: &DexterityQuestion,
    parts: &[Bytes],
    observer: &dyn Observer,
) -> Result<(), OperationError> {
    let Some((volumes, slabs)) = parts.split_last() else { return Err(OperationError::Internal) };
    let merged = merge_map(map, slabs, volumes, observer)?;
    let [reachable, dexterous] = &merged.meshes;
    let blobs = [pack_mesh(reachable)?, pack_mesh(dexterous)?, merged.cells];
    for (name, bytes) in DEXTERITY_MAP.into_iter().zip(blobs) {
        store.put_blob(map.id, name, bytes)?;
    }
    store.put_record(&Question::Dexterity(map.clone()), &merged.summary, None)
}
