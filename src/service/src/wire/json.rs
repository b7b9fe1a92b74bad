//! Writes answers as JSON.

use serde::Serialize;

use crate::wire::error::OperationError;

/// Writes an answer as JSON. The buffer starts with the expected size: a buffer that grows copies every byte about
/// twice.
pub(crate) fn write_json(answer: &impl Serialize, expected_bytes: usize) -> Result<Vec<u8>, OperationError> {
    let mut text = Vec::with_capacity(expected_bytes);
    serde_json::to_writer(&mut text, answer).map_err(|_| OperationError::Internal)?;
    Ok(text)
}
