//! Typed answers to JSON text.

use serde::Serialize;

use crate::wire::error::OperationError;

/// Writes an answer into a buffer of about its size: growing one from nothing moves every byte twice.
pub(crate) fn write_json(answer: &impl Serialize, expected_bytes: usize) -> Result<Vec<u8>, OperationError> {
    let mut text = Vec::with_capacity(expected_bytes);
    serde_json::to_writer(&mut text, answer).map_err(|_| OperationError::Internal)?;
    Ok(text)
}
