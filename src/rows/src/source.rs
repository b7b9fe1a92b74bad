//! The reader of one format.

use std::fmt;

use crate::chunk::Chunk;
use crate::column::Column;
use crate::error::ReadError;

/// Reads the rows of one format.
pub(crate) trait Source: fmt::Debug + Send {
    /// Takes bytes.
    fn push(&mut self, bytes: &[u8]);
    /// The next rows. `ended` says that no bytes follow.
    fn next_chunk(&mut self, ended: bool) -> Result<Option<Chunk>, ReadError>;
    /// The columns without rows, as soon as they are known.
    fn columns(&self) -> Option<Vec<Column>>;
}
